// Where shapes lie on a canvas: fitted into a frame, and in space seen in perspective.
//
// In space x grows to the right, z upwards, and y away from a viewer who stands at the front, at 0 degrees around and 0 above,
// and looks at the middle of an upright cylinder around all shapes, of which those parts count that some turn fills. A frame belongs to a view, not to the shapes: whatever else is
// painted in it keeps its place and its size.
//
// Then in which order they are painted, and how broad strokes are, as in the pictures that stay.

import { clamped, halfToEven, times } from "../books/numbers.js";
import { BOLDEST, BROADEST, DISTANCE, FINEST, LARGEST_SCALE, LEAST_WIDTHS, MOST_CYLINDERS, ORDER_WIDTHS, SLIMMEST, STURDY, USUAL_STROKE } from "./constants.js";
import { reachOf, seenInDepth } from "./depths.js";

const FRAME_MARGIN = 14;
const NOTHING_WIDE = 1e-9;
const FINEST_IN_SPACE = 0.6; // how much finer strokes become where they are short and too many to be seen each by itself
const RADIANS = Math.PI / 180;
const RINGS = 48; // into so many slices of the cylinder shapes are sorted by their height

// The room that shapes take, with the round ends of broad strokes: in the plane a box, in space the upright cylinder around
// them, which no turn leads out of.
export function boundsOf(shapes) {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  const { pixel } = shapes, axes = [shapes.x, shapes.y, shapes.z].filter(Boolean), inSpace = axes.length > 2;
  let bulge = 0;
  eachPoint(shapes, (point, reach) => {
    bulge = Math.max(bulge, reach);
    for (let axis = 0; axis < axes.length; axis++) {
      const place = axes[axis][point], more = inSpace ? 0 : reach;
      if (place - more < least[axis]) least[axis] = place - more;
      if (place + more > most[axis]) most[axis] = place + more;
    }
  });
  const spans = axes.map((_, axis) => Math.max(0, most[axis] - least[axis]));
  const middle = axes.map((_, axis) => (least[axis] <= most[axis] ? (least[axis] + most[axis]) / 2 : 0));
  if (!inSpace) return { middle, pixel, extent: 0, across: spans[0] / 2, up: spans[1] / 2 };
  let across = 0;
  const slices = times(RINGS, () => [Infinity, -Infinity, 0]); // the lowest and the highest place of each, and how far it reaches
  eachPoint(shapes, (i, reach) => {
    const z = shapes.z[i] - middle[2], slice = slices[clamped(0, RINGS - 1, Math.floor(RINGS * (z / (spans[2] || 1) + 0.5)))];
    const far = Math.hypot(shapes.x[i] - middle[0], shapes.y[i] - middle[1]);
    [slice[0], slice[1], slice[2]] = [Math.min(slice[0], z - reach), Math.max(slice[1], z + reach), Math.max(slice[2], far + reach)];
    across = Math.max(across, far);
  });
  const rings = slices.filter(([low, high]) => low <= high).flatMap(([low, high, far]) => [[low, far], [high, far]]);
  return { middle, pixel, extent: Math.max(...spans), across: across + bulge, up: spans[2] / 2 + bulge, rings };
}

// Width and height from the front, in the units of the model, however broad the strokes are; null if nothing is drawn.
export function widthAndHeight(shapes) {
  const spans = spansOf(shapes, [shapes.x, shapes.z ?? shapes.y]);
  return spans[0] >= 0 ? spans : null;
}

// How far shapes reach along some axes, each of which says where points lie; less than nothing without shapes.
export const spansOf = (shapes, axes) => axes.map((axis) => {
  let [least, most] = [Infinity, -Infinity];
  eachPoint(shapes, (i, reach) => ([least, most] = [Math.min(least, axis[i] - reach), Math.max(most, axis[i] + reach)]), 0);
  return most - least;
});

// Visit every point that is drawn, with how far the shape reaches beyond it; `broad` is 0 for strokes that are lines.
function eachPoint({ strokes, faces, rounds, labels }, visit, broad = 1) {
  for (let i = 0; i < strokes.n; i++) {
    const reach = broad * Math.max(0, strokes.widths[i] / 2);
    visit(strokes.from[i], reach);
    visit(strokes.to[i], reach);
  }
  for (const corner of faces.corners) visit(corner, 0);
  for (let i = 0; i < rounds.n; i++) visit(rounds.centres[i], rounds.radii[i]);
  for (const point of labels?.points ?? []) visit(point, 0);
}

// The frame of a view, into which a box fits where it is not brought nearer: by default that of the shapes. Where the eye is
// infinitely far away, nothing is magnified.
export function frameOf(shapes, width, height, { around = 0, above = 0, near = 1, shift = [0, 0], box = null, far = false } = {}) {
  const { middle, extent, across, up, pixel, rings = [[up, across], [-up, across]] } = box ?? boundsOf(shapes), inSpace = shapes.dimension === 3;
  const level = Math.cos(above * RADIANS), steep = Math.sin(above * RADIANS), reach = across * level + up * Math.abs(steep);
  const distance = inSpace && !far ? DISTANCE * Math.hypot(across, up) || 1 : Infinity;
  const [wide, high] = inSpace ? reachOf(rings, distance, level, steep) : [across, up];
  const scale = near * Math.min((width / 2 - FRAME_MARGIN) / Math.max(wide, NOTHING_WIDE),
    (height / 2 - FRAME_MARGIN) / Math.max(high, NOTHING_WIDE), LARGEST_SCALE);
  const detailed = inSpace && shapes.strokes.n <= MOST_CYLINDERS;
  const [finest, broadest] = detailed ? [STURDY, BOLDEST] : [inSpace ? FINEST_IN_SPACE : FINEST, 1];
  return {
    inSpace, detailed, scale, distance, middle, extent, pixel, width, x0: width / 2 + shift[0], y0: height / 2 + shift[1], seen: null,
    cos: Math.cos(around * RADIANS), sin: Math.sin(around * RADIANS), level, steep, reach,
    thin: Math.min(broadest, Math.max(finest, (shapes.typical * scale) / USUAL_STROKE)),
  };
}

// Shapes as they are seen in a frame: x to the right and y down in pixels; in space depths towards the viewer in units, how near
// that is, from 0 to 1, and by how much points are magnified there; how broad strokes are; and the order of painting.
export function seenIn(frame, shapes) {
  if (frame.seen?.shapes !== shapes) {
    const widths = strokeWidths(shapes.strokes, (frame.scale * frame.pixel) / shapes.pixel, frame.thin);
    frame.seen = { shapes, ...(frame.inSpace ? seenInSpace(frame, shapes, widths) : seenInPlane(frame, shapes, widths)) };
  }
  return frame.seen;
}

function seenInPlane({ scale, x0, y0, middle: [cx, cy] }, shapes, widths) {
  const { n } = shapes, x = new Float64Array(n), y = new Float64Array(n);
  for (let i = 0; i < n; i++) {
    x[i] = x0 + (shapes.x[i] - cx) * scale;
    y[i] = y0 - (shapes.y[i] - cy) * scale;
  }
  const order = paintingOrder(shapes, planeRanks(shapes, widths));
  return { x, y, widths, order, painted: order };
}

const MOST_NUMBERED = 2 ** 31; // more shapes there cannot be
const LAST_RANK = 2 ** 21;

function seenInSpace(frame, shapes, single) {
  const seen = seenInDepth(frame, shapes, single), painted = paintingOrder(shapes, seen.levels), all = painted.length - seen.behind.length;
  return { ...seen, painted, order: painted.filter((number) => number < all) };
}

// The width of each stroke, in tenths of a pixel: as the turtle has set it, or by its branch order.
function strokeWidths({ n, orders, widths }, scale, thin) {
  const own = ORDER_WIDTHS.map((width, order) => Math.max(LEAST_WIDTHS[order], halfToEven(10 * width * thin)));
  const found = new Int32Array(n);
  for (let i = 0; i < n; i++)
    found[i] = widths[i] < 0 ? own[Math.min(orders[i], own.length - 1)]
      : clamped(SLIMMEST, BROADEST, halfToEven(widths[i] * scale * 10));
  return found;
}

// The numbers of faces, strokes and rounds, counted in this order, as they are painted: in space from far to near; in the plane
// strokes by colours, and of one colour the broad ones first. The casings of strokes, whose numbers follow all others, are painted
// first of what has the same rank.
function paintingOrder({ strokes, faces, rounds }, ranks) {
  const many = faces.n + strokes.n + rounds.n, all = ranks.length, casings = all - many, keys = new Float64Array(all);
  for (let i = 0; i < all; i++) keys[i] = ranks[i] * MOST_NUMBERED + (i < many ? i + casings : i - many);
  keys.sort();
  for (let i = 0; i < all; i++) {
    const at = keys[i] - Math.floor(keys[i] / MOST_NUMBERED) * MOST_NUMBERED;
    keys[i] = at < casings ? at + many : at - casings;
  }
  return keys;
}

function planeRanks({ strokes, faces, rounds }, widths) {
  const ranks = new Float64Array(faces.n + strokes.n + rounds.n).fill(LAST_RANK).fill(-1, 0, faces.n);
  for (let i = 0; i < strokes.n; i++) ranks[faces.n + i] = strokes.colours[i] * (BROADEST + 1) + BROADEST - widths[i];
  return ranks;
}
