// Where shapes lie on a canvas: fitted into a frame, and in space seen in perspective.
//
// In space x grows to the right, z upwards, and y away from a viewer who stands at the front, at 0 degrees around and 0 above,
// and looks at the middle of an upright cylinder around all shapes, of which those parts count that some turn fills. A frame belongs to a view, not to the shapes: whatever else is
// painted in it keeps its place and its size.
//
// Then in which order they are painted, and how broad strokes are, as in the pictures that stay.

import { clamped, halfToEven, times } from "../books/numbers.js";
import { BOLDEST, BROADEST, DEPTH_LEVELS, DISTANCE, FINEST, LARGEST_SCALE, LEAST_WIDTHS, MOST_CYLINDERS, ORDER_WIDTHS, SLIMMEST, STURDY, USUAL_STROKE } from "./constants.js";
import { MOST_POINTS } from "./turtle_actions.js";

const FRAME_MARGIN = 14;
const NOTHING_WIDE = 1e-9;
const FINEST_IN_SPACE = 0.6; // how much finer strokes become where they are short and too many to be seen each by itself
const RADIANS = Math.PI / 180;
const RINGS = 48; // into so many slices of the cylinder shapes are sorted by their height
const edgesOfFaces = new WeakMap();

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

// How far to the side, and up or down, rings around an upright axis are seen, each a height and a radius.
function reachOf(rings, distance, level, steep) {
  let [wide, high] = [0, 0];
  for (const [z, far] of rings) {
    const away = distance - z * steep;
    wide = Math.max(wide, distance === Infinity ? far : (distance * far) / Math.sqrt(away ** 2 - (far * level) ** 2));
    for (const ahead of [far, -far]) high = Math.max(high, Math.abs(z * level - ahead * steep) * magnified(distance, ahead * level + z * steep));
  }
  return [wide, high];
}

// Width and height from the front, in the units of the model, however broad the strokes are; null if nothing is drawn.
export function widthAndHeight(shapes) {
  const spans = [shapes.x, shapes.z ?? shapes.y].map((axis) => {
    let [least, most] = [Infinity, -Infinity];
    eachPoint(shapes, (i, reach) => ([least, most] = [Math.min(least, axis[i] - reach), Math.max(most, axis[i] + reach)]), 0);
    return most - least;
  });
  return spans[0] >= 0 ? spans : null;
}

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

export const magnified = (distance, towards) => (distance === Infinity ? 1 : distance / (distance - towards));

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
  const order = paintingOrder(shapes, widths);
  return { x, y, widths, order, painted: order };
}

function seenInSpace(frame, shapes, single) {
  const seen = projected(frame, shapes), { strokes } = shapes, { depths, factors } = seen;
  const starts = frame.detailed ? startWidths(strokes, single) : single, ends = [new Float64Array(strokes.n), new Float64Array(strokes.n)];
  const behind = new Float64Array(frame.detailed ? strokes.n : 0), widths = new Int32Array(strokes.n), edges = edgesOf(shapes.faces);
  for (let i = 0; i < strokes.n; i++) {
    const a = strokes.from[i], b = strokes.to[i];
    ends[0][i] = starts[i] * factors[a];
    ends[1][i] = single[i] * factors[b];
    widths[i] = clamped(SLIMMEST, BROADEST, Math.round((ends[0][i] + ends[1][i]) / 2));
    if (frame.detailed) behind[i] = edges.has(pairOf(a, b)) ? -Infinity
      : (depths[a] + depths[b]) / 2 - Math.hypot(shapes.x[b] - shapes.x[a], shapes.y[b] - shapes.y[a], shapes.z[b] - shapes.z[a]);
  }
  const painted = paintingOrder(shapes, widths, depths, frame.extent, behind), all = shapes.faces.n + strokes.n + shapes.rounds.n;
  return { ...seen, widths, ends, painted, order: painted.filter((number) => number < all) };
}

// The edges of faces, as pairs of points: a stroke there has no casing that would part it from its face.
function edgesOf(faces) {
  if (!edgesOfFaces.has(faces)) edgesOfFaces.set(faces, new Set(times(faces.n, (i) => {
    const corners = cornersOf(faces, i);
    return Array.from(corners, (corner, k) => pairOf(corner, corners[(k + 1) % corners.length]));
  }).flat()));
  return edgesOfFaces.get(faces);
}

const pairOf = (one, other) => Math.min(one, other) * MOST_POINTS + Math.max(one, other);

function projected({ scale, x0, y0, cos, sin, level, steep, reach, distance, middle: [cx, cy, cz] }, { n, x, y, z }) {
  const seen = { x: new Float64Array(n), y: new Float64Array(n), depths: new Float64Array(n), factors: new Float64Array(n),
    nearness: new Float64Array(n) };
  for (let i = 0; i < n; i++) {
    const px = x[i] - cx, py = y[i] - cy, pz = z[i] - cz, ahead = px * sin - py * cos, towards = ahead * level + pz * steep;
    const factor = magnified(distance, towards);
    seen.x[i] = x0 + (px * cos + py * sin) * scale * factor;
    seen.y[i] = y0 - (pz * level - ahead * steep) * scale * factor;
    seen.depths[i] = (x[i] * sin - y[i] * cos) * level + z[i] * steep;
    seen.factors[i] = factor;
    seen.nearness[i] = clamped(0, 1, towards / (2 * reach || 1) + 0.5);
  }
  return seen;
}

// How broad each stroke begins: as broad as the last stroke of its branch that ends there, where the turtle has set the widths.
function startWidths({ n, from, to, orders, widths }, single) {
  if (widths.some((width) => width <= 0)) return single;
  const ending = new Map(), branch = (point, i) => point * (1 << 20) + orders[i];
  for (let i = 0; i < n; i++) ending.set(branch(to[i], i), single[i]);
  return single.map((width, i) => ending.get(branch(from[i], i)) ?? width);
}

const MOST_NUMBERED = 2 ** 31; // more shapes there cannot be
const LAST_RANK = 2 ** 21;

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
// strokes by colours, and of one colour the broad ones first. `depths` says how far points lie towards the viewer, and `behind`
// how far the casings of strokes, whose numbers follow all others; of what is as far away they are painted first.
/** @param {ArrayLike<number>} behind */
function paintingOrder(shapes, widths, depths = null, extent = 0, behind = []) {
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

export function cornersOf({ starts, corners }, i) {
  return corners.subarray(starts[i], starts[i + 1]);
}

export function meanOf(places, numbers) {
  let sum = 0;
  for (const number of numbers) sum += places[number];
  return sum / numbers.length;
}
