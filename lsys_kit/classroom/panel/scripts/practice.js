// A page of exercises that needs no kernel: answers are checked on it, and a learning platform is told how many are solved.

import { unpacked } from "./books/packed.js";
import { connected, platformOf } from "./practice/platform.js";
import { read } from "./practice/typed.js";
import { made, speak, worded } from "./views/controls.js";

const VERDICTS = { "Correct": ["✓", "lsys-right"], "Almost": ["≈", "lsys-almost"], "Not yet": ["✗", "lsys-wrong"], "Not readable yet": ["?"],
  "Not answered yet": ["○"] };

export function openPracticePage() {
  const { exercises, words } = JSON.parse(document.getElementById("lsys-data").textContent);
  speak(words);
  const platform = connected(platformOf(window)), before = platform.known() ?? { solved: [], typed: {} };
  const ids = exercises.map(({ id }) => id), solved = new Set(before.solved);
  document.querySelectorAll("[data-exercise]").forEach((place, number) => {
    const data = exercises[number];
    openExercise(place, data, solved.has(data.id), before.typed[data.id] ?? "", (text, isRight) => {
      const isNew = isRight && !solved.has(data.id);
      if (isNew) solved.add(data.id);
      const known = ids.filter((id) => solved.has(id)), told = platform.tell({ [data.id]: text }, known, isNew ? ids.length : 0);
      show(platform, known, ids.length, told);
    });
  });
  window.addEventListener("pagehide", platform.finish);
  window.addEventListener("pageshow", (event) => event.persisted && window.location.reload());
  show(platform, ids.filter((id) => solved.has(id)), ids.length, platform.known() !== null);
}

function show(platform, solved, total, told) {
  const { score, completed } = platform.known() ?? {};
  const known = completed ? "The learning platform knows: score {score} of 100, completed."
    : "The learning platform knows: score {score} of 100, incomplete.";
  const unknown = !platform.there ? "No learning platform is there: nobody is told."
    : platform.isOpen() && !platform.known() ? "The learning platform cannot be read, so that nothing is written there."
      : "The learning platform did not take the score.";
  const whom = told ? worded(known, { score }) : worded(unknown);
  const count = worded("{number} of {total} solved.", { number: solved.length, total });
  document.getElementById("told").replaceChildren(made("b", count), ` ${whom}`);
}

// `typed` is what was typed before; `tried` is called with what is typed now, and whether it is right.
function openExercise(place, data, before, typed, tried) {
  const status = place.querySelector("[role=status]"), more = hints(place.querySelector("[data-hints]"), data.hints);
  const replies = repliesOf(data), buttons = place.querySelectorAll("[data-key]"), box = place.querySelector("input");
  const answer = async (text) => {
    const verdict = verdictOn(data, await replies, text);
    showVerdict(status, verdict);
    tried(text, verdict.said === "Correct");
    if (["Not yet", "Almost"].includes(verdict.said)) more();
  };
  if (before) showVerdict(status, { said: "Correct", message: worded("You solved this before.") });
  const press = (key) => buttons.forEach((each) => each.setAttribute("aria-pressed", String(each.dataset.key === key)));
  for (const button of buttons) {
    button.addEventListener("click", () => {
      press(button.dataset.key);
      answer(button.dataset.key);
    });
  }
  if (typed) press(typed);
  if (box) box.value = typed;
  place.querySelector("form")?.addEventListener("submit", (event) => {
    event.preventDefault();
    answer(box.value);
  });
}

const repliesOf = async ({ replies }) => new Map(Object.entries(JSON.parse(await unpacked(replies))));

function verdictOn(data, replies, text) {
  if (!text.trim() || /\.\.\.|…/.test(text)) return { said: "Not answered yet", message: "" };
  const { key, unreadable } = read(data, text);
  if (unreadable) return { said: "Not readable yet", message: unreadable };
  const [said, message, picture = ""] = replies.get(key) ?? ["Not yet", data.otherwise];
  return { said, message, ...(picture && { picture }) };
}

function showVerdict(status, { said, message, picture = "" }) {
  const [sign, look = ""] = VERDICTS[said];
  status.className = `lsys-said ${look}`;
  status.replaceChildren(made("span", { "aria-hidden": "true" }, `${sign} `), made("b", `${worded(said)}. `));
  for (const line of message.split("\n")) status.append(line.startsWith("  ") ? made("pre", { tabindex: 0 }, line) : made("span", `${line} `));
  if (picture) status.append(made("img", { alt: "", src: `data:image/svg+xml,${encodeURIComponent(picture)}` }));
}

// A button that shows one hint more, from the first try on.
function hints(place, texts) {
  let shown = 0;
  const label = () => worded("Hint {number} of {total}", { number: shown + 1, total: texts.length });
  const list = made("ol"), button = made("button", { type: "button", onclick: another }, label());
  function another() {
    list.append(made("li", texts[shown++]));
    button.textContent = label();
    if (shown === texts.length) button.remove();
  }
  return () => texts.length && !place.childElementCount && place.append(list, button);
}
