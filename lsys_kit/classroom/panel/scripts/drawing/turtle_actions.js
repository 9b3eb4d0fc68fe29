// What a turtle carries, and the actions that are the same in the plane and in space, by name: those of the kit's own turtles
// (geometry/turtle/handlers.py), whose names a book sends.
//
// A position is the number of a point, of which 0 is the origin; what an orientation is, the turtle's trail knows, which
// records where points lie before the angle is known. Neither is ever changed, so that a branch can remember both. A call of
// an action has a factor and an addend, and mostly concerns one quantity: the amount is factor * quantity + addend.

import { clamped, grouped, halfToEven } from "../books/numbers.js";
import { BALL, BLOSSOM, DISC, HOLLOW, LARGEST_VALUE, LAST_COLOUR, OWN_LOOK, RAMP_END, RAMP_START, SHAPE_WIDTH } from "./constants.js";

export const MOST_POINTS = 2_000_000;
const REMEMBERED = ["position", "orientation", "length", "width", "colour", "gravitropism", "tropisms", "last", "restored",
  "mirror", "secondHeading", "axis", "scale"];

// The colours of the ramp, stretched so that the farthest of faces, else of all that is drawn, is its end; beyond is a blossom.
export function stretchRamp(strokes, faces, rounds) {
  const [leaf, ...others] = [faces, strokes, rounds].map(({ colours }) => colours.reduce((one, other) => Math.max(one, other), RAMP_START));
  const last = Math.min(RAMP_END, leaf > RAMP_START ? leaf : Math.max(RAMP_START + 1, ...others));
  for (const { colours } of [strokes, faces, rounds])
    colours.forEach((colour, i) => {
      if (colour >= RAMP_START && colour <= RAMP_END) colours[i] = colour > last ? BLOSSOM : onRamp((colour - RAMP_START) / (last - RAMP_START));
    });
}

const onRamp = (share) => RAMP_START + Math.floor((RAMP_END - RAMP_START) * share + 0.5);

// How many axes end in each stroke and in what it bears. Those of no length bear nothing, and nothing bears them.
export function tipsBorne({ from, to, orders, long }) {
  const ending = new Map(), tips = to.map(() => 1);
  const below = from.map((point, i) => [long[i] ? ending.get(point) : -1, ending.set(to[i], i)][0]);
  below.forEach((mother, i) => { if (orders[mother] === orders[i]) tips[mother] = 0; }); // the axis goes on
  for (let i = tips.length - 1; i >= 0; i--) if (below[i] >= 0) tips[below[i]] += tips[i];
  return tips;
}

// Natural colours of the strokes for which none has been chosen: from bark to leaves, by their width, else by their branch order.
export function colourNaturally({ colours, orders, widths }, tips) {
  const [deepest, widest] = [orders, tips ?? widths].map((numbers) => numbers.reduce((one, other) => Math.max(one, other), 0));
  for (let i = 0; i < orders.length; i++) {
    if (colours[i] !== OWN_LOOK) continue;
    const youth = tips ? 1 - Math.log(tips[i]) / (Math.log(widest) || 1)
      : widest && widths[i] !== OWN_LOOK ? 1 - Math.sqrt(widths[i] / widest) : deepest ? orders[i] / deepest : 1;
    colours[i] = onRamp(youth);
  }
}

export function newTurtle(trail, { length, width, colour }) {
  const initial = { length, width, colour, gravitropism: 0 }, looks = () => ({ colours: [], positions: [], states: [] });
  return {
    ...initial, initial, trail, scale: 1, position: 0, orientation: trail.orientation, mirror: 1, secondHeading: 0,
    tropisms: new Map(), axis: null, patches: new Map(), last: 0, restored: [], stack: [], place: -1, state: -1, expectsSurface: false, flat: false,
    openPolygons: [],
    strokes: { from: [], to: [], lengths: [], long: [], orders: [], widths: [], ...looks() },
    faces: { starts: [0], corners: [], smooth: [], ...looks() },
    rounds: { centres: [], radii: [], kinds: [], ...looks() },
    labels: { points: [], texts: [] },
  };
}

export const strokeWidth = ({ width, scale }) => (width > 0 ? width * scale : width);

// The width of shapes without an argument: that of strokes.
const shapeWidth = ({ width }) => (width === OWN_LOOK ? SHAPE_WIDTH : width);

export const amountOf = (call, quantity) => call.factor * quantity + call.addend;

// A length that is drawn: the step, or an argument, at the scale of the turtle.
const sizeOf = (turtle, call) => turtle.scale * amountOf(call, turtle.length);

export function roomFor(many) {
  if (many > MOST_POINTS) throw new RangeError(`Too much to draw: more than ${grouped(MOST_POINTS)} points`);
  return many;
}

// What a shape looks like and belongs to, as the turtle has it or, of a polygon, had it at its beginning.
function recordLook({ colours, positions, states }, { colour, place, state }) {
  colours.push(colour);
  positions.push(place);
  states.push(state);
}

// A stroke between two points; how long it is, its points may say only later.
export function recordStroke(turtle, from, to, width, long = true) {
  const { strokes } = turtle;
  turtle.last = to;
  strokes.from.push(from);
  strokes.to.push(to);
  strokes.long.push(long);
  strokes.orders.push(turtle.stack.length);
  strokes.widths.push(width);
  recordLook(strokes, turtle);
}

export function recordFace(faces, corners, look, smooth = false) {
  for (const corner of corners) faces.corners.push(corner);
  faces.starts.push(roomFor(faces.corners.length));
  faces.smooth.push(smooth);
  recordLook(faces, look);
}

function recordVertex({ openPolygons, position }) {
  if (openPolygons.length) roomFor(openPolygons.at(-1).corners.push(position));
}

// One-time settings end with a stroke; the earliest value is set last, and stays.
export function goAhead(drawn, vertex) {
  return (turtle, call) => {
    const from = turtle.position, length = sizeOf(turtle, call);
    const to = drawn || length ? turtle.trail.step(turtle.orientation, length, from) : from;
    if (length) turtle.position = to; // what starts at the end of a stroke of no length starts at that of the one below it
    if (drawn && !turtle.axis) {
      recordStroke(turtle, from, to, strokeWidth(turtle), length !== 0);
      turtle.strokes.lengths.push(Math.abs(length));
    }
    if (drawn && turtle.tropisms.size) turtle.orientation = turtle.trail.bent(turtle.orientation, turtle.tropisms);
    if (vertex) recordVertex(turtle);
    if (!drawn || !turtle.restored.length) return;
    for (const [name, value] of turtle.restored) turtle[name] = value;
    turtle.restored = [];
  };
}

// Set a quantity, which the message of a too large value calls so.
function setQuantity(name, called, least = -Infinity) {
  return (turtle, call) => {
    const value = amountOf(call, turtle[name]);
    if (!(Math.abs(value) <= LARGEST_VALUE))
      throw new RangeError(`The turtle's ${called} grows too large to draw: ${Number(value.toPrecision(3))}`);
    turtle[name] = Math.max(least, value);
  };
}

function setColour(turtle, call) {
  turtle.colour = clamped(0, LAST_COLOUR, halfToEven(amountOf(call, Math.max(0, turtle.colour))));
}

// Through the ramp from bark to leaves, or through the colours below it, as far as they go.
function stepColour(turtle, call) {
  const [first, last] = turtle.colour >= RAMP_START ? [RAMP_START, RAMP_END] : [0, RAMP_START - 1];
  turtle.colour = clamped(first, last, turtle.colour + call.addend);
}

// Set a quantity, set it back to what it was at first, and set it up to the next stroke.
function settings(name, set) {
  return {
    [`set ${name}`]: set,
    [`reset ${name}`]: (turtle) => { turtle[name] = turtle.initial[name]; },
    [`set ${name} once`]: (turtle, call) => {
      turtle.restored = [[name, turtle[name]], ...turtle.restored];
      set(turtle, call);
    },
  };
}

function openBranch(turtle) {
  roomFor(turtle.stack.push(REMEMBERED.map((name) => turtle[name])));
  turtle.axis = null;
}

function closeBranch(turtle) {
  const remembered = turtle.stack.pop();
  if (remembered) REMEMBERED.forEach((name, i) => (turtle[name] = remembered[i]));
}

function beginPolygon({ openPolygons, colour, place, state }) {
  roomFor(openPolygons.push({ corners: [], colour, place, state }));
}

function endPolygon({ openPolygons, faces }) {
  const outline = openPolygons.pop();
  if (outline?.corners.length > 2) recordFace(faces, outline.corners, outline);
}

function drawSurface(turtle, call) {
  const size = sizeOf(turtle, call);
  if (!size || !call.surface) return;
  const curved = !turtle.flat && call.surface.faces.length > 0;
  drawLocalFaces(turtle, curved ? call.surface.faces : call.surface.outlines, size, curved);
}

function drawLocalFaces(turtle, faces, size, smooth) {
  const { trail, orientation, position } = turtle;
  for (const face of faces)
    recordFace(turtle.faces, face.map(([ahead, left, up]) => trail.local(orientation, position, size * ahead, size * left, size * up)), turtle, smooth);
}

// A box ahead, given how its sides follow from its length and half its width.
export function drawBox(sides) {
  return (turtle, call) => {
    const length = sizeOf(turtle, call), width = turtle.scale * Math.abs(call.values[1] ?? shapeWidth(turtle));
    if (length && width) drawLocalFaces(turtle, sides(length, width / 2), 1, false);
  };
}

function drawExpectedSurface(turtle, call) {
  if (turtle.expectsSurface) drawSurface(turtle, call);
  turtle.expectsSurface = false;
}

function drawRound(kind) {
  return (turtle, call) => {
    const width = amountOf(call, shapeWidth(turtle)), { rounds } = turtle;
    roomFor(rounds.centres.push(turtle.position));
    rounds.radii.push((turtle.scale * Math.abs(width)) / 2);
    rounds.kinds.push(kind);
    recordLook(rounds, turtle);
  };
}

function drawLabel({ position, labels }, { values: [text] }) {
  if (!text) return;
  roomFor(labels.points.push(position));
  labels.texts.push(text);
}

export function commonActions() {
  return {
    "draw": goAhead(true, true), "move": goAhead(false, true),
    "draw without vertex": goAhead(true, false), "move without vertex": goAhead(false, false),
    ...settings("length", setQuantity("length", "step")), ...settings("width", setQuantity("width", "width", 0)),
    ...settings("gravitropism", setQuantity("gravitropism", "strength")), ...settings("colour", setColour),
    "set scale": setQuantity("scale", "scale", 0), "step colour": stepColour,
    "push": openBranch, "pop": closeBranch,
    "begin polygon": beginPolygon, "record vertex": recordVertex, "end polygon": endPolygon,
    "expect surface": (turtle) => { turtle.expectsSurface = true; },
    "draw expected surface": drawExpectedSurface, "draw surface": drawSurface,
    "draw circle": drawRound(HOLLOW), "draw disc": drawRound(DISC), "draw sphere": drawRound(BALL), "draw label": drawLabel,
  };
}
