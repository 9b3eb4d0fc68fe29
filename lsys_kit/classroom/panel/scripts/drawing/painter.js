// The shapes of a turtle on a canvas, painted from far to near and found again under a pointer.

import { mixed } from "./colours.js";
import { cylinder } from "./cylinders.js";
import { BRIGHT, DIM, EDGE, OWN, brightness, shades, sphereFill } from "./lighting.js";
import { cornersOf, meanOf } from "./painting_order.js";
import { seenIn } from "./projection.js";
import { BALL, HOLLOW } from "./turtle_actions.js";

const FILLED = 0.7; // the strength of the colour inside a surface in the plane
const FACE_EDGE = 0.6, RING = 1, MARKED_EDGE = 3, SMALLEST_RADIUS = 0.8; // pixels
const LABEL_FONT = "12px sans-serif", LABEL_GAP = 5, LABEL_HALO = 3; // pixels
const TONED = 16; // tenths of a pixel from which on one sees light and shade on a stroke
const LEAST_CASING = 4, CASING = 0.4, BROADEST_CASING = 10; // tenths of a pixel that a casing is broader, the part of its stroke, the most

// What surrounds a shape that is traced: bands of so many pixels more than the shape, in the colour of what is lit or of the
// paper, broken by dashes or not. They are told apart without their colour.
const SURROUNDED = {
  self: [[8, "lit"], [3, "paper"]],
  mother: [[8, "lit", [6, 5]], [3, "paper"]],
  daughter: [[12, "lit"], [9, "paper"], [5.5, "lit"], [2.5, "paper"]],
};

// Paint shapes. A look has the theme with its colours, the states that are marked, and for positions in the word whether they
// are "self", "mother" or "daughter" of what is traced.
export function paint(pen, shapes, frame, { theme, marked = new Set(), lit = new Map() }) {
  const seen = seenIn(frame, shapes);
  pen.lineCap = pen.lineJoin = "round";
  paintShapes(pen, shapes, frame, seen, theme, seen.painted, marked);
  if (lit.size) paintTraced(pen, shapes, frame, seen, theme, lit);
  paintLabels(pen, shapes.labels, frame, seen, theme);
}

function paintTraced(pen, shapes, frame, seen, theme, lit) {
  const traced = seen.order.filter((number) => lit.has(shapeOf(shapes, number).position));
  for (const kind of Object.keys(SURROUNDED))
    surround(pen, shapes, frame, seen, theme, SURROUNDED[kind], traced.filter((number) =>
      lit.get(shapeOf(shapes, number).position) === kind));
  paintShapes(pen, shapes, frame, seen, theme, traced, new Set());
}

// What the turtle has written, each text to the right of its point, as far as the canvas goes.
function paintLabels(pen, labels, frame, { x, y }, theme) {
  pen.font = LABEL_FONT;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  labels?.texts.forEach((text, i) => {
    const point = labels.points[i], start = Math.min(x[point] + LABEL_GAP, frame.width - LABEL_GAP - pen.measureText(text).width);
    pen.lineWidth = LABEL_HALO;
    pen.strokeStyle = theme.paper;
    pen.strokeText(text, start, y[point]);
    pen.fillStyle = theme.ink;
    pen.fillText(text, start, y[point]);
  });
  pen.textBaseline = "alphabetic";
}

// Which shape has a number: its group, its number there, and what it belongs to.
function shapeOf({ strokes, faces, rounds }, number) {
  const [group, i] = number < faces.n ? [faces, number] : number < faces.n + strokes.n ? [strokes, number - faces.n]
    : [rounds, number - faces.n - strokes.n];
  return { group, i, position: group.positions[i], state: group.states[i], colour: group.colours[i] };
}

function paintShapes(pen, shapes, frame, seen, theme, order, marked) {
  const { strokes, faces, rounds, palette } = shapes, { x, y, nearness, widths } = seen, shade = shades(palette, theme);
  const many = faces.n + strokes.n + rounds.n;
  let runs = [], run; // strokes that nothing lies between; those of a run look alike

  function addStroke(i, colour, width, isMarked) {
    if (!run || run.colour !== colour || run.width !== width || run.isMarked !== isMarked)
      runs.push((run = { colour, width, isMarked, path: new Path2D() }));
    run.path.moveTo(x[strokes.from[i]], y[strokes.from[i]]);
    run.path.lineTo(x[strokes.to[i]], y[strokes.to[i]]);
  }

  function paintRuns() {
    for (const { width, path, isMarked } of runs)
      if (isMarked) band(pen, path, theme.markEdge, Math.max(5, 9 * frame.thin, width + 4), 0.45);
    for (const { colour, width, path } of runs) band(pen, path, colour, width);
    runs = [];
    run = undefined;
  }

  function paintStroke(i) {
    const a = strokes.from[i], b = strokes.to[i], colour = strokes.colours[i], near = nearness ? (nearness[a] + nearness[b]) / 2 : 1;
    addStroke(i, shade(colour, near), widths[i] / 10, marked.has(strokes.states[i]));
    if (!frame.detailed || widths[i] < TONED) return;
    paintRuns();
    const { body, light, dark } = cylinder([x[a], y[a]], [x[b], y[b]], seen.ends.map((breadths) => breadths[i] / 20));
    for (const [part, bright] of [[body, OWN], [light, BRIGHT], [dark, DIM]]) {
      pen.fillStyle = shade(colour, near, bright);
      pen.fill(part);
    }
  }

  function fill(outline, group, i, inside, line, edge) {
    const isMarked = marked.has(group.states[i]);
    if (inside) {
      pen.fillStyle = inside;
      pen.fill(outline);
    }
    if (isMarked || line) band(pen, outline, isMarked ? theme.markEdge : line, isMarked ? MARKED_EDGE : edge);
  }

  function paintFace(i) {
    const corners = cornersOf(faces, i), colour = faces.colours[i], outline = faceOutline(seen, corners);
    if (!nearness) return fill(outline, faces, i, mixed(shade(colour), theme.paper, FILLED), shade(colour), FACE_EDGE);
    const near = meanOf(nearness, corners), bright = brightness(normalOf(corners, shapes, frame));
    const edge = faces.smooth?.[i] ? bright : Math.max(0, bright + EDGE); // a curved surface has no edges between its faces
    return fill(outline, faces, i, shade(colour, near, bright), shade(colour, near, edge), FACE_EDGE);
  }

  function paintRound(i) {
    const centre = rounds.centres[i], colour = rounds.colours[i], outline = roundOutline(seen, frame, rounds, i);
    const near = nearness ? nearness[centre] : 1, isBall = nearness && rounds.kinds[i] === BALL;
    const inside = isBall ? sphereFill(pen, x[centre], y[centre], radiusOf(seen, frame, rounds, i), (bright) => shade(colour, near, bright))
      : rounds.kinds[i] === HOLLOW ? (nearness ? null : theme.paper) : nearness ? shade(colour, near) : mixed(shade(colour), theme.paper, FILLED);
    fill(outline, rounds, i, inside, isBall ? null : nearness ? shade(colour, near, OWN + EDGE) : shade(colour), RING);
  }

  for (const number of order) {
    if (number >= many) addStroke(number - many, theme.paper, casingWidth(widths[number - many]) / 10, false);
    else if (number >= faces.n && number < faces.n + strokes.n) paintStroke(number - faces.n);
    else {
      paintRuns();
      if (number < faces.n) paintFace(number);
      else paintRound(number - faces.n - strokes.n);
    }
  }
  paintRuns();
}

const casingWidth = (width) => width + Math.min(LEAST_CASING + Math.round(CASING * width), BROADEST_CASING);

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

function roundOutline(seen, frame, rounds, i) {
  const { x, y } = seen;
  const outline = new Path2D();
  outline.arc(x[rounds.centres[i]], y[rounds.centres[i]], radiusOf(seen, frame, rounds, i), 0, 2 * Math.PI);
  return outline;
}

const radiusOf = ({ factors }, { scale }, rounds, i) =>
  Math.max(SMALLEST_RADIUS, rounds.radii[i] * scale * (factors ? factors[rounds.centres[i]] : 1));

// The normal of a face, by Newell's method: to the right, up, towards the viewer.
function normalOf(corners, { x, y, z }, { cos, sin, level, steep }) {
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
  if (group === shapes.faces) return { path: faceOutline(seen, cornersOf(group, i)), width: FACE_EDGE };
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
    return Math.max(0, Math.hypot(seen.x[group.centres[i]] - x, seen.y[group.centres[i]] - y) - radiusOf(seen, frame, group, i));
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
