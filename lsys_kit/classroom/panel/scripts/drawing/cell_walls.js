// The walls of a cellwork: of the cells that are shown the outer walls, shaded; of all others the edges.

import { mixed } from "./colours.js";
import { line, outline, surround } from "./outlines.js";
import { meanOf } from "./painting_order.js";
import { halfToEven } from "./turtle_actions.js";

const LIGHT = [-0.4, 0.75, 0.5]; // towards the light, as the viewer sees it: to the left, up, behind the viewer
const SHADES = 24, DARKEST = 0.55, TINT = 0.7, TINT_ON_DARK = 0.9; // of walls: how many shades, the darkest, how much of a colour
const LEVELS = 2 ** 15; // of depths, over the extent of what is seen
const DIM = 0.6, OUTLINE = 0.4; // how strong the edges of other cells are, and the colour of a wall in its outline

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
  const [across, up, towards] = normalOf(face.corners, seen), length = Math.hypot(across, up, towards) || 1, lamp = Math.hypot(...LIGHT);
  const bright = (1 + (across * LIGHT[0] + up * LIGHT[1] + towards * LIGHT[2]) / (length * lamp)) / 2;
  const level = Math.floor(Math.max(0, Math.min(1, bright)) * (SHADES - 1) + 0.5);
  return { ...face, bright, level, isFront: towards > 0, depth: meanOf(seen.depths, face.corners) };
}

// Twice the area of a polygon as a vector at right angles to it, towards whom its corners run counter-clockwise.
function normalOf(corners, { x, y, depths }) {
  const sum = [0, 0, 0];
  corners.forEach((one, i) => {
    const next = corners[(i + 1) % corners.length];
    sum[0] += y[one] * depths[next] - depths[one] * y[next];
    sum[1] += depths[one] * x[next] - x[one] * depths[next];
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
  for (const each of found) {
    if (each.ends) {
      line(pen, outline(each.ends, place, false), isMarked(each.edge) ? theme.markEdge : mixed(theme.quiet, theme.paper, DIM), isMarked(each.edge) ? 3 : 1);
      continue;
    }
    const shape = outline(each.corners, place), shade = mixed(colours[each.label], "#000000", DARKEST + ((1 - DARKEST) * each.level) / (SHADES - 1));
    pen.fillStyle = mixed(shade, theme.paper, theme.dark ? TINT_ON_DARK : TINT);
    pen.fill(shape);
    line(pen, shape, theme.dark ? theme.paper : mixed(shade, theme.ink, OUTLINE), 1);
    const [from, to] = [starts[each.wall], starts[each.wall + 1]];
    for (let i = from; each.isFront && i < to; i++)
      if (isMarked(borders[i])) line(pen, outline([shapes.strokes.from[borders[i]], shapes.strokes.to[borders[i]]], place, false), theme.markEdge, 4);
  }
  for (const each of found) if (each.isFront && lit.has(each.cell)) surround(pen, outline(each.corners, place), lit.get(each.cell), theme);
}
