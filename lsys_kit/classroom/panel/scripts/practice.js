// A page of exercises that needs no kernel: answers are checked on it, and a learning platform is told how many are solved.

import { made } from "./views/controls.js";
import { worded, speak } from "./views/language.js";
import { connected, platformOf, scoreOf } from "./practice/platform.js";
import { replyTo } from "./practice/sealed.js";
import { read } from "./practice/typed.js";

const LOOKS = { Correct: "lsys-right", Almost: "lsys-almost", "Not yet": "lsys-wrong" };
const SIGNS = { Correct: "✓", Almost: "≈", "Not yet": "✗", "Not readable yet": "?", "Not answered yet": "○" };

export function openPracticePage() {
  const { exercises, words } = JSON.parse(document.getElementById("lsys-data").textContent);
  speak(words);
  const platform = connected(platformOf(window)), solved = new Set(platform.solved());
  const ids = exercises.map(({ id }) => id);
  const report = () => show(platform, ids.filter((id) => solved.has(id)), ids.length);
  document.querySelectorAll("[data-exercise]").forEach((place, number) => {
    const data = exercises[number];
    openExercise(place, data, solved.has(data.id), () => {
      solved.add(data.id);
      report();
    });
  });
  window.addEventListener("pagehide", platform.finish);
  window.addEventListener("pageshow", (event) => event.persisted && window.location.reload());
  report();
}

// Say how many exercises are solved, here and to the platform.
function show(platform, solved, total) {
  const told = platform.tell(solved, total), score = scoreOf(solved.length, total);
  const known = solved.length === total ? "The learning platform knows: score {score} of 100, completed."
    : "The learning platform knows: score {score} of 100, incomplete.";
  const whom = told ? worded(known, { score })
    : worded(platform.there ? "The learning platform did not take the score." : "No learning platform is there: nobody is told.");
  const count = worded("{number} of {total} solved.", { number: solved.length, total });
  document.getElementById("told").replaceChildren(made("b", {}, count), ` ${whom}`);
}

function openExercise(place, data, before, solved) {
  const status = place.querySelector("[role=status]"), more = hints(place.querySelector("[data-hints]"), data.hints);
  const answer = (text) => {
    const verdict = verdictOn(data, text);
    showVerdict(status, verdict);
    if (verdict.said === "Correct") solved();
    if (["Not yet", "Almost"].includes(verdict.said)) more();
  };
  if (before) showVerdict(status, { said: "Correct", message: worded("You solved this before.") });
  for (const button of place.querySelectorAll("[data-key]")) {
    button.addEventListener("click", () => {
      for (const each of place.querySelectorAll("[data-key]")) each.setAttribute("aria-pressed", String(each === button));
      answer(button.dataset.key);
    });
  }
  place.querySelector("form")?.addEventListener("submit", (event) => {
    event.preventDefault();
    answer(place.querySelector("input").value);
  });
}

function verdictOn(data, text) {
  if (!text.trim() || /\.\.\.|…/.test(text)) return { said: "Not answered yet", message: "" };
  const { key, unreadable } = read(data, text);
  if (unreadable) return { said: "Not readable yet", message: unreadable };
  return replyTo(data, key) ?? { said: "Not yet", message: data.otherwise };
}

function showVerdict(status, { said, message }) {
  status.className = `lsys-said ${LOOKS[said] ?? ""}`;
  status.replaceChildren(made("span", { "aria-hidden": "true" }, `${SIGNS[said]} `), made("b", {}, `${worded(said)}. `));
  message.split("\n").forEach((line) => status.append(line.startsWith("  ") ? made("pre", {}, line) : made("span", {}, `${line} `)));
}

// A button that shows one hint more, from the first try on.
function hints(place, texts) {
  let shown = 0;
  const label = () => worded("Hint {number} of {total}", { number: shown + 1, total: texts.length });
  const list = made("ol", {}), button = made("button", { type: "button", onclick: another }, label());
  function another() {
    list.append(made("li", {}, texts[shown++]));
    button.textContent = label();
    if (shown === texts.length) button.remove();
  }
  return () => texts.length && !place.childElementCount && place.append(list, button);
}
