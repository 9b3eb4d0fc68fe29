// One rule after another: the book of a program that replaces, in each step, first all modules to which the first production applies, then, in
// what has become of them, all of the second, and so on. Each line of the program is a step of this book.

import { worded } from "../views/controls.js";
import { openBook } from "./book.js";

const LONGEST_WORD = 3_000; // modules of a word

export const isSequential = ({ data }) => Boolean(data.program);

// Whether a book says enough, and the order of its rules can matter.
export const hasOrder = ({ data }) => Boolean(data.successors) && linesOf(data).length > 1;

const linesOf = ({ applied }) => [...new Set(applied)].filter((number) => number >= 0).sort((one, other) => one - other);

export function oneAfterAnother({ data: given, steps }) {
  const { successors, ...data } = given;
  const program = linesOf(given), words = [Int32Array.from(data.axiom)], daughters = [], made = [], doing = [];
  while (doing.length < steps) { // the steps of the panel are as many as before
    const at = doing.length, line = program[at % program.length], word = words.at(-1), meets = (state) => data.applied[state] === line;
    if (word.some((state) => data.applied[state] < 0 && !successors[state].length)) break; // a state of the last step, of which nothing is known
    const rows = Array.from(word, (state) => (meets(state) ? successors[state] : [state]));
    if (rows.flat().length > LONGEST_WORD) break;
    words.push(Int32Array.from(rows.flat()));
    daughters.push(Int32Array.from(rows, (row) => row.length));
    made.push(word.map((state) => (meets(state) ? line : -1)));
    doing.push(worded("line {line} of step {step}: {rule}", { line: (at % program.length) + 1, step: Math.floor(at / program.length) + 1, rule: data.productions[line].text }));
  }
  const held = ["", ...doing.map((line) => worded("after {line}", { line }))];
  return openBook({ ...data, program, doing, words, daughters, made, held, steps: words.length - 1, end: "", growth: null, time: null });
}
