// Which lessons are done, kept by the browser for all pages of the course.

import { made } from "../views/controls.js";
import { keepAnswer, keptAnswer } from "./keeping.js";

const keyOf = (lesson) => `done ${lesson}`;

export const isDone = (lesson) => keptAnswer(keyOf(lesson)) === true;

export const markDone = (lesson, done) => keepAnswer(keyOf(lesson), done || null);

// A box to be ticked for a lesson, with a text beside it and a name of its own; `show` looks whether it is done. `changed` is called
// when a person has ticked it.
export function doneBox(lesson, text, name, changed = () => {}) {
  const box = made("input", { type: "checkbox", "aria-label": name, onchange: () => { markDone(lesson, box.checked); changed(); } });
  const show = () => { box.checked = isDone(lesson); };
  show();
  return { element: made("label.done", box, text), show };
}

// Call a function whenever another page may have marked a lesson: in another tab, or before one came back to this one.
export function whenMarked(told) {
  addEventListener("storage", told);
  addEventListener("pageshow", told);
}
