// A table to fill. The model checks it, and says of each cell no more than whether it is right.

import { LONGEST_ENTRY } from "../drawing/constants.js";
import { freshId, made, worded } from "../views/controls.js";
import { plain, prose, question, tellModel } from "./asking.js";

const SIGNS = { "right": "✓", "not yet": "✗", "not filled in yet": "○" };

export function askForEntries({ model, el }) {
  return question(model, el, "table to fill", ["result"], (root) => {
    const { title, columns, rows } = model.get("sheet"), boxes = [], marks = [];
    const status = made("p.lsys-said", { role: "status" });

    function filled(row, column) {
      const mark = made("span.lsys-mark", { id: freshId() });
      const box = made("input", {
        type: "text", size: 8, maxlength: LONGEST_ENTRY, autocomplete: "off", "aria-describedby": mark.id,
        "aria-label": `${plain(columns[0])} ${plain(row[0])}: ${plain(columns[column])}`, oninput: () => shown(box, mark, ""),
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
    const form = made("form.lsys-sheet", { onsubmit: (event) => {
      event.preventDefault();
      const number = (model.get("result").number ?? 0) + 1;
      tellModel(model, { asked: { number, entries: boxes.map((box) => box.value) } }, status);
    } }, made("div.lsys-scroll", table), made("button", { type: "submit" }, worded("Check")));
    root.append(form, status);

    return () => {
      const { marks: said = [], text = "" } = model.get("result");
      status.textContent = text;
      said.forEach((word, number) => shown(boxes[number], marks[number], word));
    };
  });
}

function shown(box, mark, word) {
  mark.textContent = word ? `${SIGNS[word]} ${worded(word)}` : "";
  mark.dataset.mark = word;
  box.setAttribute("aria-invalid", String(word === "not yet"));
}

export default { render: askForEntries };
