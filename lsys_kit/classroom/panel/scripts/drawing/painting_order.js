// In which order the shapes of a drawing are painted, and how broad its strokes are, as in the pictures that stay.

import { BROADEST, DEPTH_LEVELS, LEAST_WIDTHS, ORDER_WIDTHS, SLIMMEST } from "./constants.js";
import { halfToEven } from "./turtle_actions.js";

const MOST_NUMBERED = 2 ** 31; // more shapes there cannot be
const LAST_RANK = 2 ** 21;

// The width of each stroke, in tenths of a pixel: as the turtle has set it, or by its branch order.
export function strokeWidths({ n, orders, widths }, scale, thin) {
  const own = ORDER_WIDTHS.map((width, order) => Math.max(LEAST_WIDTHS[order], halfToEven(10 * width * thin)));
  const found = new Int32Array(n);
  for (let i = 0; i < n; i++)
    found[i] = widths[i] < 0 ? own[Math.min(orders[i], own.length - 1)]
      : Math.max(SLIMMEST, Math.min(BROADEST, halfToEven(widths[i] * scale * 10)));
  return found;
}

// The numbers of faces, strokes and rounds, counted in this order, as they are painted: in space from far to near; in the plane
// strokes by colours, and of one colour the broad ones first. `depths` says how far points lie towards the viewer, and `behind`
// how far the casings of strokes, whose numbers follow all others; of what is as far away they are painted first.
export function paintingOrder(shapes, widths, depths = null, extent = 0, behind = []) {
  const { strokes, faces, rounds } = shapes, many = faces.n + strokes.n + rounds.n, all = many + behind.length;
  const ranks = depths ? depthLevels(shapes, depths, extent, behind) : planeRanks(shapes, widths), keys = new Float64Array(all);
  for (let i = 0; i < all; i++) keys[i] = ranks[i] * MOST_NUMBERED + (i < many ? i + behind.length : i - many);
  keys.sort();
  for (let i = 0; i < all; i++) {
    const at = keys[i] - Math.floor(keys[i] / MOST_NUMBERED) * MOST_NUMBERED;
    keys[i] = at < behind.length ? at + many : at - behind.length;
  }
  return keys;
}

function planeRanks({ strokes, faces, rounds }, widths) {
  const ranks = new Float64Array(faces.n + strokes.n + rounds.n).fill(LAST_RANK).fill(-1, 0, faces.n);
  for (let i = 0; i < strokes.n; i++) ranks[faces.n + i] = strokes.colours[i] * (BROADEST + 1) + BROADEST - widths[i];
  return ranks;
}

// A shape is as near as its middle: the mean of its corners, the middle of a stroke, a centre.
function depthLevels({ strokes, faces, rounds }, depths, extent, behind) {
  const many = faces.n + strokes.n + rounds.n, levels = new Float64Array(many + behind.length), unit = DEPTH_LEVELS / (extent || 1);
  for (let i = 0; i < faces.n; i++) levels[i] = halfToEven(meanOf(depths, cornersOf(faces, i)) * unit);
  for (let i = 0; i < strokes.n; i++)
    levels[faces.n + i] = halfToEven(((depths[strokes.from[i]] + depths[strokes.to[i]]) / 2) * unit);
  for (let i = 0; i < rounds.n; i++) levels[faces.n + strokes.n + i] = halfToEven(depths[rounds.centres[i]] * unit);
  const least = levels.subarray(0, many).reduce((found, level) => Math.min(found, level), Infinity);
  behind.forEach((depth, i) => { levels[many + i] = Math.max(least, halfToEven(depth * unit)); });
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
