// The map of a step: cells lightly filled, walls as strokes with their directions and labels. A map grows out of the one before:
// new points start where they were made, on their walls, and all points move to rest.

import { whole } from "../books/numbers.js";
import { made } from "../views/controls.js";
import { lineColour, mixed } from "./colours.js";

export const UNIT = 8; // a wall is about 0.3 long; in a frame it shall be no smaller than a cell of other drawings
const FILL = 0.07; // how strong the ink is in a cell
const LEAST_LABELLED = 1.6, LEAST_POINTED = 1.1; // the lengths of walls with a label and with an arrow, in sizes of a label
const HALO = 0.32; // of paper around a label, in its size
const REACH = 0.75, SLENDER = 0.42, TIP = 0.76; // of an arrowhead: its length in sizes of a label, its breadth, and where it stands
const LONGEST_SCALE = 72, CORNER = 12, ROUND = [1, 2, 5]; // of the scale: its greatest length, its distance from the corner
const known = new WeakMap();

// The shapes of a map, as a painter takes them: walls are strokes; cells are kept beside them.
export function mapShapes(book, step) {
  if (!known.has(book)) known.set(book, new Map());
  const maps = known.get(book);
  if (!maps.has(step)) maps.set(step, shapesOf(book, step));
  return maps.get(step);
}

function shapesOf(book, step) {
  const page = book.data.maps[step], word = book.word(step), n = page.points.length / 2, walls = word.length;
  const x = new Float64Array(n), y = new Float64Array(n), ends = whole(page.ends), from = new Int32Array(walls), to = new Int32Array(walls);
  for (let i = 0; i < n; i++) [x[i], y[i]] = [UNIT * page.points[2 * i], UNIT * page.points[2 * i + 1]];
  for (let i = 0; i < walls; i++) [from[i], to[i]] = [ends[2 * i], ends[2 * i + 1]];
  const lengths = Float64Array.from(from, (a, i) => Math.hypot(x[to[i]] - x[a], y[to[i]] - y[a])).sort();
  const none = new Int32Array(0);
  return {
    dimension: 2, n, x, y, pixel: 1, typical: lengths[walls >> 1] ?? 1,
    strokes: {
      n: walls, from, to, colours: Int32Array.from(word, (state) => book.data.states[state][0]), orders: new Int32Array(walls),
      widths: new Float32Array(walls).fill(-1), positions: Int32Array.from({ length: walls }, (_, i) => i), states: word,
    },
    faces: { n: 0, starts: none, corners: none, colours: none, positions: none, states: none },
    rounds: { n: 0, centres: none, radii: none, kinds: none, colours: none, positions: none, states: none },
    palette: book.data.symbols.map(([, , colour]) => colour),
    cells: { corners: whole(page.corners), starts: whole(page.starts), kinds: whole(page.kinds) },
  };
}

// The shapes of a map whose points are elsewhere, in the units of the forces.
export function movedShapes(book, step, { x, y }) {
  const scaled = (places) => Float64Array.from(places, (place) => UNIT * place);
  return { ...mapShapes(book, step), x: scaled(x), y: scaled(y) };
}

// At either end of a wall that divides a cell, a wall that lies on the one in the map before whose marker was there.
export function wallsBeside(book, step, position) {
  const { positions, from, to } = mapShapes(book, step).strokes;
  return [from[position], to[position]].map((point) =>
    positions.find((wall) => book.mother(step, wall) >= 0 && (from[wall] === point || to[wall] === point)));
}

// The shapes of a map on their way out of the map before: at 0 new points lie on their walls and new walls are points.
export function grownShapes(book, step, share) {
  const before = mapShapes(book, step - 1), to = mapShapes(book, step), known = before.n, x = new Float64Array(to.n), y = new Float64Array(to.n);
  x.set(before.x);
  y.set(before.y);
  book.data.maps[step].new.forEach(([a, b, part], i) => {
    [x[known + i], y[known + i]] = [x[a] + part * (x[b] - x[a]), y[a] + part * (y[b] - y[a])];
  });
  for (let i = 0; i < to.n; i++) [x[i], y[i]] = [x[i] + share * (to.x[i] - x[i]), y[i] + share * (to.y[i] - y[i])];
  return { ...to, ...growing(to, x, y, to.strokes.positions.findIndex((wall) => book.mother(step, wall) < 0), share) };
}

// Walls from one on grow from their first point to their second.
function growing({ n, strokes }, x, y, first, share) {
  if (first < 0) return { x, y };
  const many = strokes.n - first, to = strokes.to.slice(), xs = new Float64Array(n + many), ys = new Float64Array(n + many);
  xs.set(x);
  ys.set(y);
  for (let i = 0; i < many; i++) {
    const a = strokes.from[first + i], b = strokes.to[first + i];
    [xs[n + i], ys[n + i], to[first + i]] = [x[a] + share * (x[b] - x[a]), y[a] + share * (y[b] - y[a]), n + i];
  }
  return { n: n + many, x: xs, y: ys, strokes: { ...strokes, to } };
}

export const seenAt = ({ scale, x0, y0, middle: [cx, cy] }, { x, y }, point) => [x0 + (x[point] - cx) * scale, y0 - (y[point] - cy) * scale];

// The cells, below the walls.
export function paintCells(pen, shapes, frame, theme) {
  const { corners, starts } = shapes.cells;
  pen.fillStyle = mixed(theme.ink, theme.paper, FILL);
  for (let cell = 0; cell + 1 < starts.length; cell++) {
    pen.beginPath();
    for (const corner of corners.subarray(starts[cell], starts[cell + 1])) pen.lineTo(...seenAt(frame, shapes, corner));
    pen.closePath();
    pen.fill();
  }
}

// The directions and labels of walls, above them, where they are long enough.
export function paintWallSigns(pen, book, shapes, frame, { theme, marked }, { directions, labels, place = 0.5, pale = false }) {
  const { strokes, palette } = shapes, named = [], size = parseFloat(getComputedStyle(pen.canvas).fontSize);
  for (let i = 0; i < strokes.n; i++) {
    const [x, y] = seenAt(frame, shapes, strokes.from[i]), [toX, toY] = seenAt(frame, shapes, strokes.to[i]);
    const length = Math.hypot(toX - x, toY - y), isDirected = book.data.states[strokes.states[i]][1] !== "";
    if (directions && isDirected && length > LEAST_POINTED * size) {
      pen.fillStyle = pale ? theme.quiet : lineColour(palette[strokes.colours[i]], theme);
      pen.fill(arrowhead(x, y, (toX - x) / length, (toY - y) / length, length, size));
    }
    if (labels && length > LEAST_LABELLED * size) named.push([x + place * (toX - x), y + place * (toY - y), strokes.states[i]]);
  }
  for (const [x, y, state] of named) paintLabel(pen, book.label(state), x, y, size, theme, marked.has(state));
}

function arrowhead(x, y, along, across, length, size) {
  const reach = Math.min(REACH * size, 0.3 * length), tip = TIP * length + reach / 2, path = new Path2D();
  for (const [ahead, aside] of [[tip, 0], [tip - reach, reach * SLENDER], [tip - reach, -reach * SLENDER]])
    path.lineTo(x + ahead * along - aside * across, y + ahead * across + aside * along);
  path.closePath();
  return path;
}

function paintLabel(pen, { letter, subscript }, x, y, size, theme, isMarked) {
  const parts = [[letter, `${isMarked ? "bold " : ""}italic ${size}px Georgia, serif`, 0], [subscript, `${Math.round(0.7 * size)}px Georgia, serif`, 0.2 * size]];
  const widths = parts.map(([text, font]) => {
    pen.font = font;
    return pen.measureText(text).width;
  });
  pen.textAlign = "left";
  for (const way of ["strokeText", "fillText"]) {
    let left = x - (widths[0] + widths[1]) / 2;
    [pen.strokeStyle, pen.fillStyle, pen.lineWidth] = [theme.paper, theme.ink, HALO * size];
    parts.forEach(([text, font, lower], i) => {
      pen.font = font;
      if (text) pen[way](text, left, y + 0.34 * size + lower);
      left += widths[i];
    });
  }
}

// A length in the units of the forces, such as the rest length of a wall, so that maps under other forces can be compared.
export function paintMapScale(pen, { scale }, { theme }, height) {
  const most = LONGEST_SCALE / (scale * UNIT), power = 10 ** Math.floor(Math.log10(most));
  const length = ROUND.findLast((number) => number * power <= most) * power, pixels = length * scale * UNIT, y = height - CORNER;
  [pen.strokeStyle, pen.fillStyle, pen.lineWidth] = [theme.quiet, theme.quiet, 1.2];
  pen.stroke(new Path2D(`M${CORNER} ${y - 4}v8m0 -4h${pixels}m0 -4v8`));
  pen.font = "12px sans-serif";
  pen.textAlign = "left";
  pen.fillText(String(Number(length.toPrecision(1))), CORNER + pixels + 6, y + 4);
}

// Two boxes to be ticked: whether directions and labels are shown.
export function wallSigns(changed) {
  const box = (name) => made("input", { type: "checkbox", checked: true, "data-control": name, onchange: changed });
  const directions = box("directions"), labels = box("labels");
  const element = made("div.lsys-controls", made("label.lsys-check", directions, "directions"),
    made("label.lsys-check", labels, "labels"));
  return {
    element,
    offer(book) {
      element.hidden = book.data.mode !== "map";
      directions.parentNode.hidden = !book.data.states.some(([, values]) => values);
    },
    chosen: () => ({ directions: directions.checked, labels: labels.checked }),
  };
}
