// The shapes of a turtle on a canvas: fitted into a frame, painted from far to near, and found again under a pointer.
//
// In space x grows to the right, z upwards, and y away from a viewer who stands at the front, at 0 degrees around and 0 above,
// and far away. A frame belongs to a view, not to the shapes: whatever else is painted in it keeps its place and its size.

import { lineColour, mixed } from "./colours.js";
import { cornersOf, meanOf, paintingOrder, strokeWidths } from "./painting_order.js";
import { HOLLOW } from "./turtle_actions.js";

const FRAME_MARGIN = 14;
const LARGEST_SCALE = 120; // pixels a unit
const NOTHING_WIDE = 1e-9;
const THINNEST = 0.3, THINNEST_IN_SPACE = 0.6; // how much thinner strokes become where they stand close
const USUAL_STROKE = 12; // pixels that strokes are long where they are not thinner
const LAYERS = 32; // of a drawing in space, by which it fades
const FADING = 0.45; // how much paler the farthest layer is than the nearest
const LIGHTENED = 0.7; // how much of a colour is left on dark paper, where thin and far strokes would be lost else
const EDGE = 0.6, RING = 1, MARKED_EDGE = 3, SMALLEST_RADIUS = 0.8; // pixels
const RADIANS = Math.PI / 180;

// What surrounds a shape that is traced: bands of so many pixels more than the shape, in the colour of what is lit or of the
// paper, broken by dashes or not. They are told apart without their colour.
const SURROUNDED = {
  self: [[8, "lit"], [3, "paper"]],
  mother: [[8, "lit", [6, 5]], [3, "paper"]],
  daughter: [[12, "lit"], [9, "paper"], [5.5, "lit"], [2.5, "paper"]],
};

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
  eachPoint(shapes, (i) => {
    across = Math.max(across, Math.hypot(shapes.x[i] - middle[0], shapes.y[i] - middle[1]));
  });
  return { middle, pixel, extent: Math.max(...spans), across: across + bulge, up: spans[2] / 2 + bulge };
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
function eachPoint({ strokes, faces, rounds }, visit, broad = 1) {
  for (let i = 0; i < strokes.n; i++) {
    const reach = broad * Math.max(0, strokes.widths[i] / 2);
    visit(strokes.from[i], reach);
    visit(strokes.to[i], reach);
  }
  for (const corner of faces.corners) visit(corner, 0);
  for (let i = 0; i < rounds.n; i++) visit(rounds.centres[i], rounds.radii[i]);
}

// The frame of a view, into which a box fits where it is not brought nearer: by default that of the shapes.
export function frameOf(shapes, width, height, { around = 0, above = 0, near = 1, shift = [0, 0], box = null } = {}) {
  const { middle, extent, across, up, pixel } = box ?? boundsOf(shapes), inSpace = shapes.dimension === 3;
  const level = Math.cos(above * RADIANS), steep = Math.sin(above * RADIANS);
  const high = inSpace ? up * level + across * Math.abs(steep) : up;
  const scale = near * Math.min((width / 2 - FRAME_MARGIN) / Math.max(across, NOTHING_WIDE),
    (height / 2 - FRAME_MARGIN) / Math.max(high, NOTHING_WIDE), LARGEST_SCALE);
  const thinnest = inSpace ? THINNEST_IN_SPACE : THINNEST;
  return {
    inSpace, scale, middle, extent, pixel, x0: width / 2 + shift[0], y0: height / 2 + shift[1], seen: null,
    cos: Math.cos(around * RADIANS), sin: Math.sin(around * RADIANS), level, steep,
    reach: across * level + up * Math.abs(steep),
    thin: Math.min(1, Math.max(thinnest, (shapes.typical * scale) / USUAL_STROKE)),
  };
}

// Shapes as they are seen in a frame: x to the right and y down in pixels, depths towards the viewer in units; how broad
// strokes are; and the order of painting.
function seenIn(frame, shapes) {
  if (frame.seen?.shapes !== shapes) {
    const points = frame.inSpace ? projected(frame, shapes) : fitted(frame, shapes);
    const widths = strokeWidths(shapes.strokes, (frame.scale * frame.pixel) / shapes.pixel, frame.thin);
    frame.seen = { shapes, widths, ...points, order: paintingOrder(shapes, widths, points.depths, frame.extent) };
  }
  return frame.seen;
}

function fitted({ scale, x0, y0, middle: [cx, cy] }, { n, x, y }) {
  const seen = { x: new Float64Array(n), y: new Float64Array(n) };
  for (let i = 0; i < n; i++) {
    seen.x[i] = x0 + (x[i] - cx) * scale;
    seen.y[i] = y0 - (y[i] - cy) * scale;
  }
  return seen;
}

function projected({ scale, x0, y0, cos, sin, level, steep, middle: [cx, cy, cz] }, { n, x, y, z }) {
  const seen = { x: new Float64Array(n), y: new Float64Array(n), depths: new Float64Array(n) };
  for (let i = 0; i < n; i++) {
    const px = x[i] - cx, py = y[i] - cy, towards = px * sin - py * cos;
    seen.x[i] = x0 + (px * cos + py * sin) * scale;
    seen.y[i] = y0 - ((z[i] - cz) * level - towards * steep) * scale;
    seen.depths[i] = (x[i] * sin - y[i] * cos) * level + z[i] * steep;
  }
  return seen;
}

// Paint shapes. A look has the theme with its colours, the states that are marked, and for positions in the word whether they
// are "self", "mother" or "daughter" of what is traced.
export function paint(pen, shapes, frame, { theme, marked = new Set(), lit = new Map() }) {
  const seen = seenIn(frame, shapes);
  pen.lineCap = pen.lineJoin = "round";
  paintShapes(pen, shapes, frame, seen, theme, seen.order, marked);
  if (!lit.size) return;
  const traced = seen.order.filter((number) => lit.has(shapeOf(shapes, number).position));
  for (const kind of Object.keys(SURROUNDED))
    surround(pen, shapes, frame, seen, theme, SURROUNDED[kind], traced.filter((number) =>
      lit.get(shapeOf(shapes, number).position) === kind));
  paintShapes(pen, shapes, frame, seen, theme, traced, new Set());
}

// Which shape has a number: its group, its number there, and what it belongs to.
function shapeOf({ strokes, faces, rounds }, number) {
  const [group, i] = number < faces.n ? [faces, number] : number < faces.n + strokes.n ? [strokes, number - faces.n]
    : [rounds, number - faces.n - strokes.n];
  return { group, i, position: group.positions[i], state: group.states[i], colour: group.colours[i] };
}

// The colours of a palette in each strength, as they are seen on the paper, each mixed once.
function shades(palette, theme) {
  const known = new Map(), lines = palette.map((colour) => lineColour(colour, theme));
  return (colour, strength) => {
    const key = colour + strength / 2, line = theme.dark ? mixed(lines[colour], theme.ink, LIGHTENED) : lines[colour];
    if (!known.has(key)) known.set(key, mixed(line, theme.paper, strength));
    return known.get(key);
  };
}

function paintShapes(pen, shapes, frame, seen, theme, order, marked) {
  const { strokes, faces, rounds, palette } = shapes, { x, y, depths, widths } = seen, shade = shades(palette, theme);
  const strengthAt = strengths(frame);
  let runs = [], run; // strokes that nothing lies between; those of a run look alike

  function addStroke(i) {
    const a = strokes.from[i], b = strokes.to[i], colour = strokes.colours[i], width = widths[i] / 10;
    const strength = depths ? strengthAt((depths[a] + depths[b]) / 2) : 1, isMarked = marked.has(strokes.states[i]);
    if (!run || run.colour !== colour || run.width !== width || run.strength !== strength || run.isMarked !== isMarked)
      runs.push((run = { colour, width, strength, isMarked, path: new Path2D() }));
    run.path.moveTo(x[a], y[a]);
    run.path.lineTo(x[b], y[b]);
  }

  function paintRuns() {
    for (const { width, path, isMarked } of runs)
      if (isMarked) band(pen, path, theme.markEdge, Math.max(5, 9 * frame.thin, width + 4), 0.45);
    for (const { colour, width, strength, path } of runs) band(pen, path, shade(colour, strength), width);
    runs = [];
    run = undefined;
  }

  function fill(outline, group, i, strength, inside, edge) {
    const isMarked = marked.has(group.states[i]);
    pen.fillStyle = shade(group.colours[i], inside);
    pen.fill(outline);
    band(pen, outline, isMarked ? theme.markEdge : shade(group.colours[i], strength), isMarked ? MARKED_EDGE : edge);
  }

  for (const number of order) {
    if (number >= faces.n && number < faces.n + strokes.n) {
      addStroke(number - faces.n);
      continue;
    }
    paintRuns();
    const { group, i } = shapeOf(shapes, number);
    if (group === faces) {
      const corners = cornersOf(faces, i), strength = depths ? strengthAt(meanOf(depths, corners)) : 1;
      fill(faceOutline(seen, corners), faces, i, strength, (0.45 + 0.5 * facing(corners, seen, frame)) * strength, EDGE);
    } else {
      const strength = depths ? strengthAt(depths[rounds.centres[i]]) : 1;
      fill(roundOutline(seen, frame, rounds, i), rounds, i, strength, rounds.kinds[i] === HOLLOW ? 0 : 0.7 * strength, RING);
    }
  }
  paintRuns();
}

function band(pen, path, colour, width, alpha = 1) {
  pen.globalAlpha = alpha;
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke(path);
  pen.globalAlpha = 1;
}

function faceOutline({ x, y }, corners) {
  const outline = new Path2D();
  for (const corner of corners) outline.lineTo(x[corner], y[corner]);
  outline.closePath();
  return outline;
}

function roundOutline({ x, y }, frame, rounds, i) {
  const outline = new Path2D();
  outline.arc(x[rounds.centres[i]], y[rounds.centres[i]], radiusOf(frame, rounds, i), 0, 2 * Math.PI);
  return outline;
}

const radiusOf = ({ scale }, rounds, i) => Math.max(SMALLEST_RADIUS, rounds.radii[i] * scale);

// How strong colours are at a depth: the farther, the paler.
function strengths({ middle: [cx, cy, cz], sin, cos, level, steep, reach }) {
  const centre = (cx * sin - cy * cos) * level + cz * steep;
  return (depth) => {
    const layer = Math.floor(((depth - centre) / reach + 1) * 0.5 * LAYERS);
    return 1 - FADING * (1 - Math.max(0, Math.min(LAYERS - 1, layer)) / (LAYERS - 1));
  };
}

// How much a face looks at the viewer, from 0 to 1; half in the plane.
function facing(corners, { x, y, depths }, { scale }) {
  if (!depths) return 0.5;
  let across = 0, up = 0, towards = 0;
  corners.forEach((one, i) => {
    const next = corners[(i + 1) % corners.length], deep = (depths[one] - depths[next]) * scale;
    across += (y[one] - y[next]) * (depths[one] + depths[next]) * scale;
    up += deep * (x[one] + x[next]);
    towards += (x[one] - x[next]) * (y[one] + y[next]);
  });
  return Math.abs(towards) / (Math.hypot(across, up, towards) || 1);
}

// Bands around some shapes, the broadest first.
function surround(pen, shapes, frame, seen, theme, bands, numbers) {
  const paths = Array.from(numbers, (number) => outlineOf(shapes, frame, seen, number));
  for (const [more, colour, dashes = []] of bands) {
    pen.setLineDash(dashes);
    pen.lineCap = dashes.length ? "butt" : "round";
    for (const { path, width } of paths) band(pen, path, theme[colour], width + more);
  }
  pen.setLineDash([]);
  pen.lineCap = "round";
}

function outlineOf(shapes, frame, seen, number) {
  const { group, i } = shapeOf(shapes, number), { x, y } = seen;
  if (group === shapes.faces) return { path: faceOutline(seen, cornersOf(group, i)), width: EDGE };
  if (group === shapes.rounds) return { path: roundOutline(seen, frame, group, i), width: RING };
  const path = new Path2D();
  path.moveTo(x[group.from[i]], y[group.from[i]]);
  path.lineTo(x[group.to[i]], y[group.to[i]]);
  return { path, width: seen.widths[i] / 10 };
}

// The position in the word of what lies at a point: of the shape painted last there, else of the nearest within reach; or -1.
export function shapeAt(shapes, frame, x, y, reach) {
  const seen = seenIn(frame, shapes);
  let found = -1, nearest = reach;
  for (let at = seen.order.length - 1; at >= 0 && nearest > 0; at--) {
    const distance = distanceTo(shapes, frame, seen, seen.order[at], x, y);
    if (distance > nearest || (distance === nearest && found >= 0)) continue;
    [found, nearest] = [shapeOf(shapes, seen.order[at]).position, distance];
  }
  return found;
}

// How far a point is from a shape, in pixels; 0 inside.
function distanceTo(shapes, frame, seen, number, x, y) {
  const { group, i } = shapeOf(shapes, number);
  if (group === shapes.rounds)
    return Math.max(0, Math.hypot(seen.x[group.centres[i]] - x, seen.y[group.centres[i]] - y) - radiusOf(frame, group, i));
  if (group === shapes.strokes)
    return Math.max(0, distanceToLine(seen, group.from[i], group.to[i], x, y) - seen.widths[i] / 20);
  const corners = cornersOf(group, i);
  if (isInside(seen, corners, x, y)) return 0;
  return corners.reduce((least, corner, k) =>
    Math.min(least, distanceToLine(seen, corner, corners[(k + 1) % corners.length], x, y)), Infinity);
}

function distanceToLine(seen, from, to, x, y) {
  const ax = x - seen.x[from], ay = y - seen.y[from], bx = seen.x[to] - seen.x[from], by = seen.y[to] - seen.y[from];
  const part = Math.max(0, Math.min(1, (ax * bx + ay * by) / (bx * bx + by * by || 1)));
  return Math.hypot(ax - part * bx, ay - part * by);
}

function isInside(seen, corners, x, y) {
  let inside = false;
  corners.forEach((one, k) => {
    const other = corners[(k + 1) % corners.length], ya = seen.y[one], yb = seen.y[other];
    if ((ya > y) !== (yb > y) && x < seen.x[one] + ((y - ya) / (yb - ya)) * (seen.x[other] - seen.x[one])) inside = !inside;
  });
  return inside;
}
