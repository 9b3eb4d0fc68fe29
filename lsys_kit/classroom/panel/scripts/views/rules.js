// The model's text, to be edited where the host reads it: mistakes are underlined where they stand, traced productions are lit.

import { clamped } from "../books/numbers.js";
import { button, made, worded } from "./controls.js";
import { resuming } from "./resuming.js";
import { undoing } from "./undoing.js";

const NONE = { note() {}, open: (_, __, text) => text, keep() {}, close() {}, tools: [], element: "" }; // on pages, where rules are only shown
const REST = 250; // milliseconds without a key after which a text is read

// `asked` is called with a text that is to be read, and with what `state` was when it was left, if it was there before.
export function rulesView(parent, asked, state) {
  const backdrop = made("div.lsys-backdrop", { "aria-hidden": "true" });
  const area = made("textarea.lsys-rules", { spellcheck: "false", autocapitalize: "off", autocomplete: "off", "aria-label": worded("rules of the model") });
  const said = made("div.lsys-mistake", { role: "status", "aria-live": "polite" });
  const back = button(worded("back to the first rules"), worded("put back the rules with which the panel was opened"), putBack, { hidden: true });
  const notes = made("div.lsys-hint", { role: "status" });
  const shownOnly = made("div.lsys-caption", worded("This page only shows the rules; they can be changed in Jupyter."));
  const history = undoing?.(area, (_, state) => typed(state), state) ?? NONE, resumed = resuming?.(put) ?? NONE;
  const tools = made("div.lsys-changes", ...history.tools, back);
  parent.append(made("div.lsys-editor", backdrop, area), said, notes, tools);
  let first = "", told = [], spans = [], waiting = 0, pasted = false, shown = "", reading = false;

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

  function typed(state = null) {
    spans = [];
    paint();
    back.hidden = area.value === first;
    resumed.keep(area.value);
    clearTimeout(waiting);
    reading = true;
    waiting = setTimeout(() => {
      waiting = 0;
      asked(area.value, state);
    }, REST);
  }

  function put(text) {
    area.value = text;
    history.note();
    typed();
  }

  function putBack() {
    put(first);
    history.tools[0].focus(); // the button is hidden now
  }

  // What was pasted is put into the kit's notation, as a change of its own, so that one press of undo brings it back.
  function rewrite(text) {
    pasted = false;
    if (text === area.value || document.activeElement !== area) return;
    area.value = text;
    history.note();
    resumed.keep(text, text);
  }

  area.addEventListener("input", (event) => {
    pasted = event.inputType === "insertFromPaste" || event.inputType === "insertFromDrop";
    history.note(event);
    typed();
  });
  area.addEventListener("scroll", paint);

  // The text that was typed last was read, and nothing is wrong with it.
  function understood() {
    if (waiting) return; // another text follows
    reading = false;
    if (area.value !== first) resumed.keep(area.value, shown);
    fine();
  }

  // There may be notes on how the text was read.
  function fine() {
    if (pasted && told[0]?.startsWith("Read as ")) rewrite(shown);
    spans = [];
    said.replaceChildren();
    notes.replaceChildren(...told.map((note) => made("div", note)));
    area.removeAttribute("aria-invalid");
    paint();
  }

  return {
    put, offer: resumed.element,
    // The text of a model that was opened, the notes on how it was read, with which rules and where the panel was opened; what was
    // typed stays as it was typed.
    open(text, editable, noted, opened, standing) {
      told = noted;
      if (!editable) text = text.trimEnd();
      shown = text;
      if (!first) {
        first = opened;
        if (editable) text = resumed.open(first, standing, text);
      }
      area.readOnly = !editable;
      area.tabIndex = editable ? 0 : -1;
      said.hidden = !editable;
      if (!editable) notes.after(shownOnly);
      if (area.value !== text && !reading) area.value = text;
      history.note();
      tools.hidden = !editable;
      const lines = area.value.split("\n").length;
      area.rows = editable ? clamped(4, 18, lines + 1) : lines;
      back.hidden = area.value === first;
      fine();
    },
    understood,
    // What is wrong with the text, where it stands, and what to try; the notes are of another text.
    mistaken({ message, hint, line, start, end }) {
      if (waiting) return;
      reading = false;
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
    close() {
      clearTimeout(waiting);
      history.close();
    },
  };
}
