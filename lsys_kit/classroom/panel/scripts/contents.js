// The first page of the course: a picture of each lesson, and which of them are done.

import { doneBox, isDone, whenMarked } from "./lessons/done.js";
import { openParts } from "./parts.js";
import { made, speak, worded } from "./views/controls.js";

export function openContents() {
  speak(JSON.parse(document.getElementById("lsys-data").textContent).words);
  const found = /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-lesson]"));
  showDone(document.getElementById("done"), [...found]);
  return openParts({}, (fault) => String(fault));
}

function showDone(told, rows) {
  const boxes = rows.map((row) => doneBox(row.dataset.lesson, worded("done"), `${row.dataset.title}: ${worded("done")}`, show));
  rows.forEach((row, i) => row.querySelector(".facts").append(" · ", boxes[i].element));

  function show() {
    for (const box of boxes) box.show();
    for (const row of rows) row.toggleAttribute("data-done", isDone(row.dataset.lesson));
    const many = rows.filter((row) => row.hasAttribute("data-done")).length, next = rows.find((row) => !row.hasAttribute("data-done"));
    told.hidden = !many;
    told.replaceChildren(worded("You have done {many} of {all} lessons.", { many, all: rows.length }), ...(next ? [` ${worded("Go on with")} `, linkTo(next), "."] : []));
  }

  whenMarked(show);
  show();
}

function linkTo(row) {
  const link = row.querySelector("h3 a"), number = row.querySelector("h3 span");
  return made("a", { href: link.getAttribute("href") }, [number, link].filter(Boolean).map((each) => each.textContent).join(" · "));
}
