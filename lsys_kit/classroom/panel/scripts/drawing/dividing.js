// The unfolding of a filament: a row goes to the place of the next one, and each of its cells becomes as long as what it becomes, while it
// is divided.

import { times } from "../books/numbers.js";
import { paintSequence, sequence } from "./filament.js";

const PLACES = ["x", "y", "length", "width"];

// Paint a sequence of the steps up to one on a part of its way to that of the next: at 0 and at 1 they are these sequences.
export function paintDividing(pen, sheet, look, book, step, part, boxed) {
  const next = sequence(book, step + 1, { width: sheet.width, height: sheet.height, boxed });
  if (part >= 1) return paintSequence(pen, next, look);
  const mothers = singleRow(sheet, sheet.rows.length - 1), last = singleRow(next, next.rows.length - 1), spans = spansOf(book, step, mothers, last);
  const gone = sheet.rows.length - next.rows.length + 1; // rows for which there is no room any more
  const kept = times(sheet.rows.length - gone, (i) => ({ ...between(singleRow(sheet, i + gone), singleRow(next, i), part), current: false }));
  paintSequence(pen, only(next, { ...moved(mothers, last, spans.before, part), unnumbered: true }), look);
  pen.globalAlpha = part; // the daughters come out upon their mothers, on a strip of their own, and both from under the row that stays
  paintSequence(pen, only(next, moved(last, mothers, spans.after, 1 - part)), look);
  pen.globalAlpha = 1;
  for (const row of kept) paintSequence(pen, only(next, row), look);
}

// A row of a sequence with its own cells and walls.
function singleRow({ rows, cells, walls }, number) {
  const cut = ({ starts, n, ...table }) => Object.fromEntries(Object.entries(table).map(([name, column]) => [name, column.slice(starts[number], starts[number + 1])]));
  return { ...rows[number], cells: cut(cells), walls: cut(walls) };
}

function only(sheet, { cells, walls, ...row }) {
  const table = (columns) => ({ ...columns, row: columns.x.map(() => 0), n: columns.x.length, starts: [0, columns.x.length] });
  return { ...sheet, rows: [row], cells: table(cells), walls: table(walls) };
}

const way = (from, to, part) => from + part * (to - from);

// A row that both sequences have, on its way from its place in one to that in the other.
function between(one, other, part) {
  const table = (name) => ({ ...other[name], ...Object.fromEntries(PLACES.map((place) => [place, one[name][place].map((from, i) => way(from, other[name][place][i], part))])) });
  return { ...other, top: way(one.top, other.top, part), middle: way(one.middle, other.middle, part), cells: table("cells"), walls: table("walls") };
}

// A row on its way to the place of another, where each of its modules has the span that is given for it.
function moved(row, other, span, part) {
  const table = (name) => {
    const { x, length, position } = row[name], to = Array.from(x, (_, i) => span(position[i]));
    return {
      ...row[name],
      x: x.map((from, i) => way(from, mapped(from, to[i]), part)),
      length: length.map((size, i) => way(size, mapped(size, to[i]) - mapped(0, to[i]), part)),
      y: row[name].y.map((from) => way(from, other.middle, part)),
    };
  };
  return { ...row, top: way(row.top, other.top, part), middle: way(row.middle, other.middle, part), current: true, cells: table("cells"), walls: table("walls") };
}

// Where a place of one span lies in another.
function mapped(place, [[from, to], [start, end]]) {
  return to > from ? start + ((place - from) / (to - from)) * (end - start) : (start + end) / 2;
}

// For each module of a row, and for each of the next, the span of its mother in its own row and in the other one.
function spansOf(book, step, mothers, last) {
  const own = extents(mothers, book.length(step)), later = extents(last, book.length(step + 1)), ranges = times(book.length(step), (i) => book.daughters(step, i));
  const became = ranges.map(([from, to], i) => (to > from ? [later[from][0], later[to - 1][1]] : [later[Math.min(from, later.length - 1)]?.[0] ?? own[i][0], later[Math.min(from, later.length - 1)]?.[0] ?? own[i][0]]));
  const pairs = own.map((span, i) => [span, became[i]]);
  return { before: (position) => pairs[position], after: (position) => pairs[book.mother(step + 1, position)].toReversed() };
}

// From where to where each module of a row reaches; those without cells are where the one before ends.
function extents({ cells, left }, many) {
  const found = times(many, () => null);
  for (let i = 0; i < cells.x.length; i++) {
    const [from, to] = [cells.x[i] - cells.length[i] / 2, cells.x[i] + cells.length[i] / 2], known = found[cells.position[i]];
    found[cells.position[i]] = known ? [known[0], to] : [from, to];
  }
  let end = left;
  return found.map((span) => {
    if (span) end = span[1];
    return span ?? [end, end];
  });
}
