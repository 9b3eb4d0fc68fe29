// The walk of the turtle along a word: where it is after each module, and which turtles wait at forks; and how both are painted
// over the drawing, what it has not drawn yet being pale.

import { paint } from "./painter.js";
import { seenIn } from "./projection.js";
import { fill, line, outline, write } from "./outlines.js";
import { interpreted, placed, traced } from "./turtle.js";

const SIZE = 16, ARC = 34, AXIS = 38; // pixels: from its middle to its nose, the radius of an arc, the length of an axis
const BODY = [[1, 0], [-0.7, 0.65], [-0.35, 0], [-0.7, -0.65]]; // the turtle seen from above: ahead, and to the left
const VEIL = 0.75, DARK_VEIL = 0.6; // of the paper over what is not drawn yet
const DEGREE = Math.PI / 180, ARC_PARTS = 24;
const TURNS = ["turn", "turn back", "turn by mirrored angle", "pitch", "roll"];
const NOTHING = { strokes: { n: 0, from: [], to: [], orders: [], widths: new Float64Array() }, faces: { n: 0, starts: [0], corners: [] }, rounds: { n: 0, centres: [], radii: [] } };
const walks = new WeakMap(), pale = new WeakMap();

// The walk along a step's word; that of one step of a book is kept. After so many modules it has the turtle's point and
// orientation, how much is drawn, and the turtle that has begun to wait last: { place, point, orientation, number, below }.
export function walkOf(book, step) {
  if (walks.get(book)?.step === step) return walks.get(book);
  const stops = [];
  let waiting = null, deepest = 0;
  interpreted(book, book.word(step), undefined, ({ position, orientation, strokes, faces, rounds, labels, stack }) => {
    while (waiting && stack[waiting.number - 1] !== waiting.kept) waiting = waiting.below;
    for (let number = (waiting?.number ?? 0) + 1; number <= stack.length; number++)
      waiting = { place: stops.length, point: position, orientation: stack[number - 1][1], number, kept: stack[number - 1], below: waiting };
    deepest = Math.max(deepest, stack.length);
    stops.push({ point: position, orientation, waiting, drawn: [strokes.colours.length, faces.colours.length, rounds.colours.length, labels.texts.length] });
  });
  const found = { step, stops, deepest, last: stops.length - 1 };
  walks.set(book, found);
  return found;
}

export function waitingAt({ stops }, at) {
  const found = [];
  for (let each = stops[at].waiting; each; each = each.below) found.push(each);
  return found;
}

// How the turtle stands at a stop: its place, and its head, its left and its up as vectors.
export function stanceOf(book, step, angle, { point, orientation }) {
  const path = traced(book, step), { x, y, z, dimension } = placed(path, angle);
  if (dimension === 2) {
    const [turns, degrees, side] = orientation, way = directionOf(book, angle, orientation) * DEGREE;
    return { place: [x[point], y[point], 0], degrees: turns * angle + degrees, head: [Math.cos(way), Math.sin(way), 0], left: [-side * Math.sin(way), side * Math.cos(way), 0], up: [0, 0, side] };
  }
  const at = 9 * orientation, [head, left, up] = [0, 3, 6].map((from) => [...path.trail.axes.subarray(at + from, at + from + 3)]);
  return { place: [x[point], y[point], z[point]], head, left, up };
}

export const directionOf = (book, angle, [turns, degrees]) => turns * angle + degrees + book.data.turtle.heading;

// The only turn of the last module that was obeyed: its kind and its degrees; null where there is none, or there are several.
export function turnBefore(book, walk, at, angle) {
  const calls = at ? book.data.turtle.calls[book.word(walk.step)[at - 1]] : [], turns = calls.filter(([name]) => TURNS.includes(name));
  if (turns.length !== 1 || calls.some(([name]) => name === "pop")) return null;
  const [[name, factor, addend]] = turns, kind = name === "pitch" || name === "roll" ? name : "turn";
  if (book.data.mode === "space") return { kind, degrees: factor * angle + addend };
  const [before, after] = [walk.stops[at - 1], walk.stops[at]].map(({ orientation }) => directionOf(book, angle, orientation));
  return kind === "turn" ? { kind, degrees: after - before } : null;
}

// Where the arrow that turns points when a part of a turn is done.
function turningTo({ head, left, up }, { kind, degrees }, part, side) {
  const [from, to] = { turn: [head, left.map((each) => side * each)], pitch: [head, up.map((each) => -each)], roll: [up, left] }[kind];
  const way = part * degrees * DEGREE;
  return from.map((each, i) => Math.cos(way) * each + Math.sin(way) * to[i]);
}

// Paint the shapes of a step, and the turtle after so many modules; `share` is how much of the last one it has done.
export function paintWalk(pen, shapes, frame, look, { book, step, angle, at, share }) {
  const walk = walkOf(book, step), { theme } = look, inSpace = shapes.dimension === 3;
  const stance = (stop) => stanceOf(book, step, angle, stop), now = stance(walk.stops[at]), before = stance(walk.stops[Math.max(0, at - 1)]);
  const turn = turnBefore(book, walk, at, angle), side = inSpace ? 1 : before.up[2];
  const here = between(before, now, share, turn, side);
  paintPale(pen, shapes, frame, look);
  paint(pen, drawnBy(shapes, walk.stops[share < 1 ? at - 1 : at].drawn), { ...frame, seen: null }, look);
  const seen = (points) => seenPoints(frame, points), unit = SIZE / frame.scale, path = (points, closed = true) => outline(seen(points), (point) => point, closed);
  if (share < 1 && walk.stops[at].drawn[0] > walk.stops[at - 1].drawn[0]) line(pen, path([before.place, here.place], false), theme.lit, 3);
  for (const each of waitingAt(walk, at).reverse()) {
    const waits = stance(each), body = path(bodyOf(waits, unit));
    fill(pen, body, theme.paper);
    line(pen, body, theme.quiet, 1.5, [3, 2]);
    const [[x, y]] = seen([moved(moved(waits.place, waits.head, -0.9 * unit), waits.left, 1.1 * unit)]);
    named(pen, String(each.number), x, y, theme.quiet, theme);
  }
  if (turn?.degrees) paintTurn(pen, turn, before, share, { seen, path, far: ARC / frame.scale, theme, side });
  if (inSpace) for (const [name, way] of [["H", here.head], ["L", here.left], ["U", here.up]]) {
    line(pen, path([here.place, moved(here.place, way, AXIS / frame.scale)], false), theme.ink, 1.5);
    const [[x, y]] = seen([moved(here.place, way, (AXIS + 9) / frame.scale)]);
    named(pen, name, x, y, theme.ink, theme);
  }
  const body = path(bodyOf(here, unit));
  line(pen, body, theme.paper, 5);
  fill(pen, body, theme.lit);
  line(pen, body, theme.ink, 1);
}

// All shapes under a veil: painted once, and kept as a picture while they are seen as they are.
function paintPale(pen, shapes, frame, look) {
  const { canvas } = pen, { seen, ...place } = frame, key = JSON.stringify([place, look.theme, [...look.marked], canvas.width, canvas.height]);
  let known = pale.get(canvas);
  pen.save();
  if (known?.shapes === shapes && known.key === key) {
    pen.resetTransform();
    pen.drawImage(known.picture, 0, 0);
  } else {
    paint(pen, shapes, frame, { ...look, lit: new Map() });
    pen.globalAlpha = look.theme.dark ? DARK_VEIL : VEIL;
    pen.fillStyle = look.theme.paper;
    pen.fillRect(0, 0, frame.width, canvas.height);
    const picture = known?.picture ?? document.createElement("canvas");
    [picture.width, picture.height] = [canvas.width, canvas.height];
    picture.getContext("2d").drawImage(canvas, 0, 0);
    pale.set(canvas, (known = { shapes, key, picture }));
  }
  pen.restore();
  pen.lineCap = pen.lineJoin = "round";
}

// What turns swings from where it pointed, along an arc with its angle.
function paintTurn(pen, turn, before, share, { seen, path, far, theme, side }) {
  const to = (part) => moved(before.place, turningTo(before, turn, part, side), far);
  const arc = Array.from({ length: ARC_PARTS + 1 }, (_, i) => to((share * i) / ARC_PARTS));
  line(pen, path([before.place, to(0)], false), theme.quiet, 1.2, [4, 3]);
  line(pen, path([before.place, to(share)], false), theme.lit, 1.2);
  line(pen, path(arc, false), theme.lit, 2);
  const [[x, y]] = seen([moved(before.place, turningTo(before, turn, 0.5, side), 1.75 * far)]);
  named(pen, `${degreesOf(turn)}°`, x, y, theme.lit, theme, "bold 13px sans-serif");
}

export const degreesOf = ({ degrees }) => Number(Math.abs(degrees).toFixed(2));

function named(pen, text, x, y, colour, theme, font = "12px sans-serif") {
  [pen.font, pen.textAlign, pen.textBaseline, pen.lineWidth, pen.strokeStyle] = [font, "center", "middle", 3, theme.paper];
  pen.strokeText(text, x, y);
  write(pen, text, x, y, colour, font, "center");
  pen.textBaseline = "alphabetic";
}

const moved = (place, way, far) => place.map((each, i) => each + far * way[i]);

const bodyOf = ({ place, head, left }, unit) => BODY.map(([ahead, aside]) => moved(moved(place, head, ahead * unit), left, aside * unit));

// The turtle on its way: along a line, and in a turn about its axis.
function between(before, now, share, turn, side) {
  if (share >= 1) return now;
  const place = before.place.map((each, i) => each + share * (now.place[i] - each));
  if (!turn) return { ...(share < 0.5 ? before : now), place };
  const to = turningTo(before, turn, share, side), { left, up } = before;
  if (turn.kind === "pitch") return { place, head: to, left, up: crossed(to, left) };
  if (turn.kind === "roll") return { place, head: before.head, up: to, left: crossed(to, before.head) };
  return { place, head: to, left: crossed(up, to), up };
}

const crossed = ([ax, ay, az], [bx, by, bz]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];

function drawnBy(shapes, [strokes, faces, rounds, labels]) {
  const cut = (group, n) => ({ n, ...Object.fromEntries(Object.entries(group).flatMap(([name, column]) => {
    if (!column?.length || name === "corners") return name === "n" ? [] : [[name, column]];
    return [[name, column.slice(0, name === "starts" ? n + 1 : n)]];
  })) });
  const corners = shapes.faces.corners.slice(0, shapes.faces.starts[faces] ?? 0);
  return { ...shapes, strokes: cut(shapes.strokes, strokes), faces: { ...cut(shapes.faces, faces), corners }, rounds: cut(shapes.rounds, rounds), labels: { points: shapes.labels.points.slice(0, labels), texts: shapes.labels.texts.slice(0, labels) } };
}

function seenPoints(frame, points) {
  const [x, y, z] = [0, 1, 2].map((axis) => Float64Array.from(points, (point) => point[axis]));
  const seen = seenIn({ ...frame, seen: null }, { ...NOTHING, faces: { ...NOTHING.faces }, n: points.length, pixel: frame.pixel, x, y, z });
  return points.map((_, i) => [seen.x[i], seen.y[i]]);
}
