// A book that the kernel has sent, opened at any step: its words, how often each state occurs, mothers and daughters.
//
// Where a state alone decides what becomes of it, words are made here, each by copying successors from a table; where chance decides
// besides, they are thrown at a seed (chance.js); other books hold the words. A module that was there when several were replaced together counts as a mother with them.
//
// The books of one model are kept by their settings: each is asked for at most once, and one that is thrown serves all seeds. Another model
// has a library of its own.

import { thrown } from "./chance.js";
import { withFormulas } from "../views/letters.js";
import { whole } from "./numbers.js";

const HELD = 4_000_000; // modules of words that are kept

export function openBook(given) {
  const data = given.choices ? thrown(given) : given, { states, steps } = data, settled = "successors" in data;
  const table = settled && rowsOf(data.successors), lengths = new Float64Array(steps + 1).fill(-1);
  const words = kept((step) => (settled ? expanded(step) : whole(data.words[step])));
  const starts = kept((step) => summed(settled ? spread(words(step)) : whole(data.daughters[step])));
  const made = kept((step) => (settled ? null : whole(data.made[step])));
  const together = kept((step) => (data.together?.length ? whole(data.together[step]) : null));
  const labels = states.map(() => null);
  let counted = [];

  function expanded(step) {
    if (step === 0) return Int32Array.from(data.axiom);
    return replaced(words(step - 1), table, length(step));
  }

  function spread(word) {
    const sizes = new Int32Array(word.length);
    for (let i = 0; i < word.length; i++) sizes[i] = table.starts[word[i] + 1] - table.starts[word[i]];
    return sizes;
  }

  function counts(step) {
    if (settled) {
      if (!counted.length) counted = [occurring(data.axiom, states.length)];
      while (counted.length <= step) counted.push(following(counted[counted.length - 1], table));
      return counted[step];
    }
    return occurring(words(step), states.length);
  }

  function length(step) {
    if (lengths[step] < 0) lengths[step] = settled ? counts(step).reduce((sum, count) => sum + count, 0) : words(step).length;
    return lengths[step];
  }

  function tokens(step) {
    if (data.tokens) return data.tokens[step];
    const found = new Array(data.net.names.length).fill(0);
    counts(step).forEach((count, state) => {
      if (states[state][2] >= 0) found[states[state][2]] += count;
    });
    return found;
  }

  // The position, in the word before, of the module from which a module comes; -1 for those of the axiom, and for what comes
  // from no single one.
  function mother(step, position) {
    if (!step) return -1;
    const ends = starts(step - 1);
    return position < ends[ends.length - 1] ? lastUpTo(ends, position) : -1;
  }

  // The positions, from the first up to but without the last, of what a module becomes; null beyond the book.
  function daughters(step, position) {
    if (step >= steps) return null;
    let first = position;
    const sizes = together(step), ends = starts(step);
    while (sizes && first && !sizes[first]) first--;
    return [ends[first], ends[first + 1]];
  }

  // The number of the production that made a module; -1 where it stayed as it was, or stands in the axiom.
  function production(step, position) {
    if (!step) return -1;
    const from = mother(step, position);
    if (from < 0) return -1;
    return settled ? data.applied[words(step - 1)[from]] : made(step - 1)[from];
  }

  function label(state) {
    if (!labels[state]) {
      const [symbol, values, , text, formula, numbers = ""] = states[state], [letter, subscript, colour, steering] = data.symbols[symbol];
      labels[state] = { letter, subscript, values, text, formula, numbers, colour, steering: steering === 1, walls: wallsOf(state) };
    }
    return labels[state];
  }

  // Of a cell of a cellwork its walls: the label and the colour of each, and the edges around it; nothing of anything else.
  function wallsOf(state) {
    return data.around?.[state - (states.length - data.around.length)]?.map(([wall, edges]) => [...data.walls[wall], edges]) ?? [];
  }

  return {
    data, steps, word: words, length, counts, tokens, mother, daughters, production, label,
    lengths: () => Array.from(lengths, (_, step) => length(step)),
  };
}

// The results of a function of the step, the latest of them kept: no more of them than so many numbers.
function kept(made) {
  const known = new Map();
  let held = 0;
  return (step) => {
    if (!known.has(step)) {
      const found = made(step);
      held += found?.length ?? 0;
      for (const [old, row] of known) {
        if (held <= HELD) break;
        held -= row?.length ?? 0;
        known.delete(old);
      }
      known.set(step, found);
    }
    return known.get(step);
  };
}

function rowsOf(rows) {
  return { starts: summed(rows.map((row) => row.length)), numbers: Int32Array.from(rows.flat()) };
}

// The sums of some numbers up to each of them, from 0.
function summed(numbers) {
  const sums = new Int32Array(numbers.length + 1);
  for (let i = 0; i < numbers.length; i++) sums[i + 1] = sums[i] + numbers[i];
  return sums;
}

function replaced(word, { starts, numbers }, length) {
  const found = new Int32Array(length);
  let at = 0;
  for (let i = 0; i < word.length; i++) {
    const end = starts[word[i] + 1];
    for (let j = starts[word[i]]; j < end; j++) found[at++] = numbers[j];
  }
  return found;
}

function occurring(word, many) {
  const found = new Float64Array(many);
  for (const state of word) found[state]++;
  return found;
}

function following(counts, { starts, numbers }) {
  const found = new Float64Array(counts.length);
  for (let state = 0; state < counts.length; state++)
    if (counts[state]) for (let j = starts[state]; j < starts[state + 1]; j++) found[numbers[j]] += counts[state];
  return found;
}

// The last place whose start is not beyond a position.
function lastUpTo(starts, position) {
  let low = 0, high = starts.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (starts[middle] <= position) low = middle;
    else high = middle;
  }
  return low;
}

const MOST_BYTES = 2e6; // of books that were fetched before anybody asked for them
const MOST_THROWN = 20; // books of other seeds that are kept
const LONGEST = 400; // milliseconds of fetching such books, after which no other is begun

export function library(host) {
  const books = new Map(), sown = [];
  let fetched = 0, fetching = 0;

  const keyOf = (settings) => JSON.stringify([Object.entries(settings.constants).sort(), settings.seed, settings.letters]);

  function keep(settings, data) {
    const key = keyOf(settings);
    if (!books.has(key)) fetched += JSON.stringify(data).length;
    if (data.choices) {
      books.set(keyOf({ ...settings, seed: null }), data);
      if (Number(data.seed) !== settings.seed) return known(settings); // it stands for all seeds
    }
    books.set(key, openBook(settings.letters?.length ? withFormulas(data) : data));
    return books.get(key);
  }

  // A book that there is, or that is thrown from one of another seed.
  function known(settings) {
    const key = keyOf(settings), data = books.get(key) ?? books.get(keyOf({ ...settings, seed: null }));
    if (!data?.choices) return data;
    if (sown.push(key) > MOST_THROWN) books.delete(sown.shift());
    books.set(key, openBook({ ...data, seed: settings.seed }));
    return books.get(key);
  }

  async function book(settings) {
    const there = known(settings);
    if (there) return { book: there };
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

  return { book, keep, fetchAhead, close, known };
}

// The settings that one movement of a slider leads to.
function neighbours(asked, sliders) {
  return sliders.flatMap((each) => [1, -1].map((way) => each.control.index + way).filter((index) => index >= 0 && index < each.texts.length)
    .map((index) => ({ ...asked, constants: { ...asked.constants, [each.name]: each.texts[index] } })));
}
