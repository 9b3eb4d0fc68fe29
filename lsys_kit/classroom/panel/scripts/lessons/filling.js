// A table to fill. The model checks it: it says which cells are right, and what wrong entries show. What is typed is kept at once.

import { LONGEST_ENTRY } from "../drawing/constants.js";
import { freshId, made, worded } from "../views/controls.js";
import { afterPause, againButton, plain, prose, question, tellModel } from "./asking.js";

const SIGNS = { "right": "✓", "not yet": "✗", "no number": "?", "not filled in yet": "○" };

export function askForEntries({ model, el }) {
  return question(model, el, "table to fill", ["typed", "result"], (root) => {
    const { title, columns, rows } = model.get("sheet"), boxes = [], marks = [];
    const status = made("div.lsys-said", { role: "status" });
    const entries = () => boxes.map((box) => box.value);

    function keep() {
      later.cancel();
      tellModel(model, { typed: entries() }, status);
    }

    const later = afterPause(keep);

    function filled(row, column) {
      const mark = made("span.lsys-mark", { id: freshId() });
      const box = made("input", {
        type: "text", size: 8, maxlength: LONGEST_ENTRY, autocomplete: "off", "aria-describedby": mark.id,
        "aria-label": `${plain(columns[0])} ${plain(row[0])}: ${plain(columns[column])}`,
        oninput: () => {
          shown(box, mark, "");
          later();
        },
        onchange: keep,
      });
      boxes.push(box);
      marks.push(mark);
      return made("td", box, mark);
    }

    const lines = rows.map((row) => made("tr", ...row.map((cell, column) =>
      cell === null ? filled(row, column) : made(column ? "td" : "th", column ? {} : { scope: "row" }, prose(cell)))));
    const table = made("table", made("caption", prose(title)),
      made("thead", made("tr", ...columns.map((name) => made("th", { scope: "col" }, prose(name))))),
      made("tbody", ...lines));
    const again = againButton(() => {
      later.cancel();
      for (const box of boxes) box.value = "";
      tellModel(model, { typed: entries(), asked: {} }, status);
      boxes[0].focus();
    });
    const form = made("form.lsys-sheet", { onsubmit: (event) => {
      event.preventDefault();
      later.cancel();
      const number = (model.get("result").number ?? 0) + 1;
      tellModel(model, { typed: entries(), asked: { number, entries: entries() } }, status);
    } }, made("div.lsys-scroll", table), made("div.lsys-actions", made("button", { type: "submit" }, worded("Check")), again));
    root.append(form, status);

    return () => {
      const typed = model.get("typed") ?? [], { marks: said = [], text = "", notes = [], first = [] } = model.get("result");
      const checked = model.get("asked").entries ?? [];
      boxes.forEach((box, number) => {
        if (document.activeElement !== box) box.value = typed[number] ?? "";
        shown(box, marks[number], box.value === (checked[number] ?? "") ? said[number] : "", earlier(said[number], first[number], box.value));
      });
      again.hidden = !typed.some(Boolean);
      status.replaceChildren(...(text ? [made("p", text)] : []), ...(notes.length ? [made("ul", ...notes.map((note) => made("li", note)))] : []));
    };
  });
}

// The first entry of a cell that is right now, if it was another one.
const earlier = (mark, first, now) => (mark === "right" && first && first.replace(/\s/g, "") !== now.replace(/\s/g, "") ? worded("first you said {entry}", { entry: first }) : "");

function shown(box, mark, word = "", before = "") {
  mark.textContent = word ? [`${SIGNS[word]} ${worded(word)}`, before].filter(Boolean).join("; ") : "";
  mark.dataset.mark = word;
  box.setAttribute("aria-invalid", String(word === "not yet" || word === "no number"));
}

export default { render: askForEntries };
