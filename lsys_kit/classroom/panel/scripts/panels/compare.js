// Two panels side by side with one step slider: two systems, or two settings of one; where their words differ is marked.

import { grouped } from "../books/numbers.js";
import { made, ownKeys } from "../views/controls.js";
import { counted } from "../views/word.js";
import { openPanel } from "./panel.js";

const SHARED = ["step", "angle", "around", "above"];

// `hosts` are those of the two panels; `shared` names the constants that one slider moves on both sides.
export function openComparison(element, hosts, shared) {
  const bar = made("div.lsys-top"), root = made("div.lsys-panel.lsys-both", bar);
  const said = made("div.lsys-sentence", { role: "status" }), sides = made("div.lsys-comparison");
  const seen = [null, null], panels = [], offs = [];
  element.append(root);
  offs.push(ownKeys(root));
  root.append(sides, said);
  hosts.forEach((host, side) => {
    const column = made("div.lsys-side");
    sides.append(column);
    panels.push(openPanel(column, host, {
      bar: side === 0 ? bar : null,
      shared,
      shown(book, step) {
        seen[side] = { book, step };
        tell();
      },
    }));
    const other = hosts[1 - side];
    for (const name of SHARED) offs.push(host.on(name, (value) => {
      if (other.get(name) !== value) other.set(name, value);
    }));
    offs.push(host.on("settings", (here) => {
      const there = other.get("settings"), changed = shared.filter((name) => name in here && name in there && here[name] !== there[name]);
      if (changed.length) other.set("settings", { ...there, ...Object.fromEntries(changed.map((name) => [name, here[name]])) });
    }));
  });
  tell();

  // Where both panels stand and show the same step.
  function tell() {
    if (panels.length < 2 || !seen[0] || !seen[1] || seen[0].step !== seen[1].step) return;
    const found = differences(seen[0], seen[1]);
    panels.forEach((panel) => panel.differ(found.positions));
    said.textContent = found.text;
  }

  return () => {
    for (const off of offs) off();
    for (const panel of panels) panel.close();
    root.remove();
  };
}

export function differences({ book: one, step }, { book: other }) {
  const [a, b] = [one.word(step), other.word(step)], positions = new Set();
  for (let i = 0; i < Math.max(a.length, b.length); i++) if (textAt(one, a, i) !== textAt(other, b, i)) positions.add(i);
  const [first] = positions, { noun } = one.data, lengths = a.length === b.length ? `both words have ${counted(a.length, noun)}`
    : `the words have ${grouped(a.length)} and ${counted(b.length, other.data.noun)}`;
  const where = positions.size ? `they differ first at ${noun} ${first + 1}: ${shownAt([one, other], [a, b], first).join(" and ")}` : "they are equal";
  const drawings = positions.size && sameCells(one, other, a, b) ? "; cell by cell they are drawn alike" : "";
  return { positions, text: `Step ${step}: ${lengths}; ${where}${drawings}.` };
}

const textAt = (book, word, position) => (position < word.length ? book.label(word[position]).text : undefined);

// Both modules at a place as the words show them; exactly, where those look alike.
function shownAt(books, words, position) {
  const labels = books.map((book, side) => (position < words[side].length ? book.label(words[side][position]) : null));
  const shown = labels.map((label) => (label ? `${label.letter}${label.subscript}${label.values}` : "none"));
  return shown[0] === shown[1] ? labels.map((label) => label?.text ?? "none") : shown;
}

function sameCells(one, other, a, b) {
  if (one.data.mode !== "filament" || other.data.mode !== "filament") return false;
  const cells = (book, word) => JSON.stringify(Array.from(word).flatMap((state) => book.data.cells[state].map((cell) => cell.slice(0, 4))));
  return cells(one, a) === cells(other, b);
}
