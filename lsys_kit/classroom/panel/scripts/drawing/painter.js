// The shapes of a turtle on a canvas, painted from far to near and found again under a pointer.
//
// A sheet has the pen, the shapes, the frame in which they are seen, where and how broad they are in it, and the theme.

import { clamped } from "../books/numbers.js";
import { brightness, mixed, shades, sphereFill } from "./colours.js";
import { BALL, BRIGHT, BROADEST_CASING, CASING, DIM, EDGE, FACE_EDGE, FILLED, HOLLOW, LABEL_GAP, LEAST_CASING, OWN, RING, SMALLEST_RADIUS, TONED } from "./constants.js";
import { cylinder, normalOf } from "./depths.js";
import { cornersOf, fill, isInside, line, meanOf, outline, write } from "./outlines.js";
import { seenIn } from "./projection.js";
import { sunlit } from "./sunlight.js";

const MARKED_EDGE = 3, LABEL_FONT = "12px sans-serif", LABEL_HALO = 3; // pixels

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
  const seen = (frame.inSpace && sunlit(pen, shapes, frame, theme, marked, lit)) || seenIn(frame, shapes), sheet = { pen, shapes, frame, seen, theme };
  pen.lineCap = pen.lineJoin = "round";
  paintShapes(sheet, seen.painted, marked);
  if (lit.size) paintTraced(sheet, lit);
  paintLabels(sheet);
}

function paintTraced(sheet, lit) {
  const kindOf = (number) => lit.get(shapeOf(sheet.shapes, number).position), traced = sheet.seen.order.filter(kindOf);
  for (const [kind, bands] of Object.entries(SURROUNDED)) surroundTraced(sheet, bands, traced.filter((number) => kindOf(number) === kind));
  paintShapes(sheet, traced, new Set());
}

// What the turtle has written, each text to the right of its point, as far as the canvas goes.
function paintLabels({ pen, shapes: { labels }, frame, seen: { x, y }, theme }) {
  pen.font = LABEL_FONT;
  pen.textBaseline = "middle";
  labels?.texts.forEach((text, i) => {
    const point = labels.points[i], start = Math.min(x[point] + LABEL_GAP, frame.width - LABEL_GAP - pen.measureText(text).width);
    [pen.lineWidth, pen.strokeStyle, pen.textAlign] = [LABEL_HALO, theme.paper, "left"];
    pen.strokeText(text, start, y[point]);
    write(pen, text, start, y[point], theme.ink, LABEL_FONT);
  });
  pen.textBaseline = "alphabetic";
}

function shapeOf({ strokes, faces, rounds }, number) {
  const [group, i] = number < faces.n ? [faces, number] : number < faces.n + strokes.n ? [strokes, number - faces.n]
    : [rounds, number - faces.n - strokes.n];
  return { group, i, position: group.positions[i] };
}

function paintShapes(sheet, order, marked) {
  const { pen, shapes, frame, seen, theme } = sheet, { strokes, faces, rounds, palette } = shapes, { x, y, nearness, widths } = seen;
  const shade = shades(palette, theme), many = faces.n + strokes.n + rounds.n;
  let /** @type {any[]} */ runs = [], /** @type {any} */ run; // strokes that nothing lies between; those of a run look alike

  function addStroke(i, colour, width, isMarked) {
    if (!run || run.colour !== colour || run.width !== width || run.isMarked !== isMarked)
      runs.push((run = { colour, width, isMarked, path: new Path2D() }));
    run.path.moveTo(x[strokes.from[i]], y[strokes.from[i]]);
    run.path.lineTo(x[strokes.to[i]], y[strokes.to[i]]);
  }

  function paintRuns() {
    pen.globalAlpha = 0.45;
    for (const { width, path, isMarked } of runs) if (isMarked) line(pen, path, theme.markEdge, Math.max(5, 9 * frame.thin, width + 4));
    pen.globalAlpha = 1;
    for (const { colour, width, path } of runs) line(pen, path, colour, width);
    [runs, run] = [[], undefined];
  }

  function paintStroke(i) {
    const a = strokes.from[i], b = strokes.to[i], colour = strokes.colours[i], near = nearness ? (nearness[a] + nearness[b]) / 2 : 1;
    addStroke(i, shade(colour, near), widths[i] / 10, marked.has(strokes.states[i]));
    if (!frame.detailed || widths[i] < TONED) return;
    paintRuns();
    const { body, light, dark } = cylinder([x[a], y[a]], [x[b], y[b]], seen.ends.map((breadths) => breadths[i] / 20));
    for (const [part, bright] of /** @type {[any, number][]} */ ([[body, OWN], [light, BRIGHT], [dark, DIM]])) fill(pen, part, shade(colour, near, bright));
  }

  function paintArea(path, group, i, inside, edge, width) {
    const isMarked = marked.has(group.states[i]);
    if (inside) fill(pen, path, inside);
    if (isMarked || edge) line(pen, path, isMarked ? theme.markEdge : edge, isMarked ? MARKED_EDGE : width);
  }

  function paintFace(i) {
    const corners = cornersOf(faces, i), colour = faces.colours[i], path = faceOutline(seen, corners);
    if (!nearness) return paintArea(path, faces, i, mixed(shade(colour), theme.paper, FILLED), shade(colour), FACE_EDGE);
    const near = meanOf(nearness, corners), bright = brightness(normalOf(corners, shapes, frame));
    const edge = faces.smooth?.[i] ? bright : Math.max(0, bright + EDGE); // a curved surface has no edges between its faces
    return paintArea(path, faces, i, shade(colour, near, bright), shade(colour, near, edge), FACE_EDGE);
  }

  function paintRound(i) {
    const centre = rounds.centres[i], colour = rounds.colours[i], path = roundOutline(sheet, i), kind = rounds.kinds[i];
    if (!nearness) return paintArea(path, rounds, i, kind === HOLLOW ? theme.paper : mixed(shade(colour), theme.paper, FILLED), shade(colour), RING);
    const near = nearness[centre], tone = (bright) => shade(colour, near, bright);
    const inside = kind === BALL ? sphereFill(pen, x[centre], y[centre], radiusOf(sheet, i), tone) : kind === HOLLOW ? null : tone(OWN);
    return paintArea(path, rounds, i, inside, kind === BALL ? null : tone(OWN + EDGE), RING);
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

const faceOutline = ({ x, y }, corners) => outline(corners, (corner) => [x[corner], y[corner]]);

function roundOutline(sheet, i) {
  const path = new Path2D(), { shapes: { rounds }, seen: { x, y } } = sheet, centre = rounds.centres[i];
  path.arc(x[centre], y[centre], radiusOf(sheet, i), 0, 2 * Math.PI);
  return path;
}

function radiusOf({ shapes: { rounds }, frame, seen: { factors } }, i) {
  return Math.max(SMALLEST_RADIUS, rounds.radii[i] * frame.scale * (factors ? factors[rounds.centres[i]] : 1));
}

// Bands around some shapes, the broadest first.
function surroundTraced(sheet, bands, numbers) {
  const { pen, theme } = sheet, paths = Array.from(numbers, (number) => outlineOf(sheet, number));
  for (const [more, colour, dashes = []] of bands) {
    pen.lineCap = dashes.length ? "butt" : "round";
    for (const { path, width } of paths) line(pen, path, theme[colour], width + more, dashes);
  }
  pen.lineCap = "round";
}

function outlineOf(sheet, number) {
  const { shapes, seen } = sheet, { group, i } = shapeOf(shapes, number);
  if (group === shapes.faces) return { path: faceOutline(seen, cornersOf(group, i)), width: FACE_EDGE };
  if (group === shapes.rounds) return { path: roundOutline(sheet, i), width: RING };
  return { path: outline([group.from[i], group.to[i]], (point) => [seen.x[point], seen.y[point]], false), width: seen.widths[i] / 10 };
}

// The position in the word of what lies at a point: of the shape painted last there, else of the nearest within reach; or -1.
export function shapeAt(shapes, frame, x, y, reach) {
  const seen = seenIn(frame, shapes), sheet = { shapes, frame, seen };
  let found = -1, nearest = reach;
  for (let at = seen.order.length - 1; at >= 0 && nearest > 0; at--) {
    const distance = distanceTo(sheet, seen.order[at], x, y);
    if (distance > nearest || (distance === nearest && found >= 0)) continue;
    [found, nearest] = [shapeOf(shapes, seen.order[at]).position, distance];
  }
  return found;
}

// How far a point is from a shape, in pixels; 0 inside.
function distanceTo(sheet, number, x, y) {
  const { shapes, seen } = sheet, { group, i } = shapeOf(shapes, number);
  const placeOf = /** @returns {[number, number]} */ (point) => [seen.x[point], seen.y[point]];
  if (group === shapes.rounds) {
    const [cx, cy] = placeOf(group.centres[i]);
    return Math.max(0, Math.hypot(cx - x, cy - y) - radiusOf(sheet, i));
  }
  if (group === shapes.strokes) return Math.max(0, distanceToLine(placeOf(group.from[i]), placeOf(group.to[i]), x, y) - seen.widths[i] / 20);
  const corners = Array.from(cornersOf(group, i), placeOf);
  return isInside(corners, x, y) ? 0 : Math.min(...corners.map((corner, k) => distanceToLine(corner, corners[(k + 1) % corners.length], x, y)));
}

function distanceToLine([fromX, fromY], [toX, toY], x, y) {
  const ax = x - fromX, ay = y - fromY, bx = toX - fromX, by = toY - fromY;
  const part = clamped(0, 1, (ax * bx + ay * by) / (bx * bx + by * by || 1));
  return Math.hypot(ax - part * bx, ay - part * by);
}
