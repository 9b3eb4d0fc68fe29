// What the questions of a lesson share: their frame, their texts, of which all becomes text nodes, and a kernel that may be gone.

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
  const tell = build(root), release = ownKeys(root);
  for (const trait of traits) model.on(`change:${trait}`, tell);
  tell();
  return () => {
    for (const trait of traits) model.off(`change:${trait}`, tell);
    release();
    root.remove();
  };
}

// Tell the kernel what was done, or say in `status` that there is none.
export function tellModel(model, values, status) {
  for (const [name, value] of Object.entries(values)) model.set(name, value);
  model.save_changes();
  if (model.comm_live === false) status.replaceChildren(worded("The kernel does not answer. Run the cell again."));
}
