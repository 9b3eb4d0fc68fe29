// The rows of a developmental sequence: cells and walls below one another with a common scale, laid out as pictures that stay are.

import { clamped, times } from "../books/numbers.js";
import { fillColour, lineColour, mixed } from "./colours.js";
import { FILLED_ROW, LEGIBLE_ROW, LOWEST_ROW, MARKED_CELL, MOST_ROWS, OLDEST, PALEST, PICTURE_HEIGHT, PICTURE_MARGIN, PICTURE_WIDTH, ROW_AGES, ROW_HEAD, ROW_STEPS, ROW_TIMES, SIGN_COLOUR, STRONGEST, TALLEST_ROW } from "./constants.js";
import { fill, line, write } from "./outlines.js";

const CELLS_IN_PIXEL = 4; // more cells beside one another are not painted
const BESIDE_STEP = 8, NEAR_WALL = 3; // pixels
const RINGS = { self: [3.5, []], mother: [2.5, [5, 3]], daughter: [2.5, []] }; // around what is traced: width and dashes
const rowsOfBooks = new WeakMap();

// The sequence of the steps up to one of them, at most so many, on a sheet of some size; with the scale that fits the steps up to
// `boxed` as well, if that is not null.
export function sequence(book, step, { rows = MOST_ROWS, width = PICTURE_WIDTH, height = PICTURE_HEIGHT, boxed = null, labelled = true } = {}) {
  const { time, times, look } = book.data, timed = time !== null && time !== 1;
  const gutter = PICTURE_MARGIN + (labelled ? ROW_STEPS + (timed ? ROW_TIMES : 0) : 0), head = labelled ? ROW_HEAD : 0;
  const room = height - 2 * PICTURE_MARGIN - head, most = clamped(1, rows, Math.floor(room / LOWEST_ROW));
  const shown = rowsUpTo(book, step, most), framed = boxed === null || boxed <= step ? [] : rowsUpTo(book, boxed, most), all = [...shown, ...framed];
  const longest = Math.max(1e-9, ...all.map((row) => row.length)), tallest = Math.max(1e-9, ...all.map((row) => row.width));
  const far = Math.min(TALLEST_ROW * Math.max(1, height / PICTURE_HEIGHT), room / Math.max(shown.length, framed.length));
  const above = far > LEGIBLE_ROW && all.some((row) => row.walls.n) ? ROW_AGES : 0;
  const scale = Math.min(Math.max(1, width - gutter - 2 * PICTURE_MARGIN) / longest, (FILLED_ROW * far - above) / tallest);
  const pitch = clamped(LOWEST_ROW, far, (tallest * scale + above) / FILLED_ROW), top = PICTURE_MARGIN + head;
  const laid = shown.map((row, place) => ({
    step: row.step, time: timed ? times[row.step] : "", top: top + pitch * place, middle: top + pitch * (place + 0.5) + above / 2,
    left: gutter + (width - gutter - PICTURE_MARGIN - row.length * scale) / 2, current: row.step === step,
  }));
  return {
    dimension: 2, width, height, gutter, head, above, pitch, scale, timed, look, rows: laid,
    cells: joinedRows(shown.map((row) => row.cells), laid, scale), walls: joinedRows(shown.map((row) => row.walls), laid, scale),
    colours: book.data.states.map(([symbol]) => book.data.symbols[symbol][2] || SIGN_COLOUR),
  };
}

export function filamentLength(book, step) {
  return rowsUpTo(book, step, 1)[0].length;
}

function rowsUpTo(book, step, most) {
  if (!rowsOfBooks.has(book)) rowsOfBooks.set(book, new Map());
  const known = rowsOfBooks.get(book), found = [];
  for (let at = Math.max(0, step + 1 - most); at <= step; at++) {
    if (!known.has(at)) known.set(at, rowOf(book, at));
    found.push(known.get(at));
  }
  return found;
}

// The cells and walls of a step's word, in the units of the model; the age of a wall that has none is NaN.
function rowOf(book, step) {
  const word = book.word(step), shapes = book.data.cells, [cells, walls] = [0, 1].map((kind) => tableOf(howMany(word, shapes, kind)));
  let along = 0, widest = 0, before = 0, c = 0, w = 0, open = 0; // the first wall whose right neighbour is not known yet
  for (let position = 0; position < word.length; position++) {
    for (const [wall, length, width, sign, shade] of shapes[word[position]]) {
      const table = wall ? walls : cells, at = wall ? w++ : c++;
      table.x[at] = along + length / 2;
      table.length[at] = length;
      table.width[at] = wall ? before : width;
      table.sign[at] = sign ?? NaN;
      table.shade[at] = shade;
      table.state[at] = word[position];
      table.position[at] = position;
      if (wall) continue;
      for (; open < w; open++) walls.width[open] = Math.max(before, width);
      [along, widest, before] = [along + length, Math.max(widest, width), width];
    }
  }
  return { step, length: along, width: widest, cells, walls };
}

function howMany(word, shapes, kind) {
  const numbers = shapes.map((row) => row.filter(([wall]) => wall === kind).length);
  return word.reduce((sum, state) => sum + numbers[state], 0);
}

// Shapes: their middles, lengths and widths, their polarities or ages, and where they come from.
function tableOf(n) {
  const [x, y, length, width, sign, shade] = times(6, () => new Float64Array(n));
  return { n, x, y, length, width, sign, shade, state: new Int32Array(n), position: new Int32Array(n), row: new Int32Array(n) };
}

// The shapes of all rows in one table, in pixels; and where each row starts in it.
function joinedRows(tables, laid, scale) {
  const found = tableOf(tables.reduce((sum, { n }) => sum + n, 0)), starts = [0];
  tables.forEach((table, row) => {
    const start = starts[row], { left, middle } = laid[row];
    for (const name of ["sign", "shade", "state", "position"]) found[name].set(table[name], start);
    for (const [name, from] of [["x", left], ["length", 0], ["width", 0]]) found[name].set(table[name].map((size) => from + size * scale), start);
    found.y.fill(middle, start, start + table.n);
    found.row.fill(row, start, start + table.n);
    starts.push(start + table.n);
  });
  return { ...found, starts };
}

const numbersIn = ({ starts }, row) => times(starts[row + 1] - starts[row], (i) => starts[row] + i);

// Paint a sequence; `look` has the theme, the states that are marked, and `litAt(step)`, which says what is traced in a row.
export function paintSequence(pen, sheet, look) {
  pen.save();
  pen.lineJoin = pen.lineCap = "round";
  if (sheet.head) paintHeading(pen, sheet, look.theme);
  sheet.rows.forEach((row, number) => {
    const lit = look.litAt ? look.litAt(row.step) : row.current ? look.lit ?? new Map() : new Map(), seen = seenCells(sheet, number);
    paintRowLabels(pen, sheet, row, look.theme);
    paintCells(pen, sheet, seen, look);
    line(pen, arrows(sheet, seen), look.theme.ink, 1);
    paintWalls(pen, sheet, number, look);
    if (lit.size) paintTraced(pen, sheet, number, lit, look.theme);
  });
  pen.restore();
}

function paintHeading(pen, { head, timed }, theme) {
  const y = PICTURE_MARGIN + head - 7, x = PICTURE_MARGIN + ROW_STEPS - BESIDE_STEP;
  write(pen, "step", x, y, theme.quiet, "11px sans-serif", "right");
  if (timed) write(pen, "t", x + ROW_TIMES, y, theme.quiet, "italic 11px sans-serif", "right");
}

function paintRowLabels(pen, { width, pitch, head }, row, theme) {
  const size = Math.min(14, 0.8 * pitch), x = PICTURE_MARGIN + ROW_STEPS - BESIDE_STEP, y = row.middle + 0.35 * size, band = new Path2D();
  band.roundRect(4, row.top, width - 8, pitch, 6);
  if (row.current) fill(pen, band, theme.mark);
  if (!head || row.unnumbered) return;
  const [colour, font] = row.current ? [theme.ink, `bold ${size}px sans-serif`] : [theme.quiet, `${size}px sans-serif`];
  write(pen, String(row.step), x, y, colour, font, "right");
  if (row.time) write(pen, row.time, x + ROW_TIMES, y, colour, font, "right");
}

// The numbers of the cells of a row that are painted: of those too narrow to be told apart only some.
function seenCells({ cells }, row) {
  let last = -Infinity;
  return numbersIn(cells, row).filter((i) => {
    if (cells.x[i] - last < 1 / CELLS_IN_PIXEL && cells.length[i] < 1 / CELLS_IN_PIXEL) return false;
    last = cells.x[i];
    return true;
  });
}

function paintCells(pen, sheet, seen, { theme, marked }) {
  const { cells, colours } = sheet, groups = new Map();
  for (const i of seen) {
    const key = `${cells.state[i]} ${cells.shade[i]}`;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(i);
  }
  for (const group of [...groups.values()].sort(([i], [j]) => marked.has(cells.state[i]) - marked.has(cells.state[j]))) {
    const [first] = group, colour = colours[cells.state[first]], mark = marked.has(cells.state[first]), path = outlineOf(sheet, group);
    fill(pen, path, fillColour(colour, theme, PALEST + (STRONGEST - PALEST) * cells.shade[first]));
    line(pen, path, mark ? theme.markEdge : lineColour(colour, theme), mark ? clamped(1, MARKED_CELL, cells.width[first]) : 1);
  }
}

function outlineOf({ cells, look }, numbers) {
  const path = new Path2D();
  for (const i of numbers) {
    const x = cells.x[i], y = cells.y[i], rx = cells.length[i] / 2, ry = cells.width[i] / 2;
    if (look === "ellipses") {
      path.moveTo(x + rx, y);
      path.ellipse(x, y, rx, ry, 0, 0, 2 * Math.PI);
    } else path.roundRect(x - rx, y - ry, 2 * rx, 2 * ry, Math.min(rx, ry));
  }
  return path;
}

function arrows({ cells }, seen) {
  const path = new Path2D();
  for (const i of seen) {
    const way = cells.sign[i], x = cells.x[i], y = cells.y[i], rx = cells.length[i] / 2;
    if (!way || rx <= 2.5) continue;
    const barb = Math.max(1.2, 0.3 * Math.min(rx, cells.width[i] / 2)), tip = x + way * 0.55 * rx;
    path.moveTo(x - way * 0.55 * rx, y);
    path.lineTo(tip, y);
    path.moveTo(tip - way * barb, y - barb);
    path.lineTo(tip, y);
    path.lineTo(tip - way * barb, y + barb);
  }
  return path;
}

// The walls of a row, thicker and darker with age, with their ages above where these fit.
function paintWalls(pen, { walls, colours, above, width }, row, { theme, marked }) {
  const ages = numbersIn(walls, row).map((i) => {
    const colour = colours[walls.state[i]], reach = walls.width[i] / 2 + 2, shade = walls.shade[i];
    line(pen, upright(walls, i, reach), marked.has(walls.state[i]) ? theme.markEdge : mixed(lineColour(colour, theme), theme.ink, 1 - (1 - OLDEST) * shade), 1.5 + 3 * shade);
    const text = Number.isNaN(walls.sign[i]) ? "" : String(Number(walls.sign[i].toPrecision(4))), half = 3.2 * text.length;
    return { text, half, x: Math.min(Math.max(walls.x[i], half), width - half), y: walls.y[i] - reach - 2.5 };
  });
  if (!above || ages.some((age, i) => i && ages[i - 1].x + ages[i - 1].half >= age.x - age.half)) return;
  for (const age of ages) write(pen, age.text, age.x, age.y, theme.ink, "10.5px sans-serif", "center");
}

function upright({ x, y }, i, reach) {
  const path = new Path2D();
  path.moveTo(x[i], y[i] - reach);
  path.lineTo(x[i], y[i] + reach);
  return path;
}

// Rings around the cells, and lines along the walls, of the modules that are traced: a map from positions to what they are.
function paintTraced(pen, sheet, row, lit, theme) {
  const { cells, walls } = sheet;
  const ring = (table, pathOf) => {
    for (const i of numbersIn(table, row)) if (lit.has(table.position[i])) line(pen, pathOf(i), theme.lit, ...RINGS[lit.get(table.position[i])]);
  };
  ring(cells, (i) => outlineOf(sheet, [i]));
  ring(walls, (i) => upright(walls, i, walls.width[i] / 2 + 5));
}

// The step and the position of the module whose cell or wall is at a point, or so many pixels from it; null where there is none.
export function cellAt(sheet, x, y, reach = 0) {
  const { cells, walls, rows, pitch } = sheet, row = clamped(0, rows.length - 1, Math.floor((y - rows[0].top) / pitch));
  if (y < rows[row].top - reach || y >= rows[row].top + pitch + reach) return null;
  const { step } = rows[row], wall = numbersIn(walls, row).find((i) => Math.abs(x - walls.x[i]) <= NEAR_WALL);
  if (wall !== undefined) return { step, position: walls.position[wall] };
  const near = nearestTo(cells, cells.starts[row], cells.starts[row + 1], x);
  if (near < 0 || Math.abs(x - cells.x[near]) > Math.max(1, cells.length[near] / 2) + reach) return null;
  return { step, position: cells.position[near] };
}

// The number of the cell, of those side by side between two numbers, at some place along the row, or nearest to it.
function nearestTo({ x, length }, from, to, place) {
  if (from === to) return -1;
  let low = from, high = to - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (x[middle] + length[middle] / 2 < place) low = middle + 1;
    else high = middle;
  }
  return low;
}
