// A module that is traced: its mother in the step before, its daughters in the next, and the sentence that tells of them.

import { wallsBeside } from "../drawing/map.js";

// What is lit at a step when a module of some step is traced: a map from positions to "self", "mother" or "daughter".
export function litAt(book, traced, step) {
  const lit = new Map();
  if (!traced) return lit;
  if (step === traced.step) lit.set(traced.position, "self");
  if (step === traced.step - 1) {
    for (const each of originsOf(book, traced)) lit.set(book.mother(step + 1, each), "mother");
  }
  if (step === traced.step + 1) {
    const [from, to] = book.daughters(traced.step, traced.position) ?? [0, 0];
    for (let i = from; i < to; i++) lit.set(i, "daughter");
  }
  return lit;
}

// Where in the model's text the productions stand that made a module and that will replace it.
export function placesOf(book, traced) {
  if (!traced) return [];
  const numbers = new Set(originsOf(book, traced).map((each) => book.production(traced.step, each)));
  return [...numbers].flatMap((number) => book.data.productions[number]?.at ? [book.data.productions[number].at] : []);
}

// The modules of a step by whose mothers one was made: the module itself; of a wall that divides a cell the two beside it.
function originsOf(book, { step, position }) {
  if (!step) return [];
  if (book.mother(step, position) >= 0) return [position];
  return book.data.mode === "map" ? wallsBeside(book, step, position) : [];
}

// What a module is, where it came from and what it becomes, as a sentence.
export function told(book, { step, position }) {
  if (book.data.mode === "tissue") return toldOfCell(book, { step, position });
  const text = (at, where) => book.label(book.word(at)[where]).text;
  const { noun } = book.data;
  const parts = [`${noun[0].toUpperCase()}${noun.slice(1)} ${(position + 1).toLocaleString("en")} of step ${step}, ${text(step, position)}`];
  if (step === 0) parts.push("stands in the axiom");
  else {
    const mother = book.mother(step, position), number = book.production(step, position);
    if (mother < 0) parts.push(`is new and divides a cell: ${halves(book, { step, position })}`);
    else parts.push(`comes from ${text(step - 1, mother)}, ${noun} ${(mother + 1).toLocaleString("en")} of step ${step - 1}, ${by(book, number)}`);
  }
  const range = book.daughters(step, position);
  if (range) {
    const [from, to] = range, many = to - from, next = book.word(step + 1);
    const made = Array.from(next.subarray(from, Math.min(to, from + 12)), (state) => book.label(state).text).join(" ");
    const stays = many === 1 && book.production(step + 1, from) < 0;
    parts.push(stays ? `it stays as it is at step ${step + 1}` : many ? `it becomes ${made}${many > 12 ? " …" : ""} at step ${step + 1}` : `it is gone at step ${step + 1}`);
  }
  return `${parts.slice(0, 2).join(" ")}${parts[2] ? `; ${parts[2]}` : ""}.`;
}

// What a cell is, and how it was and will be divided.
function toldOfCell(book, { step, position }) {
  const named = (cell) => (cell + 1).toLocaleString("en"), sisters = ([from, to]) => Array.from({ length: to - from }, (_, i) => from + i);
  const parts = [`Cell ${named(position)} of step ${step}, ${book.label(book.word(step)[position]).text}`];
  if (!step) parts.push("is there from the beginning");
  else {
    const mother = book.mother(step, position), others = sisters(book.daughters(step - 1, mother)).filter((each) => each !== position);
    parts.push(others.length ? `comes, with cell ${others.map(named).join(" and ")}, from cell ${named(mother)} of step ${step - 1}, which was divided`
      : `was cell ${named(mother)} of step ${step - 1}, which was not divided`);
  }
  const range = book.daughters(step, position);
  if (range) {
    const next = sisters(range).map(named);
    parts.push(next.length > 1 ? `at step ${step + 1} it is divided into cells ${next.join(" and ")}` : `at step ${step + 1} it is cell ${next[0]}, not divided`);
  }
  return `${parts.slice(0, 2).join(" ")}${parts[2] ? `; ${parts[2]}` : ""}.`;
}

// Which markers have made a wall that divides a cell.
function halves(book, traced) {
  const { step } = traced, found = originsOf(book, traced).map((each) => {
    const mother = book.mother(step, each);
    return `${book.label(book.word(step - 1)[mother]).text}, wall ${(mother + 1).toLocaleString("en")}`;
  });
  return `markers of ${found.join(", and ")} of step ${step - 1} match`;
}

function by(book, number) {
  return number < 0 ? "for which no production matches, so it stays" : `by production ${number + 1}, ${book.data.productions[number].text}`;
}
