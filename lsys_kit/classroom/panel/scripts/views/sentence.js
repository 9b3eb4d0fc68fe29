// A sentence above the views in which numbers stand: the step, the angle and constants are dragged, typed or set by keys where
// they stand, and what is counted in the word follows.

import { clamped, times } from "../books/numbers.js";
import { made, slider, worded } from "./controls.js";

const PITCH = 6; // pixels of a drag from one value to the next
const MOST = 180; // so many values at most are passed in a drag; of more of them some are left out
const NUMBER = { // not in a sheet, which other pages would have in them too
  border: "0", borderBottom: "2px dashed var(--lsys-accent)", borderRadius: "0", padding: "0 2px", background: "none", color: "var(--lsys-accent)",
  font: "inherit", fontWeight: "600", textAlign: "center", cursor: "ew-resize", touchAction: "pan-y", minWidth: "2ch",
};
const ANGLES = times(1801, (i) => (i / 10).toString());

// Put the sentence of the model, if it has one, above all else; `goTo(step)` and, of other numbers, `move(name, index, text)`
// are called where one was moved.
export function sentenceView(root, host, goTo, move) {
  root.querySelector(":scope > .lsys-says")?.remove();
  const { sentence, constants } = host.get("model"), followers = [];
  if (!sentence) return null;
  root.prepend(made("p.lsys-says", { style: "font-size: 16px; line-height: 1.9; margin: 2px 0 8px; max-width: 75ch" }, ...sentence.map((part) => (typeof part === "string" ? part : number(part)))));

  function number(part) {
    const texts = { step: ["0"], angle: ANGLES }[part.name] ?? constants.find((each) => each.name === part.name)?.texts;
    return texts ? moved(part.name, texts) : counted(part);
  }

  function moved(name, texts) {
    const choose = name === "step" ? goTo : (at) => move(name, at, texts[at]);
    const control = slider(name, "", texts, 0, choose, name, { bar: false }), { element, box } = control;
    for (const each of element.querySelectorAll("label, .lsys-next")) each.remove();
    element.removeAttribute("data-control"); // as the one below has
    element.style.display = "inline-flex";
    Object.assign(box.style, NUMBER);
    box.setAttribute("aria-label", worded("{name}: drag it, type it, or use the arrow keys", { name }));
    box.title = box.ariaLabel;
    dragged(box, () => control.index, (at) => {
      const there = clamped(0, texts.length - 1, at);
      if (there === control.index) return;
      control.show(there);
      choose(there);
    }, () => Math.max(1, Math.floor(texts.length / MOST)));
    followers.push((book, at) => {
      if (name === "step" && texts.length !== book.steps + 1) control.offer((texts = times(book.steps + 1, String)), at);
      else control.show(name === "step" ? at : name === "angle" ? Math.round(host.get("angle") * 10) : texts.indexOf(host.get("settings")[name]));
      box.style.width = `${texts[control.index].length + 1}ch`;
    });
    return element;
  }

  function counted({ value, symbol, all }) {
    const found = made("b", value ?? "");
    const isOf = ([letter, subscript]) => letter === symbol[0] && subscript === symbol[1];
    if (all || symbol) followers.push((book, at) => {
      const { states, symbols } = book.data;
      const many = all ? book.length(at) : book.counts(at).reduce((sum, count, state) => sum + (isOf(symbols[states[state][0]]) ? count : 0), 0);
      found.textContent = many.toLocaleString("en");
    });
    return found;
  }

  return { show: (book, at) => followers.forEach((follow) => follow(book, at)) };
}

// A number that the mouse or a finger drags to the right and back; a click or tap alone enters it, as any box.
function dragged(box, index, choose, jump) {
  let grip = null;
  box.addEventListener("pointerdown", (event) => {
    grip = { x: event.clientX, index: index(), moves: false };
    box.setPointerCapture(event.pointerId);
  });
  box.addEventListener("pointermove", (event) => {
    if (!grip || !(event.buttons & 1)) return (grip = null);
    const far = Math.trunc((event.clientX - grip.x) / PITCH);
    if (!far && !grip.moves) return;
    if (!grip.moves) box.blur();
    grip.moves = true;
    choose(grip.index + far * jump());
  });
  for (const each of ["pointerup", "pointercancel"]) box.addEventListener(each, () => (grip = null));
}
