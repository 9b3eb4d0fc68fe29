// A map on a sphere: what is seen of its cells and walls, and the shade of the sphere.

import { mixed } from "./colours.js";
import { line, outline, surround } from "./outlines.js";

const STRAIGHT = Math.PI / 30, SLIVER = 0.1; // of arcs along the rim: the greatest turn of a piece, and what they may enclose
const COLOURS = 6, PALE = 0.45, STRONG = 0.85, REST = 0.13; // of cells: how many, in two strengths; and of all further kinds
const DIM = 0.25; // how much of a cell's colour is left where others are lit
const GREY = "#5b6875", PAPER = "#ffffff", DIMMER = "#d8dee4"; // what colours are mixed with, and on dark paper
const WALL = 1.4, MARKED = 5; // pixels

// What is seen of a cell: outlines whose hidden parts run along the rim, in units of the radius; none, where all of it is hidden.
// Cells run clockwise, as seen from outside. A cell whose outline does not, after what is hidden has moved to the rim, has the point
// in it that is farthest from the viewer, and lies all around what is not it.
export function cellSeen({ sides, starts, arcs }, seen, cell) {
  const points = [];
  for (let i = starts[cell]; i < starts[cell + 1]; i++) {
    const [wall, forward] = [sides[2 * i], sides[2 * i + 1]], first = arcs[wall], last = arcs[wall + 1] - 1;
    if (forward) for (let point = first; point < last; point++) points.push(point);
    else for (let point = last; point > first; point--) points.push(point);
  }
  if (!points.some((point) => seen.depths[point] > 0)) return [];
  const front = toTheFront(points, seen), around = front.reduce((sum, [x, y], i) => {
    const [beyond, above] = front[(i + 1) % front.length];
    return sum + x * above - beyond * y;
  }, 0);
  return around < SLIVER ? [front] : [front, rim(0, 2 * Math.PI)];
}

function toTheFront(points, { x, y, depths, unit }) {
  return points.flatMap((there, i) => {
    const here = points.at(i - 1), isHidden = depths[there] < 0, radius = Math.hypot(x[there], y[there]);
    if (!(isHidden && depths[here] < 0)) return [[x, y].map((axis) => axis[there] / (isHidden ? radius : unit))];
    const from = Math.atan2(y[here], x[here]), full = 2 * Math.PI, turn = Math.atan2(y[there], x[there]) - from + Math.PI;
    return rim(from, turn - full * Math.floor(turn / full) - Math.PI).slice(1);
  });
}

// Points along the rim, from an angle on.
function rim(from, turn) {
  const pieces = 1 + Math.ceil(Math.abs(turn) / STRAIGHT);
  return Array.from({ length: pieces + 1 }, (_, i) => [Math.cos(from + (turn * i) / pieces), Math.sin(from + (turn * i) / pieces)]);
}

// The part of a wall that is in front, as pairs of points.
export function wallSeen({ arcs }, { depths }, wall) {
  const pairs = [];
  for (let point = arcs[wall]; point + 1 < arcs[wall + 1]; point++) if (depths[point] >= 0 && depths[point + 1] >= 0) pairs.push([point, point + 1]);
  return pairs;
}

// Paint them; `place` says where a point is on the canvas.
export function paintSphere(pen, shapes, seen, frame, place, { theme, marked, lit }, cells) {
  const { kindOf, kinds, colours } = shapes, many = shapes.starts.length - 1, radius = seen.unit * frame.scale, paper = theme.dark ? DIMMER : PAPER;
  const on = ([x, y]) => [frame.x0 + x * radius, frame.y0 - y * radius];
  for (let cell = 0; cell < many; cell++) {
    const path = new Path2D(), kind = kinds[cell], strength = kind < COLOURS ? PALE : STRONG;
    const fill = kind < 2 * COLOURS ? mixed(colours[kind % COLOURS], paper, strength) : mixed(GREY, paper, REST);
    for (const row of cellSeen(shapes, seen, cell)) path.addPath(outline(row, on));
    pen.fillStyle = cells && !cells.has(cell) ? mixed(fill, theme.paper, DIM) : fill;
    pen.fill(path, "evenodd");
  }
  const disc = new Path2D(), ink = theme.dark ? theme.paper : theme.ink;
  disc.arc(frame.x0, frame.y0, radius, 0, 2 * Math.PI);
  pen.fillStyle = shade(pen, frame, radius);
  pen.fill(disc);
  for (let wall = 0; wall < kindOf.length; wall++) {
    const path = piecesOf(wallSeen(shapes, seen, wall), place);
    if (marked.has(kindOf[wall])) line(pen, path, theme.markEdge, MARKED);
    line(pen, path, ink, WALL);
  }
  line(pen, disc, theme.ink, WALL);
  for (const [cell, kind] of lit) for (const wall of wallsOf(shapes, cell)) surround(pen, piecesOf(wallSeen(shapes, seen, wall), place), kind, theme);
}

const wallsOf = ({ sides, starts }, cell) => Array.from({ length: (starts[cell + 1] ?? 0) - (starts[cell] ?? 0) }, (_, i) => sides[2 * (starts[cell] + i)]);

function piecesOf(pairs, place) {
  const path = new Path2D();
  for (const pair of pairs) path.addPath(outline(pair, place, false));
  return path;
}

// The shade of a sphere in the light from above and the left.
function shade(pen, { x0, y0 }, radius) {
  const x = x0 - 0.24 * radius, y = y0 - 0.36 * radius, light = pen.createRadialGradient(x, y, 0, x, y, 1.44 * radius);
  for (const [at, colour] of [[0, "#ffffff80"], [0.5, "#ffffff00"], [0.55, "#00000000"], [1, "#00000073"]]) light.addColorStop(at, colour);
  return light;
}
