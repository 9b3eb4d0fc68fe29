// Chance in the browser: a book that says what each state may become is thrown at any seed, as the kernel throws it.
//
// The random number of a module belongs to the seed, the step and its position (derivation/core/chance.py): splitmix64, in halves.
// A page without chance has none of this.

import { worded } from "../views/controls.js";

const UNIT = 2 ** -53;
const MOST_SHARES = 4_000, MOST_PRODUCTS = 2e7; // of an exact distribution
let high = 0, low = 0; // of the last number

// Throw the dice of a book: its data with words, with how many each module becomes, and by which production.
export function thrown(data) {
  const words = [Int32Array.from(data.axiom)], daughters = [], made = [], { choices, steps } = data;
  while (words.length <= steps) {
    const word = words.at(-1), chosen = optionsOf(choices, word, data.seed, words.length - 1), rows = chosen.map((option, i) => choices[word[i]][3][option].length);
    const length = rows.reduce((sum, each) => sum + each, 0);
    if (length > data.most) break;
    const next = new Int32Array(length);
    let at = 0;
    word.forEach((state, i) => {
      for (const each of choices[state][3][chosen[i]]) next[at++] = each;
    });
    words.push(next);
    daughters.push(rows);
    made.push(chosen.map((option, i) => choices[word[i]][2][option]));
  }
  const last = words.length - 1, end = last < steps ? worded("At this seed step {step} has too many modules for the panel.", { step: last + 1 }) : data.end;
  return { ...data, words, daughters, made, steps: last, end };
}

// Which of its productions each module of a word takes.
function optionsOf(choices, word, seed, step) {
  const [top, bottom] = stemOf(seed, step);
  return word.map((state, position) => {
    const [ends, total] = choices[state];
    if (!ends.length) return 0;
    mix(top, (bottom ^ position) >>> 0);
    mix(high, low);
    const unit = (high * 2 ** 21 + (low >>> 11)) * UNIT * total;
    let option = 0;
    while (option < ends.length && ends[option] <= unit) option++;
    return option;
  });
}

function stemOf(seed, step) {
  const whole = BigInt.asUintN(64, BigInt(seed));
  mix(Number(whole >> 32n), Number(whole & 0xffffffffn));
  mix(high, (low ^ step) >>> 0);
  return [high, low];
}

// splitmix64 of a number of two halves, into `high` and `low`.
function mix(top, bottom) {
  low = bottom + 0x7f4a7c15;
  high = (top + 0x9e3779b9 + Number(low > 0xffffffff)) >>> 0;
  low >>>= 0;
  shifted(30);
  multiplied(0xbf58476d, 0x1ce4e5b9);
  shifted(27);
  multiplied(0x94d049bb, 0x133111eb);
  shifted(31);
}

function shifted(by) {
  low = (low ^ ((low >>> by) | (high << (32 - by)))) >>> 0;
  high = (high ^ (high >>> by)) >>> 0;
}

function multiplied(top, bottom) {
  const a = low & 0xffff, b = low >>> 16, c = bottom & 0xffff, d = bottom >>> 16;
  const first = a * c, second = b * c + (first >>> 16), third = a * d + (second & 0xffff);
  high = (b * d + (second >>> 16) + (third >>> 16) + Math.imul(low, top) + Math.imul(high, bottom)) >>> 0;
  low = ((third << 16) | (first & 0xffff)) >>> 0;
}

// The production that the first throw of a word's development chooses; -1 where none is thrown.
export function firstThrow(book) {
  const { choices } = book.data;
  for (let step = 0; step < book.steps; step++) {
    const word = book.word(step), at = word.findIndex((state) => choices[state][0].length);
    if (at >= 0) return book.production(step + 1, book.daughters(step, at)[0]);
  }
  return -1;
}

const oddsOf = ([ends, total, , rows]) => rows.map((row, i) => [((ends[i] ?? total) - (ends[i - 1] ?? 0)) / total, row]);

// How many modules that are `counted` a word has on average after some steps.
export function exactMean({ axiom, choices }, counted, steps) {
  let means = choices.map((_, state) => Number(counted(state)));
  for (let step = 0; step < steps; step++) means = choices.map((each) => oddsOf(each).reduce((sum, [share, row]) => sum + share * totalOf(row, means), 0));
  return totalOf(axiom, means);
}

const totalOf = (row, numbers) => row.reduce((sum, state) => sum + numbers[state], 0);

// How likely each number of such modules is, from 0 on; null where there are too many numbers.
export function exactShares({ axiom, choices }, counted, steps) {
  let shares = choices.map((_, state) => (counted(state) ? [0, 1] : [1])), left = MOST_PRODUCTS;
  const of = (row, known) => row.reduce((product, state) => times(product, known[state]), [1]);
  try {
    for (let step = 0; step < steps; step++) {
      const before = shares;
      shares = choices.map((each) => added(oddsOf(each).map(([share, row]) => of(row, before).map((part) => share * part))));
    }
    return of(axiom, shares);
  } catch (fault) {
    if (fault instanceof RangeError) return null;
    throw fault;
  }

  function times(one, other) {
    left -= one.length * other.length;
    if (left < 0 || one.length + other.length > MOST_SHARES) throw new RangeError();
    const found = new Array(one.length + other.length - 1).fill(0);
    one.forEach((part, i) => part && other.forEach((each, k) => { found[i + k] += part * each; }));
    return found;
  }
}

function added(rows) {
  const found = new Array(Math.max(1, ...rows.map((row) => row.length))).fill(0);
  for (const row of rows) row.forEach((part, i) => { found[i] += part; });
  return found;
}
