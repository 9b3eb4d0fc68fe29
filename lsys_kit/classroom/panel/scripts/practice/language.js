// The texts of a page in its language; each stands here in English, which is the id of its translation.

let words = {};

export function speak(given) {
  words = given ?? {};
}

// A text with values in the place of its names in braces.
export function say(text, values = {}) {
  return (words[text] ?? text).replace(/\{(\w+)\}/g, (_, name) => values[name]);
}
