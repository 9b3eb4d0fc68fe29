// The model's text, to be edited where the host reads it: mistakes are underlined where they stand, traced productions are lit.

import { clamped } from "../books/numbers.js";
import { button, made, worded } from "./controls.js";

const REST = 250; // milliseconds without a key after which a text is read

export function rulesView(parent, asked) {
  const backdrop = made("div.lsys-backdrop", { "aria-hidden": "true" });
  const area = made("textarea.lsys-rules", { spellcheck: "false", autocapitalize: "off", autocomplete: "off", "aria-label": worded("rules of the model") });
  const said = made("div.lsys-mistake", { role: "status", "aria-live": "polite" });
  const back = button(worded("back to the first rules"), worded("put back the rules with which the panel was opened"), () => put(first), { hidden: true });
  const notes = made("div.lsys-hint", { role: "status" });
  const shownOnly = made("div.lsys-caption", worded("This page only shows the rules; they can be changed in Jupyter."));
  parent.append(made("div.lsys-editor", backdrop, area), said, notes, back);
  let first = "", told = [], spans = [], waiting = 0, pasted = false, shown = "";

  function paint() {
    const text = area.value, parts = [];
    let at = 0;
    for (const { start, end, kind } of [...spans].sort((a, b) => a.start - b.start)) {
      if (start < at || start >= text.length + 1) continue;
      parts.push(text.slice(at, start), made(`mark.lsys-${kind}`, text.slice(start, Math.max(end, start + 1)) || " "));
      at = Math.max(end, start + 1);
    }
    backdrop.replaceChildren(...parts, text.slice(at), "\n");
    backdrop.scrollTop = area.scrollTop;
    backdrop.scrollLeft = area.scrollLeft;
  }

  function typed() {
    spans = [];
    paint();
    back.hidden = area.value === first;
    clearTimeout(waiting);
    waiting = setTimeout(() => asked(area.value), REST);
  }

  function put(text) {
    area.value = text;
    typed();
  }

  // What was pasted is put into the kit's notation as if it were typed, so that one press of undo brings it back.
  function rewrite(text) {
    pasted = false;
    if (text === area.value || document.activeElement !== area) return;
    area.setSelectionRange(0, area.value.length);
    if (!document.execCommand("insertText", false, text)) area.value = text;
    clearTimeout(waiting); // it is what was read
  }

  area.addEventListener("input", (event) => {
    pasted = event.inputType === "insertFromPaste" || event.inputType === "insertFromDrop";
    typed();
  });
  area.addEventListener("scroll", paint);

  // Nothing is wrong with the text; there may be notes on how it was read.
  function understood() {
    if (pasted && told[0]?.startsWith("Read as ")) rewrite(shown);
    spans = [];
    said.replaceChildren();
    notes.replaceChildren(...told.map((note) => made("div", note)));
    area.removeAttribute("aria-invalid");
    paint();
  }

  return {
    put,
    // The text of a model that was opened, and the notes on how it was read; one that was typed stays as it was typed.
    open(text, editable, noted) {
      told = noted;
      if (!editable) text = text.trimEnd();
      if (!first) first = text;
      area.readOnly = !editable;
      area.tabIndex = editable ? 0 : -1;
      said.hidden = !editable;
      if (!editable) notes.after(shownOnly);
      shown = text;
      if (area.value !== text && document.activeElement !== area) area.value = text;
      const lines = area.value.split("\n").length;
      area.rows = editable ? clamped(4, 18, lines + 1) : lines;
      back.hidden = area.value === first;
      understood();
    },
    understood,
    // What is wrong with the text, where it stands, and what to try; the notes are of another text.
    mistaken({ message, hint, line, start, end }) {
      notes.replaceChildren();
      spans = start === null || start === undefined ? [] : [{ start, end: end ?? start + 1, kind: "wrong" }];
      const where = line && area.value.includes("\n") ? `Line ${line}: ` : "";
      said.replaceChildren(made("strong", `${where}${message}.`), hint ? ` ${hint}` : "",
        made("div.lsys-caption", worded("What is shown is still that of the rules before.")));
      area.setAttribute("aria-invalid", "true");
      paint();
    },
    light(places) {
      if (area.hasAttribute("aria-invalid")) return;
      spans = places.map(([start, end]) => ({ start, end, kind: "applied" }));
      paint();
    },
    close: () => clearTimeout(waiting),
  };
}
