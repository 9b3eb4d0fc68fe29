// Texts of a lesson: a part between backticks is code, and one between asterisks is emphasised. All of it becomes text nodes.

import { made } from "../views/controls.js";

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
