// How shapes lie in space: in perspective, from far to near, and turned to the viewer.

import { clamped, halfToEven, times } from "../books/numbers.js";
import { BROADEST, DARK, DEPTH_LEVELS, LIT, RIM, SLIMMEST, TO_LIGHT } from "./constants.js";
import { cornersOf, meanOf, outline } from "./outlines.js";
import { MOST_POINTS } from "./turtle_actions.js";

const edgesOfFaces = new WeakMap();

export const magnified = (distance, towards) => (distance === Infinity ? 1 : distance / (distance - towards));

// How far to the side, and up or down, rings around an upright axis are seen, each a height and a radius.
export function reachOf(rings, distance, level, steep) {
  let [wide, high] = [0, 0];
  for (const [z, far] of rings) {
    const away = distance - z * steep;
    wide = Math.max(wide, distance === Infinity ? far : (distance * far) / Math.sqrt(away ** 2 - (far * level) ** 2));
    for (const ahead of [far, -far]) high = Math.max(high, Math.abs(z * level - ahead * steep) * magnified(distance, ahead * level + z * steep));
  }
  return [wide, high];
}

// Shapes as they are seen in space, given the widths of strokes that nothing magnifies: how broad they are at both ends, and how far
// shapes, and the casings of strokes behind them, lie towards the viewer, as whole levels.
export function seenInDepth(frame, shapes, single) {
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
  return { ...seen, widths, ends, behind, levels: depthLevels(shapes, depths, frame.extent, behind) };
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

// The normal of a face, by Newell's method: to the right, up, towards the viewer.
export function normalOf(corners, { x, y, z }, { cos, sin, level, steep }) {
  let [nx, ny, nz] = [0, 0, 0];
  corners.forEach((one, i) => {
    const next = corners[(i + 1) % corners.length];
    nx += (y[one] - y[next]) * (z[one] + z[next]);
    ny += (z[one] - z[next]) * (x[one] + x[next]);
    nz += (x[one] - x[next]) * (y[one] + y[next]);
  });
  const ahead = nx * sin - ny * cos;
  return [nx * cos + ny * sin, nz * level - ahead * steep, ahead * level + nz * steep];
}

// A stroke as a tapered cylinder with round ends: its body, a light stripe along it, and a dark one.
export function cylinder([ax, ay], [bx, by], [ra, rb]) {
  const length = Math.hypot(bx - ax, by - ay), along = length > 0 ? [(bx - ax) / length, (by - ay) / length] : [0, -1];
  const left = [along[1], -along[0]], brightest = Math.atan2(left[0] * TO_LIGHT[0] - left[1] * TO_LIGHT[1], TO_LIGHT[2]);
  const away = brightest < 0 ? 1 : -1;
  const at = (end, angle) => {
    const [x, y, radius, way] = end ? [bx, by, rb, 1] : [ax, ay, ra, -1], aside = radius * Math.sin(angle), ahead = way * radius * Math.cos(angle);
    return [x + aside * left[0] + ahead * along[0], y + aside * left[1] + ahead * along[1]];
  };
  const stripe = (first, last) => {
    const middle = (first + last) / 2;
    return outline([[0, middle], [0, first], [1, first], [1, middle], [1, last], [0, last]], ([end, angle]) => at(end, angle));
  };
  return { body: capsule(ax, ay, bx, by, ra, rb, Math.atan2(left[1], left[0])),
    light: stripe(Math.max(brightest - LIT, -RIM), Math.min(brightest + LIT, RIM)),
    dark: stripe(brightest + away * DARK, (away * Math.PI) / 2) };
}

function capsule(ax, ay, bx, by, ra, rb, left) {
  const path = new Path2D();
  path.arc(bx, by, rb, left, left + Math.PI);
  path.arc(ax, ay, ra, left + Math.PI, left + 2 * Math.PI);
  path.closePath();
  return path;
}
