// Texts in the language of a panel or page; in the scripts they stand in English, which is the id of their translation.

const words = {};

export const speak = (given) => Object.assign(words, given);

// A text with values in the place of its names in braces.
export function worded(text, values = {}) {
  return (words[text] ?? text).replace(/\{(\w+)\}/g, (_, name) => values[name]);
}
