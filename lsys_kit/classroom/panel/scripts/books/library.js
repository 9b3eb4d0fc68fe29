// The books of one model, by their settings: each is asked for at most once. Another model has a library of its own.

import { openBook } from "./book.js";

const MOST_BYTES = 2e6; // of books that were fetched before anybody asked for them
const LONGEST = 400; // milliseconds of fetching such books, after which no other is begun

export function library(host) {
  const books = new Map();
  let fetched = 0, fetching = 0;

  const keyOf = (settings) => JSON.stringify([Object.entries(settings.constants).sort(), settings.seed]);

  function keep(settings, data) {
    const key = keyOf(settings);
    if (!books.has(key)) fetched += JSON.stringify(data).length;
    books.set(key, openBook(data));
    return books.get(key);
  }

  async function book(settings) {
    const known = books.get(keyOf(settings));
    if (known) return { book: known };
    const answer = await host.book(settings);
    return answer.book ? { book: keep(settings, answer.book) } : { mistake: answer.mistake };
  }

  // Fetch the books of the settings that are one movement of a slider away while nothing else happens; what is fetched later ends it.
  async function fetchAhead(asked, sliders) {
    const number = ++fetching, begun = performance.now();
    for (const settings of neighbours(asked, sliders)) {
      if (number !== fetching || fetched > MOST_BYTES || performance.now() - begun > LONGEST) return;
      if (!books.has(keyOf(settings))) await book(settings);
    }
  }

  function close() {
    fetching += 1;
  }

  return { book, keep, fetchAhead, close, known: (settings) => books.get(keyOf(settings)) };
}

// The settings that one movement of a slider leads to.
function neighbours(asked, sliders) {
  return sliders.flatMap((each) => [1, -1].map((way) => each.control.index + way).filter((index) => index >= 0 && index < each.texts.length)
    .map((index) => ({ ...asked, constants: { ...asked.constants, [each.name]: each.texts[index] } })));
}
