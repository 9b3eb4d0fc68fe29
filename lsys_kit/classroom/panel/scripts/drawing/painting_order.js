// In which order the shapes of a drawing are painted, and how broad its strokes are, as in the pictures that stay.

import { halfToEven } from "./turtle_actions.js";

const ORDER_WIDTHS = [2.4, 1.7, 1.3, 1.0]; // of strokes, in pixels, by branch order
const SLIMMEST = 3, BROADEST = 4000; // the least and the greatest width that a turtle sets, in tenths of a pixel
const DEPTH_LEVELS = 2 ** 15; // over the extent of a drawing in space, so that rounding errors bring nothing forward
const MOST_NUMBERED = 2 ** 31; // more shapes there cannot be
const LAST_RANK = 2 ** 21;

// The width of each stroke, in tenths of a pixel: as the turtle has set it, or by its branch order.
export function strokeWidths({ n, orders, widths }, scale, thin) {
  const found = new Int32Array(n), own = ORDER_WIDTHS.map((width) => halfToEven(10 * width * thin));
  for (let i = 0; i < n; i++)
    found[i] = widths[i] < 0 ? own[Math.min(orders[i], own.length - 1)]
      : Math.max(SLIMMEST, Math.min(BROADEST, halfToEven(widths[i] * scale * 10)));
  return found;
}

// The numbers of faces, strokes and rounds, counted in this order, as they are painted: in space from far to near; in the plane
// strokes by colours, and of one colour the broad ones first. `depths` says how far points lie towards the viewer.
export function paintingOrder(shapes, widths, depths, extent) {
  const { strokes, faces, rounds } = shapes, many = faces.n + strokes.n + rounds.n;
  const ranks = depths ? depthLevels(shapes, depths, extent) : planeRanks(shapes, widths), keys = new Float64Array(many);
  for (let i = 0; i < many; i++) keys[i] = ranks[i] * MOST_NUMBERED + i;
  keys.sort();
  for (let i = 0; i < many; i++) keys[i] -= Math.floor(keys[i] / MOST_NUMBERED) * MOST_NUMBERED;
  return keys;
}

function planeRanks({ strokes, faces, rounds }, widths) {
  const ranks = new Float64Array(faces.n + strokes.n + rounds.n).fill(LAST_RANK).fill(-1, 0, faces.n);
  for (let i = 0; i < strokes.n; i++) ranks[faces.n + i] = strokes.colours[i] * (BROADEST + 1) + BROADEST - widths[i];
  return ranks;
}

// A shape is as near as its middle: the mean of its corners, the middle of a stroke, a centre.
function depthLevels({ strokes, faces, rounds }, depths, extent) {
  const levels = new Float64Array(faces.n + strokes.n + rounds.n), unit = DEPTH_LEVELS / (extent || 1);
  for (let i = 0; i < faces.n; i++) levels[i] = halfToEven(meanOf(depths, cornersOf(faces, i)) * unit);
  for (let i = 0; i < strokes.n; i++)
    levels[faces.n + i] = halfToEven(((depths[strokes.from[i]] + depths[strokes.to[i]]) / 2) * unit);
  for (let i = 0; i < rounds.n; i++) levels[faces.n + strokes.n + i] = halfToEven(depths[rounds.centres[i]] * unit);
  const least = levels.reduce((found, level) => Math.min(found, level), Infinity);
  return levels.map((level) => level - least);
}

// The points of a face.
export function cornersOf({ starts, corners }, i) {
  return corners.subarray(starts[i], starts[i + 1]);
}

export function meanOf(places, numbers) {
  let sum = 0;
  for (const number of numbers) sum += places[number];
  return sum / numbers.length;
}
