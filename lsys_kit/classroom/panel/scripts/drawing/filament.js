// The rows of a developmental sequence: cells and walls below one another with a common scale, laid out as pictures that stay are.

import { fillColour, lineColour, mixed } from "./colours.js";

const SHEET = { margin: 12, height: 400, heading: 18, steps: 34, times: 46, ages: 12 }; // of a picture that stays, in pixels
const TALLEST_ROW = 46, LOWEST_ROW = 14, FILLED_ROW = 0.66; // the distance of rows, and the part of it that cells fill
const LEGIBLE_ROW = 28; // ages of walls are written where rows are farther apart than this
const CELLS_IN_PIXEL = 4; // more cells beside one another are not painted
const NO_SYMBOL_COLOUR = "#28A964"; // of what a sign draws
const PALEST = 0.45, STRONGEST = 0.85, OLDEST = 0.6; // fills of young and of old cells; how much of its colour an old wall keeps
const RINGS = { self: [3.5, []], mother: [2.5, [5, 3]], daughter: [2.5, []] }; // around what is traced: width and dashes
const rowsOfBooks = new WeakMap();

// The sequence of the steps up to one of them, at most so many, on a sheet of some size; with the scale that fits the steps up to
// `boxed` as well, if that is not null.
export function sequence(book, step, { rows = 24, width = 600, height = SHEET.height, boxed = null, labelled = true } = {}) {
  const { time, times, look } = book.data, timed = time !== null && time !== 1;
  const gutter = SHEET.margin + (labelled ? SHEET.steps + (timed ? SHEET.times : 0) : 0), head = labelled ? SHEET.heading : 0;
  const room = height - 2 * SHEET.margin - head, most = Math.max(1, Math.min(rows, Math.floor(room / LOWEST_ROW)));
  const shown = rowsUpTo(book, step, most), framed = boxed === null || boxed <= step ? shown : rowsUpTo(book, boxed, most);
  const all = framed === shown ? shown : [...shown, ...framed], many = Math.max(shown.length, framed.length);
  const longest = Math.max(1e-9, ...all.map((row) => row.length)), tallest = Math.max(1e-9, ...all.map((row) => row.width));
  const far = Math.min(TALLEST_ROW * Math.max(1, height / SHEET.height), room / many);
  const above = far > LEGIBLE_ROW && all.some((row) => row.walls.n) ? SHEET.ages : 0;
  const scale = Math.min(Math.max(1, width - gutter - 2 * SHEET.margin) / longest, (FILLED_ROW * far - above) / tallest);
  const pitch = Math.max(LOWEST_ROW, Math.min(far, (tallest * scale + above) / FILLED_ROW));
  const top = SHEET.margin + head;
  const laid = shown.map((row, place) => ({
    step: row.step, time: timed ? times[row.step] : "", top: top + pitch * place, middle: top + pitch * (place + 0.5) + above / 2,
    left: gutter + (width - gutter - SHEET.margin - row.length * scale) / 2, current: row.step === step,
  }));
  return {
    dimension: 2, width, height, gutter, head, above, pitch, scale, timed, look, rows: laid,
    cells: joinedRows(shown.map((row) => row.cells), laid, scale), walls: joinedRows(shown.map((row) => row.walls), laid, scale),
    colours: book.data.states.map(([symbol]) => book.data.symbols[symbol][2] || NO_SYMBOL_COLOUR),
  };
}

// How long the filament of a step is, in the units of the model.
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
  const [x, y, length, width, sign, shade] = Array.from({ length: 6 }, () => new Float64Array(n));
  return { n, x, y, length, width, sign, shade, state: new Int32Array(n), position: new Int32Array(n), row: new Int32Array(n) };
}

// The shapes of all rows in one table, in pixels; and where each row starts in it.
function joinedRows(tables, laid, scale) {
  const found = tableOf(tables.reduce((sum, { n }) => sum + n, 0)), starts = [0];
  tables.forEach((table, row) => {
    const start = starts[row], { left, middle } = laid[row];
    for (const name of ["sign", "shade", "state", "position"]) found[name].set(table[name], start);
    for (let i = 0; i < table.n; i++) {
      found.x[start + i] = left + table.x[i] * scale;
      found.length[start + i] = table.length[i] * scale;
      found.width[start + i] = table.width[i] * scale;
    }
    found.y.fill(middle, start, start + table.n);
    found.row.fill(row, start, start + table.n);
    starts.push(start + table.n);
  });
  return { ...found, starts };
}

// Paint a sequence; `look` has the theme, the states that are marked, and `litAt(step)`, which says what is traced in a row.
export function paintSequence(pen, sheet, look) {
  pen.save();
  pen.lineJoin = pen.lineCap = "round";
  if (sheet.head) paintHeading(pen, sheet, look.theme);
  sheet.rows.forEach((row, number) => {
    const lit = look.litAt ? look.litAt(row.step) : row.current ? look.lit ?? new Map() : new Map();
    paintRowLabels(pen, sheet, row, look.theme);
    const seen = seenCells(sheet, number);
    paintCells(pen, sheet, seen, look);
    paintArrows(pen, sheet, seen, look.theme);
    paintWalls(pen, sheet, number, look);
    if (lit.size) paintTraced(pen, sheet, number, lit, look.theme);
  });
  pen.restore();
}

function paintHeading(pen, { head, timed }, theme) {
  const y = SHEET.margin + head - 7, x = SHEET.margin + SHEET.steps - 8;
  pen.fillStyle = theme.quiet;
  pen.textAlign = "right";
  pen.font = "11px sans-serif";
  pen.fillText("step", x, y);
  pen.font = "italic 11px sans-serif";
  if (timed) pen.fillText("t", x + SHEET.times, y);
}

// The step and the time of a row, on a band if it is the current one.
function paintRowLabels(pen, { width, pitch, head }, row, theme) {
  const size = Math.min(14, 0.8 * pitch), x = SHEET.margin + SHEET.steps - 8, y = row.middle + 0.35 * size;
  if (row.current) {
    pen.fillStyle = theme.mark;
    pen.beginPath();
    pen.roundRect(4, row.top, width - 8, pitch, 6);
    pen.fill();
  }
  if (!head) return;
  pen.fillStyle = row.current ? theme.ink : theme.quiet;
  pen.textAlign = "right";
  pen.font = `${row.current ? "bold " : ""}${size}px sans-serif`;
  pen.fillText(String(row.step), x, y);
  if (row.time) pen.fillText(row.time, x + SHEET.times, y);
}

// The numbers of the cells of a row that are painted: of those too narrow to be told apart only some.
function seenCells({ cells }, row) {
  const seen = [];
  let last = -Infinity;
  for (let i = cells.starts[row]; i < cells.starts[row + 1]; i++) {
    if (cells.x[i] - last < 1 / CELLS_IN_PIXEL && cells.length[i] < 1 / CELLS_IN_PIXEL) continue;
    seen.push(i);
    last = cells.x[i];
  }
  return seen;
}

function paintCells(pen, sheet, seen, { theme, marked }) {
  const { cells, colours } = sheet, groups = new Map();
  for (const i of seen) {
    const key = `${cells.state[i]} ${cells.shade[i]}`;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(i);
  }
  const chosen = [...groups.values()].sort(([i], [j]) => marked.has(cells.state[i]) - marked.has(cells.state[j]));
  for (const group of chosen) {
    const [first] = group, colour = colours[cells.state[first]], mark = marked.has(cells.state[first]);
    pen.fillStyle = fillColour(colour, theme, PALEST + (STRONGEST - PALEST) * cells.shade[first]);
    pen.strokeStyle = mark ? theme.markEdge : lineColour(colour, theme);
    pen.lineWidth = mark ? Math.max(1, Math.min(3.2, cells.width[first])) : 1;
    pen.beginPath();
    for (const i of group) outlineCell(pen, sheet, i);
    pen.fill();
    pen.stroke();
  }
}

function outlineCell(pen, { cells, look }, i) {
  const rx = cells.length[i] / 2, ry = cells.width[i] / 2;
  if (look === "ellipses") {
    pen.moveTo(cells.x[i] + rx, cells.y[i]);
    pen.ellipse(cells.x[i], cells.y[i], rx, ry, 0, 0, 2 * Math.PI);
  } else pen.roundRect(cells.x[i] - rx, cells.y[i] - ry, 2 * rx, 2 * ry, Math.min(rx, ry));
}

// The arrows of cells that point to the left or right.
function paintArrows(pen, { cells }, seen, theme) {
  pen.strokeStyle = theme.ink;
  pen.lineWidth = 1;
  pen.beginPath();
  for (const i of seen) {
    const way = cells.sign[i], rx = cells.length[i] / 2, y = cells.y[i];
    if (!way || rx <= 2.5) continue;
    const barb = Math.max(1.2, 0.3 * Math.min(rx, cells.width[i] / 2)), tip = cells.x[i] + way * 0.55 * rx;
    pen.moveTo(cells.x[i] - way * 0.55 * rx, y);
    pen.lineTo(tip, y);
    pen.moveTo(tip - way * barb, y - barb);
    pen.lineTo(tip, y);
    pen.lineTo(tip - way * barb, y + barb);
  }
  pen.stroke();
}

// The walls of a row, thicker and darker with age, with their ages above where these fit.
function paintWalls(pen, { walls, colours, above, width }, row, { theme, marked }) {
  const ages = [];
  for (let i = walls.starts[row]; i < walls.starts[row + 1]; i++) {
    const colour = colours[walls.state[i]], reach = walls.width[i] / 2 + 2;
    pen.strokeStyle = marked.has(walls.state[i]) ? theme.markEdge : mixed(lineColour(colour, theme), theme.ink, 1 - (1 - OLDEST) * walls.shade[i]);
    pen.lineWidth = 1.5 + 3 * walls.shade[i];
    pen.beginPath();
    pen.moveTo(walls.x[i], walls.y[i] - reach);
    pen.lineTo(walls.x[i], walls.y[i] + reach);
    pen.stroke();
    const text = Number.isNaN(walls.sign[i]) ? "" : String(Number(walls.sign[i].toPrecision(4))), half = 3.2 * text.length;
    ages.push({ text, half, x: Math.min(Math.max(walls.x[i], half), width - half), y: walls.y[i] - reach - 2.5 });
  }
  if (!above || ages.some((age, i) => i && ages[i - 1].x + ages[i - 1].half >= age.x - age.half)) return;
  pen.fillStyle = theme.ink;
  pen.textAlign = "center";
  pen.font = "10.5px sans-serif";
  for (const age of ages) pen.fillText(age.text, age.x, age.y);
}

// Rings around the cells, and lines along the walls, of the modules that are traced: a map from positions to what they are.
function paintTraced(pen, sheet, row, lit, theme) {
  const { cells, walls } = sheet;
  pen.strokeStyle = theme.lit;
  const ring = (position, outline) => {
    const [width, dashes] = RINGS[lit.get(position)] ?? RINGS.self;
    pen.lineWidth = width;
    pen.setLineDash(dashes);
    pen.beginPath();
    outline();
    pen.stroke();
  };
  for (let i = cells.starts[row]; i < cells.starts[row + 1]; i++)
    if (lit.has(cells.position[i])) ring(cells.position[i], () => outlineCell(pen, sheet, i));
  for (let i = walls.starts[row]; i < walls.starts[row + 1]; i++) {
    if (!lit.has(walls.position[i])) continue;
    ring(walls.position[i], () => {
      pen.moveTo(walls.x[i], walls.y[i] - walls.width[i] / 2 - 5);
      pen.lineTo(walls.x[i], walls.y[i] + walls.width[i] / 2 + 5);
    });
  }
  pen.setLineDash([]);
}

// The step and the position of the module whose cell or wall is at a point; null where there is none.
export function cellAt(sheet, x, y) {
  const { cells, walls, rows, pitch } = sheet;
  const row = rows.findIndex(({ top }) => y >= top && y < top + pitch);
  if (row < 0) return null;
  for (let i = walls.starts[row]; i < walls.starts[row + 1]; i++)
    if (Math.abs(x - walls.x[i]) <= 3) return { step: rows[row].step, position: walls.position[i] };
  const near = nearestTo(cells, cells.starts[row], cells.starts[row + 1], x);
  if (near < 0 || Math.abs(x - cells.x[near]) > Math.max(1, cells.length[near] / 2)) return null;
  return { step: rows[row].step, position: cells.position[near] };
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
