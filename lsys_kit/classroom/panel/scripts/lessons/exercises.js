// Exercises on a page of the course that has somebody who answers: what takes an answer, the reply to it, hints, the solution, and practice.

import { freshId, list, made, worded } from "../views/controls.js";
import { prose } from "./asking.js";
import { keepAnswer, keptAnswer } from "./keeping.js";

const SIGNS = { "Correct": ["✓", "lsys-right"], "Almost": ["≈", "lsys-almost"], "Not yet": ["✗", "lsys-wrong"], "Not readable yet": ["?", ""], "Not answered yet": ["○", ""] };
const LINES = ["system", "drawing", "map", "net"]; // kinds that are answered in several lines

// Exercises without end, made at random: `ask` asks for the next one, at a level that follows the tries; for the first `atOnce`, or when
// somebody wants it.
export function practise(place, { topics }, ask, atOnce) {
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
    here.replaceChildren(made("h3", `${found.title} · ${worded("level {level}", { level })}`), ...paragraphs(found.question), made("ul.exercise-options", { hidden: !options.length }, ...options), box);
    askForAnswer(box, { ...found, id: "", options: found.options.map(({ letter }) => letter) }, (question) => ask({ ...question, kind: "practice check", topic, level, seed }),
      (said) => ["Correct", "Almost", "Not yet"].includes(said) && tries.push([found.name, said === "Correct"]));
  }

  place.replaceChildren(made("section.lsys-lesson.exercise-practice", { "aria-label": worded("Practice") }, chosen.element, here, status, made("button", { type: "button", onclick: another }, worded("Another exercise"))));
  if (atOnce) another();
}

// A text with paragraphs, and lines that are indented by four blanks.
function paragraphs(text) {
  return text.split(/\n{2,}/).map((part) => (/^ {4}/.test(part) ? made("pre", { tabindex: 0 }, part.replace(/^ {4}/gm, "")) : made("p", prose(part))));
}

// The box of an exercise, with hints and the solution after a try; `tried` hears of each verdict, and of the answer. What is typed is kept, with
// the reply to it.
export function askForAnswer(place, { id, kind, title, template, hints, options }, ask, tried = (said, answer) => void [said, answer]) {
  const said = made("p.lsys-said", { role: "status" }), more = made("div.exercise-more", { hidden: true });
  const key = `exercise ${id}`;
  let answer = "", hinted = 0;
  const keep = (reply = null) => id && keepAnswer(key, answer ? { answer, reply } : null);

  async function check(extra = {}) {
    said.replaceChildren(worded("It is looked at"));
    const asked = answer, found = await ask({ answer, ...extra });
    if (asked !== answer) return;
    if (found.mistake) return cannot(found.mistake);
    tried(found.said, answer);
    keep({ said: found.said, message: found.message, picture: found.picture, described: found.described });
    show(found);
  }

  // The answer was not judged: it takes too long, or nobody is there who could.
  function cannot({ message, hint }) {
    said.className = "lsys-said";
    said.textContent = `\u26a0 ${message}. ${hint}`;
  }

  function show({ said: verdict, message, picture = "", described = "" }) {
    const [sign, look] = SIGNS[verdict] ?? ["", ""];
    said.className = `lsys-said ${look}`.trim();
    said.replaceChildren(made("span", { "aria-hidden": "true" }, `${sign} `), made("b", `${worded(verdict)}. `));
    message.split("\n").forEach((line, at) => said.append(line.startsWith("  ") ? made("pre", { tabindex: 0 }, line) : made(at ? "div" : "span", line)));
    if (picture) said.append(made("img", { style: "display: block", alt: described, src: `data:image/svg+xml,${encodeURIComponent(picture)}` }));
    more.hidden = !["Almost", "Not yet"].includes(verdict);
  }

  function form() {
    if (options.length) {
      return made("div.lsys-options", { role: "group", "aria-label": title }, ...options.map((letter) => made("button.lsys-option", { type: "button", "aria-pressed": String(letter === answer), onclick: (event) => {
        answer = letter;
        for (const each of event.currentTarget.parentElement.children) each.setAttribute("aria-pressed", String(each === event.currentTarget));
        check();
      } }, letter)));
    }
    const box = LINES.includes(kind) || template.includes("\n") ? made("textarea", { rows: Math.max(4, template.split("\n").length + 1), maxlength: 5000, spellcheck: "false", autocapitalize: "off" }) : made("input", { type: "text", maxlength: 5000, autocomplete: "off" });
    box.id = freshId();
    box.placeholder = template === "..." ? "" : template;
    box.value = answer;
    return made("form.exercise-answer", { oninput: () => { answer = box.value; keep(); }, onsubmit: (event) => {
      event.preventDefault();
      check();
    } }, made("label", { for: box.id }, worded("Your answer")), box, made("button", { type: "submit" }, worded("Check")));
  }

  const hint = made("button", { type: "button", hidden: !hints, onclick: () => check({ hint: (hinted = Math.min(hints, hinted + 1)) }) }, worded("A hint"));
  more.append(hint, made("button", { type: "button", onclick: () => check({ solution: true }) }, worded("The solution")));
  function open() {
    const before = (id && keptAnswer(key)) || {};
    answer = String(before.answer ?? "");
    place.replaceChildren(made("section.lsys-lesson", { "aria-label": `${worded("Exercise")} ${id || title}` }, form(), said, more));
    if (before.reply) show(before.reply);
  }

  open();
  if (id) addEventListener("storage", (event) => event.key?.endsWith(`: ${key}`) && open()); // another tab has kept an answer to it
}
