// What the questions of a lesson share: their frame, their texts, of which all becomes text nodes, and a kernel that may be gone.

import { saved, whenGone } from "../panels/kernel.js";
import { made, ownKeys, speak, worded } from "../views/controls.js";
import { ownName } from "../views/landmarks.js";

export function prose(text) {
  const found = made("span.mathjax_ignore.tex2jax_ignore");
  for (const part of text.split(/(`[^`]+`|\*[^*]+\*)/)) {
    if (part.length > 2 && part.startsWith("`") && part.endsWith("`")) found.append(made("code", part.slice(1, -1)));
    else if (part.length > 2 && part.startsWith("*") && part.endsWith("*")) found.append(made("i", part.slice(1, -1)));
    else if (part) found.append(part);
  }
  return found;
}

// The same text without these marks, for names that are read out.
export function plain(text) {
  return text.replace(/`([^`]+)`|\*([^*]+)\*/g, "$1$2");
}

// Build a question in a cell's output. `build` is given the frame and returns what is to be told after a change of some traits
// of the model; `render` returns how all of it is undone.
export function question(model, el, name, traits, build) {
  speak(model.get("words"));
  const root = made("section.lsys-lesson");
  root.setAttribute("aria-label", ownName(root, worded(name)));
  el.append(root);
  const tell = build(root), release = ownKeys(root), unheard = whenGone(model);
  for (const trait of traits) model.on(`change:${trait}`, tell);
  tell();
  return () => {
    for (const trait of traits) model.off(`change:${trait}`, tell);
    release();
    unheard();
    root.remove();
  };
}

// Tell the kernel what was done, or say in `status` that there is none.
export function tellModel(model, values, status) {
  for (const [name, value] of Object.entries(values)) model.set(name, value);
  if (!saved(model)) status.replaceChildren(worded("The kernel does not answer. Run the cell again."));
}

const PAUSE = 300; // milliseconds without a key after which what is typed is kept

// A function that calls another when nothing was typed for a while.
export function afterPause(handler) {
  let waiting = 0;
  const later = () => {
    clearTimeout(waiting);
    waiting = setTimeout(handler, PAUSE);
  };
  later.cancel = () => clearTimeout(waiting);
  return later;
}

// A quiet button that takes back what was answered; it is there where something was.
export const againButton = (pressed) => made("button.lsys-again", { type: "button", hidden: true, onclick: pressed }, worded("Start again"));

// What was predicted, and beside it what came out, if that is known.
/** @param {string} typed @param {{ answer?: string, right?: boolean }} outcome */
export function predictedBeside(typed, { answer, right }) {
  const said = typed ? made("div", `${worded("You said:")} `, typedText(typed)) : made("div", worded("You wanted to see it."));
  return answer ? [said, made("div", right ? made("b.lsys-came", "✓ ") : "", `${worded("The answer:")} `, made("b", prose(answer)))] : [said];
}

const typedText = (text) => made("b.mathjax_ignore.tex2jax_ignore", text);
