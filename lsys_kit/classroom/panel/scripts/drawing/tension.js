// The forces of a map: walls as springs, coloured by their tension, and as arrows the pressure that pushes each wall.
//
// A wall that pulls is blue and solid, one that pushes orange and dashed; the stronger the broader.

import { lineColour, mixed } from "./colours.js";
import { seenAt } from "./map.js";
import { pressuresOf, tensionsOf } from "./relaxation.js";

// Told apart by people who are colour-blind (Okabe and Ito).
export const PULL = "#0072b2";
export const PUSH = "#d55e00";
const THINNEST = 1.4, BROADEST = 8, PALEST = 0.6, DASHES = [6, 4]; // pixels, and how strong the colour of the weakest is
const ARROW = 36, SHORTEST_ARROW = 4, HEAD = 6, SLENDER = 0.45; // pixels; an arrow is so long where a force is as great as the greatest tension
export const LONGEST_ARROW = 45;

const known = new WeakMap();

// For each wall its tension, and the pressure that pushes it to its left less the one that pushes it to its right, by length.
export function forcesOf(tissue, points, forces) {
  const pressures = pressuresOf(tissue, points, forces), net = new Float64Array(tissue.from.length), numbers = wallsBetween(tissue);
  tissue.corners.forEach((a, i) => {
    const b = tissue.following[i], wall = numbers.get(keyOf(a, b));
    net[wall] += (tissue.from[wall] === a ? 1 : -1) * pressures[tissue.cellOf[i]];
  });
  return { tensions: tensionsOf(tissue, points, forces), net };
}

const keyOf = (a, b) => `${Math.min(a, b)} ${Math.max(a, b)}`;

function wallsBetween(tissue) {
  if (!known.has(tissue)) known.set(tissue, new Map(Array.from(tissue.from, (a, i) => [keyOf(a, tissue.to[i]), i])));
  return known.get(tissue);
}

export const strongest = (tensions) => tensions.reduce((most, tension) => Math.max(most, Math.abs(tension)), 0);

// Paint the springs, and on them the arrows; `most` is the tension of the broadest wall, and the force of an arrow of the usual length.
export function paintForces(pen, shapes, frame, theme, { tensions, net, most, unit }) {
  const { from, to } = shapes.strokes, arrows = new Path2D(), heads = new Path2D();
  for (let i = 0; i < tensions.length; i++) {
    const [x, y] = seenAt(frame, shapes, from[i]), [toX, toY] = seenAt(frame, shapes, to[i]);
    const share = Math.min(1, Math.abs(tensions[i]) / most), colour = lineColour(tensions[i] < 0 ? PUSH : PULL, theme);
    pen.setLineDash(tensions[i] < 0 ? DASHES : []);
    pen.lineCap = tensions[i] < 0 ? "butt" : "round";
    [pen.lineWidth, pen.strokeStyle] = [THINNEST + share * (BROADEST - THINNEST), mixed(colour, theme.paper, PALEST + share * (1 - PALEST))];
    pen.stroke(new Path2D(`M${x} ${y}L${toX} ${toY}`));
    const force = (net[i] * Math.hypot(toX - x, toY - y)) / (frame.scale * unit);
    addArrow(arrows, heads, [x, y], [toX, toY], (force / most) * ARROW);
  }
  pen.setLineDash([]);
  [pen.lineWidth, pen.strokeStyle, pen.fillStyle] = [1.4, theme.ink, theme.ink];
  pen.stroke(arrows);
  pen.fill(heads);
}

// An arrow from the middle of a wall to its left, or to its right if it is negative.
function addArrow(arrows, heads, [x, y], [toX, toY], wanted) {
  const size = Math.min(LONGEST_ARROW, Math.abs(wanted)), length = Math.hypot(toX - x, toY - y);
  if (size < SHORTEST_ARROW || !length) return;
  const way = Math.sign(wanted) / length, right = way * (toY - y), down = -way * (toX - x); // y grows downwards here
  const [cx, cy] = [(x + toX) / 2, (y + toY) / 2], head = Math.min(HEAD, 0.6 * size), neck = size - head;
  arrows.moveTo(cx, cy);
  arrows.lineTo(cx + neck * right, cy + neck * down);
  for (const [ahead, aside] of [[size, 0], [neck, head * SLENDER], [neck, -head * SLENDER]])
    heads[aside || ahead !== size ? "lineTo" : "moveTo"](cx + ahead * right - aside * down, cy + ahead * down + aside * right);
  heads.closePath();
}
