// The walls of a cellwork: of the cells that are shown the outer walls, shaded; of all others the edges.

import { halfToEven } from "../books/numbers.js";
import { brightness, mixed, shades } from "./colours.js";
import { EDGE } from "./constants.js";
import { line, meanOf, outline, surround } from "./outlines.js";

const LEVELS = 2 ** 15; // of depths, over the extent of what is seen
const DIM = 0.6; // how strong the edges of other cells are

// What is seen of a cellwork in which some cells are shown, or all: faces, each with its wall, cell, corners and shade, then the
// edges that belong to none of these cells, from far to near.
export function wallsSeen(shapes, seen, cells = null) {
  const { sides, starts, corners, borders, labels, kindOf } = shapes, faces = new Map(), inside = new Set();
  for (let i = 0; i < sides.length; i += 3) {
    const [cell, wall, forward] = sides.subarray(i, i + 3);
    if (cells && !cells.has(cell)) continue;
    faces.has(wall) ? inside.add(wall) : faces.set(wall, { cell, forward });
  }
  const edges = new Set([...faces.keys()].flatMap((wall) => [...borders.subarray(starts[wall], starts[wall + 1])]));
  for (const wall of inside) faces.delete(wall);
  const found = [...faces].map(([wall, { cell, forward }]) => {
    const around = Array.from(corners.subarray(starts[wall], starts[wall + 1]));
    return faceOf({ wall, cell, corners: forward ? around : around.reverse(), label: labels[wall] }, seen);
  });
  const rest = Array.from(kindOf.keys()).filter((edge) => !edges.has(edge)).map((edge) => edgeOf(shapes, seen, edge));
  return sorted([...found, ...rest], shapes);
}

function faceOf(face, seen) {
  const { corners } = face, bright = brightness(normalOf(corners, seen.right, seen.up, seen.depths));
  return { ...face, bright, isFront: normalOf(corners, seen.x, seen.y, seen.depths)[2] > 0, depth: meanOf(seen.depths, corners) };
}

// Twice the area of a polygon as a vector at right angles to it, towards whom its corners run counter-clockwise.
function normalOf(corners, x, y, z) {
  const sum = [0, 0, 0];
  corners.forEach((one, i) => {
    const next = corners[(i + 1) % corners.length];
    sum[0] += y[one] * z[next] - z[one] * y[next];
    sum[1] += z[one] * x[next] - x[one] * z[next];
    sum[2] += x[one] * y[next] - y[one] * x[next];
  });
  return sum;
}

const edgeOf = ({ strokes: { from, to } }, { depths }, edge) => ({ edge, ends: [from[edge], to[edge]], depth: (depths[from[edge]] + depths[to[edge]]) / 2 });

// From far to near; what is as far away stays in its order. Depths are compared in levels, so that rounding errors bring nothing forward.
function sorted(found, { x, y, z }) {
  const used = new Set(found.flatMap(({ corners, ends }) => corners ?? ends)), unit = LEVELS / (Math.max(...[x, y, z].map((axis) => spanOf(axis, used))) || 1);
  return found.map((each) => ({ ...each, rank: halfToEven(each.depth * unit) })).sort((a, b) => a.rank - b.rank);
}

function spanOf(axis, used) {
  let least = Infinity, most = -Infinity;
  for (const point of used) [least, most] = [Math.min(least, axis[point]), Math.max(most, axis[point])];
  return most - least;
}

// Paint them; `place` says where a point is on the canvas.
export function paintWalls(pen, shapes, seen, place, { theme, marked, lit }, cells) {
  const found = wallsSeen(shapes, seen, cells), { borders, starts, kindOf, colours } = shapes, isMarked = (edge) => marked.has(kindOf[edge]);
  const shade = shades(colours, theme);
  for (const each of found) {
    if (each.ends) {
      line(pen, outline(each.ends, place, false), isMarked(each.edge) ? theme.markEdge : mixed(theme.quiet, theme.paper, DIM), isMarked(each.edge) ? 3 : 1);
      continue;
    }
    const shape = outline(each.corners, place), near = meanOf(seen.nearness, each.corners);
    pen.fillStyle = shade(each.label, near, each.bright);
    pen.fill(shape);
    line(pen, shape, shade(each.label, near, Math.max(0, each.bright + EDGE)), 1);
    const [from, to] = [starts[each.wall], starts[each.wall + 1]];
    for (let i = from; each.isFront && i < to; i++)
      if (isMarked(borders[i])) line(pen, outline([shapes.strokes.from[borders[i]], shapes.strokes.to[borders[i]]], place, false), theme.markEdge, 4);
  }
  for (const each of found) if (each.isFront && lit.has(each.cell)) surround(pen, outline(each.corners, place), lit.get(each.cell), theme);
}
