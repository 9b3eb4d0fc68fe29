// Cells that are seen from all sides: those of a cellwork with shaded walls, those of a map on a sphere with what is in front.
//
// As in the pictures that stay, of a cellwork the outer walls of the cells that are shown are painted from far to near, with the
// edges of all others; on a sphere what lies behind moves to the rim.

import { whole } from "../books/numbers.js";
import { list } from "../views/controls.js";
import { paintWalls, wallsSeen } from "./cell_walls.js";
import { isInside } from "./outlines.js";
import { magnified } from "./depths.js";
import { frameOf } from "./projection.js";
import { cellSeen, paintSphere } from "./sphere.js";

const COLOURS = 6; // of cells on a sphere
const UNIT = 3; // in a frame cells shall be no smaller than those of other drawings
const RADIANS = Math.PI / 180;
const known = new WeakMap();

// The shapes of a step: the edges as strokes, as a frame takes them, and what else is painted.
export function tissueShapes(book, step) {
  if (!known.has(book)) known.set(book, new Map());
  const steps = known.get(book);
  if (!steps.has(step)) steps.set(step, shapesOf(book, step));
  return steps.get(step);
}

function shapesOf(book, step) {
  const page = book.data.pages[step], n = page.points.length / 3, isSphere = "arcs" in page;
  const [x, y, z] = [0, 1, 2].map((axis) => Float64Array.from({ length: n }, (_, i) => UNIT * page.points[3 * i + axis]));
  const read = Object.fromEntries(Object.entries(page).flatMap(([name, value]) => (name === "points" ? [] : [[name, whole(value)]])));
  const ends = isSphere ? Array.from(read.arcs.subarray(0, -1)).flatMap((at) => [at, at]) : read.ends, many = read.edges.length;
  return {
    dimension: 3, n, x, y, z, pixel: 1, typical: UNIT, isSphere, ...read, kindOf: read.edges,
    strokes: { n: many, from: ends.filter((_, i) => i % 2 === 0), to: ends.filter((_, i) => i % 2), widths: new Float32Array(many).fill(-1) },
    faces: { n: 0, corners: [] }, rounds: { n: 0 },
    colours: isSphere ? book.data.symbols.slice(-COLOURS - 1, -1).map(([, , colour]) => colour) : book.data.walls.map(([, colour]) => colour),
  };
}

// The frame of a view; a sphere is as large from all sides.
export function tissueFrame(shapes, width, height, { around, above, near = 1, shift = [0, 0], box = null }) {
  if (!shapes.isSphere) return frameOf(shapes, width, height, { around, above, near, shift, box });
  const round = { middle: [0, 0, 0], pixel: 1, extent: 2 * UNIT, across: UNIT, up: UNIT }, frame = frameOf(shapes, width, height, { around, near, shift, box: round, far: true });
  return { ...frame, level: Math.cos(above * RADIANS), steep: Math.sin(above * RADIANS) };
}

// The points as they are seen: x to the right and y up, from the middle of the frame, and from infinitely far away right and up;
// how far towards the viewer, and how near that is, from 0 to 1.
export function seenFrom({ cos, sin, level, steep, reach, distance, middle: [cx, cy, cz] }, { n, x, y, z }) {
  const [right, up, sx, sy, depths, nearness] = Array.from({ length: 6 }, () => new Float64Array(n));
  for (let i = 0; i < n; i++) {
    const px = x[i] - cx, py = y[i] - cy, pz = z[i] - cz, towards = px * sin - py * cos;
    right[i] = px * cos + py * sin;
    up[i] = pz * level - towards * steep;
    const ahead = towards * level + pz * steep, factor = magnified(distance, ahead);
    [sx[i], sy[i]] = [right[i] * factor, up[i] * factor];
    depths[i] = (x[i] * sin - y[i] * cos) * level + z[i] * steep;
    nearness[i] = Math.max(0, Math.min(1, ahead / (2 * reach || 1) + 0.5));
  }
  return { x: sx, y: sy, right, up, depths, nearness, unit: UNIT };
}

// Paint what is seen; `cells` are those that are shown with their walls or in full colour, or null for all.
export function paintTissue(pen, shapes, frame, look, cells) {
  const seen = seenFrom(frame, shapes), place = (point) => [frame.x0 + seen.x[point] * frame.scale, frame.y0 - seen.y[point] * frame.scale];
  pen.lineCap = pen.lineJoin = "round";
  if (shapes.isSphere) paintSphere(pen, shapes, seen, frame, place, look, cells);
  else paintWalls(pen, shapes, seen, place, look, cells);
}

// The cell at a point of the canvas; one that is shown before others that only have edges; or -1.
export function cellUnder(shapes, frame, x, y, cells) {
  const seen = seenFrom(frame, shapes), right = (x - frame.x0) / frame.scale, up = (frame.y0 - y) / frame.scale;
  if (shapes.isSphere) {
    const numbers = Array.from({ length: shapes.starts.length - 1 }, (_, cell) => cell);
    return Math.hypot(right, up) > UNIT ? -1 : numbers.findIndex((cell) => cellSeen(shapes, seen, cell).filter((row) => isInside(row, right / UNIT, up / UNIT)).length % 2);
  }
  for (const some of cells ? [cells, null] : [null]) {
    const face = wallsSeen(shapes, seen, some).findLast(({ corners, isFront }) => isFront && isInside(corners.map((point) => [seen.x[point], seen.y[point]]), right, up));
    if (face) return face.cell;
  }
  return -1;
}

// How many divisions lie behind each cell of a step.
export function generations(book, step) {
  if (!step) return new Int32Array(book.length(0));
  const before = generations(book, step - 1);
  return Int32Array.from({ length: book.length(step) }, (_, cell) => {
    const mother = book.mother(step, cell), [from, to] = book.daughters(step - 1, mother);
    return before[mother] + (to - from > 1);
  });
}

// A list from which the cells are chosen that are lit while none is traced: all, or those of a generation.
export function litCells(changed) {
  const choice = list("lit", "which cells are lit: all, or those behind which so many divisions lie", [["", "all cells"]], "", changed);
  const element = choice.element;
  let found = new Int32Array(0);
  return {
    element,
    offer(book, step) {
      element.hidden = book.data.mode !== "tissue";
      if (element.hidden) return;
      found = generations(book, step);
      const there = [...new Set(found)].sort((a, b) => a - b).map(String), chosen = there.includes(choice.select.value) ? choice.select.value : "";
      choice.offer([["", "all cells"], ...there.map((each) => [each, `generation ${each}`])], chosen);
    },
    // The cells that are shown: those that a click has lit, or those chosen; null for all.
    shown(alone) {
      if (alone.size) return new Set(alone.keys());
      const { value } = choice.select, cells = new Set([...found.keys()].filter((cell) => String(found[cell]) === value));
      return value && cells.size < found.length ? cells : null;
    },
  };
}
