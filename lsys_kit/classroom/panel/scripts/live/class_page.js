// A page of the course on the server of a class: rules can be edited, exercises are answered, and the class hears of votes.

import { openCoursePage } from "../course.js";
import { prose } from "../lessons/asking.js";
import { hostWith, store } from "../page.js";
import { freshId, list, made, speak, worded } from "../views/controls.js";
import { askKit, classConnection, nextNumber } from "./outbox.js";

const SEEN = ["step", "angle", "around", "above", "seed", "mark", "settings"];
const SIGNS = { "Correct": ["✓", "lsys-right"], "Almost": ["≈", "lsys-almost"], "Not yet": ["✗", "lsys-wrong"], "Not readable yet": ["?", ""], "Not answered yet": ["○", ""] };

export function openClassPage() {
  speak(JSON.parse(document.getElementById("lsys-data").textContent).words);
  const [, code] = location.pathname.split("/"), base = `/${code}/`, [, name = ""] = /\/notebooks\/(\w+)\.html$/.exec(location.pathname) ?? [];
  const lesson = /^\d\d_/.test(name) ? name.slice(0, 2) : name;
  const banner = made("a.class-banner", { href: base, hidden: true });
  const status = made("p.class-status", { role: "status" });
  const skip = document.querySelector("body > .skip"), bar = made("nav.class-bar", { "aria-label": worded("The class") }, made("a", { href: base }, worded("The class")), status, banner);
  if (skip) skip.after(bar);
  else document.body.prepend(bar);
  const connection = classConnection(base, code, {
    linked: (isThere) => (status.textContent = isThere ? "" : worded("not connected: it is tried again, and nothing is lost")),
    state({ current }) {
      banner.hidden = !current || (current.page && location.pathname.endsWith(current.page));
      banner.textContent = worded("A question is open: answer it");
    },
    told: (message, answer) => (status.textContent = answer.kept ? `✓ ${worded("kept")}` : answer.later ? worded("Not kept yet: it is sent again by itself.") : ""),
  });
  const ask = (question) => askKit(base, question);
  openCoursePage({
    hostWith: (data) => classHost(data, ask, code),
    told: (kind, asked, round, value) => lesson && connection.tell(kind, lesson, round, value, { asked }),
    exercise: (place, data) => askForAnswer(place, data, (question) => ask({ ...question, kind: "check", id: data.id, sent: nextNumber(code) })),
    practice: (place, data) => practise(place, data, ask),
  });
}

// The host of a panel: what the page itself holds is at hand, and for all else the class is asked.
async function classHost(data, ask, code) {
  const held = await hostWith(data, false), values = Object.fromEntries(["model", ...SEEN].map((name) => [name, held.get(name)]));
  const { get, set, on, tell } = store(values);
  const { title, file } = values.model.book;
  let system = { ...data.system, title: title.split(":")[0] }, first = true;
  const panel = () => ({ ...system, without: values.model.without, unfold: values.model.unfold, show: values.model.show, ...Object.fromEntries(SEEN.map((name) => [name, values[name]])) });

  // Another model, and what is chosen in it: all of it is there before anybody hears of it.
  function adopt({ model, values: chosen, system: read }) {
    system = { ...system, ...read };
    Object.assign(values, chosen, { model });
    for (const name of ["model", ...SEEN]) tell(name);
  }

  async function rules(text, constants) {
    const answer = await ask({ kind: "rules", text, constants, panel: panel() });
    if (answer.mistake) return answer;
    first = false;
    adopt(answer);
    return { opened: true };
  }

  async function book(wanted) {
    const own = first ? await held.book(wanted) : {};
    return own.book ? own : ask({ kind: "book", ...wanted, panel: panel() });
  }

  async function keep(kind, state) {
    const answer = await ask(kind === "wall" ? { kind: "plant", text: (await ask({ kind: "keep", what: "link", state, panel: panel() })).text ?? "", sent: nextNumber(code) } : { kind: "keep", what: kind, state, panel: panel() });
    return kind === "wall" && !answer.mistake ? { said: worded("sent to the wall") } : answer;
  }

  // The page holds the sliders for which it has room; the class holds them all.
  async function allSliders() {
    const before = values.model, answer = await ask({ kind: "open", panel: { ...panel(), ...data.fixed, settings: { ...data.fixed, ...values.settings } } });
    if (answer.model && values.model === before && first) adopt({ ...answer, values: Object.fromEntries(SEEN.map((name) => [name, name === "settings" ? answer.values.settings : values[name]])) });
  }

  if (data.model.fixed || data.model.constants.length || data.model.chance) setTimeout(allSliders, 300);
  return {
    get, set, on, save: () => {}, book, rules, keep, notice: () => null, file,
    variants: () => ask({ kind: "variants", panel: panel() }),
    keeps: ["svg", "page", "link", "wall"], editable: true, ahead: false,
  };
}

const LINES = ["system", "drawing", "map", "net"]; // kinds that are answered in several lines

// Exercises without end, made at random: the class is asked for the next one, at a level that follows the tries.
function practise(place, { topics }, ask) {
  const SEEDS = 1_000_000, tries = [];
  let [[topic]] = topics, level = 1, seed = Math.floor(Math.random() * SEEDS);
  const here = made("div"), status = made("p", { role: "status" });
  const chosen = list(worded("Topic"), "", topics, topic, (value) => {
    [topic, level] = [value, 1];
    another();
  });

  async function another() {
    seed = (seed + 1) % SEEDS;
    status.textContent = worded("The next exercise is made");
    const wanted = { topic, level, seed }, found = await ask({ kind: "practice", ...wanted, tries: tries.slice(-20) });
    if (topic !== wanted.topic || seed !== wanted.seed) return;
    status.textContent = found.mistake ? `${found.mistake.message}. ${found.mistake.hint ?? ""}` : found.note;
    if (found.mistake) return here.replaceChildren();
    level = found.level;
    const box = made("div"), options = found.options.map(({ letter, text }) => made("li", made("b", letter), " ", prose(text)));
    here.replaceChildren(made("h3", `${found.title} · ${worded("level {level}", { level })}`), ...paragraphs(found.question), made("ul.class-options", { hidden: !options.length }, ...options), box);
    askForAnswer(box, { ...found, id: "", options: found.options.map(({ letter }) => letter) }, (question) => ask({ ...question, kind: "practice check", topic, level, seed }),
      (said) => ["Correct", "Almost", "Not yet"].includes(said) && tries.push([found.name, said === "Correct"]));
  }

  place.replaceChildren(made("section.lsys-lesson.class-practice", { "aria-label": worded("Practice") }, chosen.element, here, status, made("button", { type: "button", onclick: another }, worded("Another exercise"))));
  another();
}

// A text with paragraphs, and lines that are indented by four blanks.
function paragraphs(text) {
  return text.split(/\n{2,}/).map((part) => (/^ {4}/.test(part) ? made("pre", { tabindex: 0 }, part.replace(/^ {4}/gm, "")) : made("p", prose(part))));
}

// The box of an exercise, with hints and the solution after a try; `tried` hears of each verdict.
function askForAnswer(place, { id, kind, title, template, hints, options }, ask, tried = (said) => void said) {
  const said = made("p.lsys-said", { role: "status" }), more = made("div.class-more", { hidden: true });
  let answer = "", hinted = 0;

  async function check(extra = {}) {
    said.replaceChildren(worded("It is looked at"));
    const found = await ask({ answer, ...extra });
    tried(found.said);
    show(found.mistake ? { said: "Not readable yet", message: `${found.mistake.message}. ${found.mistake.hint ?? ""}` } : found);
  }

  function show({ said: verdict, message }) {
    const [sign, look] = SIGNS[verdict] ?? ["", ""];
    said.className = `lsys-said ${look}`.trim();
    said.replaceChildren(made("span", { "aria-hidden": "true" }, `${sign} `), made("b", `${worded(verdict)}. `));
    message.split("\n").forEach((line, at) => said.append(line.startsWith("  ") ? made("pre", { tabindex: 0 }, line) : made(at ? "div" : "span", line)));
    more.hidden = !["Almost", "Not yet"].includes(verdict);
  }

  function form() {
    if (options.length) {
      return made("div.lsys-options", { role: "group", "aria-label": title }, ...options.map((letter) => made("button.lsys-option", { type: "button", onclick: (event) => {
        answer = letter;
        for (const each of event.currentTarget.parentElement.children) each.setAttribute("aria-pressed", String(each === event.currentTarget));
        check();
      } }, letter)));
    }
    const box = LINES.includes(kind) || template.includes("\n") ? made("textarea", { rows: Math.max(4, template.split("\n").length + 1), maxlength: 5000, spellcheck: "false", autocapitalize: "off" }) : made("input", { type: "text", maxlength: 5000, autocomplete: "off" });
    box.id = freshId();
    box.placeholder = template === "..." ? "" : template;
    return made("form.class-answer", { onsubmit: (event) => {
      event.preventDefault();
      answer = box.value;
      check();
    } }, made("label", { for: box.id }, worded("Your answer")), box, made("button", { type: "submit" }, worded("Check")));
  }

  const hint = made("button", { type: "button", hidden: !hints, onclick: () => check({ hint: (hinted = Math.min(hints, hinted + 1)) }) }, worded("A hint"));
  more.append(hint, made("button", { type: "button", onclick: () => check({ solution: true }) }, worded("The solution")));
  place.replaceChildren(made("section.lsys-lesson", { "aria-label": `${worded("Exercise")} ${id || title}` }, form(), said, more));
}
