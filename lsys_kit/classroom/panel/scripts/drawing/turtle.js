// The turtle: what the words of a book look like, in the plane or in space.
//
// `traced` interprets a word once and records a path that depends neither on the angle nor on the heading; `placed` then finds
// where its points lie, as often as the angle changes.

import { clamped, grouped, times } from "../books/numbers.js";
import { BROAD, BROADEST_PART, EXPONENT, FINE, LARGEST_SCALE, MOST_CURVED, OWN_LOOK, PICTURE_HEIGHT, PICTURE_MARGIN, PICTURE_WIDTH, RAMP_START, SIGN_COLOUR, SLENDER, STOUT, TALLEST, TRUNK } from "./constants.js";
import { spansOf } from "./projection.js";
import { colourNaturally, newTurtle, stretchRamp, tipsBorne } from "./turtle_actions.js";
import { placeInPlane, planeActions, planeTrail } from "./turtle_plane.js";
import { placeInSpace, spaceActions, spaceTrail } from "./turtle_space.js";

const MOST_CALLS = 10_000_000;
const DRAWS_SURFACE = ["expect surface", "draw surface"];
const POINTS_KEPT = 300_000; // of the paths of earlier steps, of which two are kept in any case

const openedTurtles = new WeakMap();

// The path of a step's word; those asked for last are kept.
export function traced(book, step) {
  const opened = openedTurtle(book), { paths } = opened, path = paths.get(step) ?? tracedAnew(book, step, opened);
  paths.delete(step);
  paths.set(step, path);
  let points = 0;
  for (const [other, { trail }] of [...paths].reverse().slice(2))
    if ((points += trail.n) > POINTS_KEPT) paths.delete(other);
  return path;
}

// What all words of a book have in common: for each state the calls, the amounts of rotations, and the colours.
function openedTurtle(book) {
  if (!openedTurtles.has(book)) openedTurtles.set(book, openTurtle(book.data));
  return openedTurtles.get(book);
}

function openTurtle({ mode, turtle, states, symbols }) {
  const inSpace = mode === "space", actions = inSpace ? spaceActions() : planeActions(), amounts = [], known = new Map();
  const amountNumber = (factor, addend) => {
    const key = `${factor} ${addend}`;
    if (!known.has(key)) known.set(key, amounts.push([factor, addend]) - 1);
    return known.get(key);
  };
  const compiled = (found) => found.map(([name, factor, given, values, surface]) => {
    if (!Object.hasOwn(actions, name)) throw new RangeError(`The turtle of the panel does not know how to "${name}"`);
    const addend = Number(given);
    return { act: actions[name], factor, addend, values: values || [], surface: surface ? turtle.surfaces[surface] : null,
      amount: amountNumber(factor, addend) };
  });
  const calls = turtle.calls.map((found) => Object.assign(compiled(found), {
    surfaces: found.filter(([name]) => DRAWS_SURFACE.includes(name)).length }));
  const ofStates = states.map(([symbol]) => symbols[symbol][2] || SIGN_COLOUR);
  const palette = [...new Set([...ofStates, SIGN_COLOUR, ...turtle.colours])];
  return { inSpace, calls, amounts, palette, paths: new Map(), chosen: turtle.colours.map((name) => palette.indexOf(name)),
    ofStates: ofStates.map((name) => palette.indexOf(name)) };
}

function tracedAnew(book, step, opened) {
  const { inSpace, amounts, palette, chosen, ofStates } = opened, setting = book.data.turtle;
  const turtle = interpreted(book, book.word(step), opened), { strokes, trail } = turtle;
  const tips = setting.widths === "pipes" ? tipsBorne(strokes) : null;
  if (tips) strokes.widths = tips.map((many) => many ** (1 / EXPONENT));
  if (setting.colour === RAMP_START) stretchRamp(strokes, turtle.faces, turtle.rounds);
  else if (setting.natural) colourNaturally(strokes, tips);
  const colourOf = (state, colour) => (colour === OWN_LOOK ? ofStates[state] : chosen[colour % chosen.length]);
  return {
    dimension: inSpace ? 3 : 2, trail: trail.packed(), amounts, palette, heading: setting.heading, unit: setting.widths,
    typical: medianLength(strokes.lengths), broadest: greatest(strokes.widths, OWN_LOOK), placed: null,
    ...shapesOf(turtle, colourOf),
  };
}

// The turtle of a book at the end of a word; `seen` is called with it at the beginning, and after each module.
export function interpreted(book, word, { inSpace, calls } = openedTurtle(book), seen = null) {
  const setting = book.data.turtle, turtle = newTurtle((inSpace ? spaceTrail : planeTrail)(setting), setting);
  let many = 0, curved = 0;
  for (const state of word) [many, curved] = [many + calls[state].length, curved + calls[state].surfaces];
  if (many > MOST_CALLS) throw new RangeError(`Too much to draw: more than ${grouped(MOST_CALLS)} commands`);
  turtle.flat = curved > MOST_CURVED;
  seen?.(turtle);
  for (let place = 0; place < word.length; place++) {
    const state = word[place];
    turtle.place = place;
    turtle.state = state;
    for (const call of calls[state]) call.act(turtle, call);
    seen?.(turtle);
  }
  return turtle;
}

const REAL = ["widths", "radii"]; // all other numbers of shapes are whole

function shapesOf({ strokes, faces, rounds, labels }, colourOf) {
  const group = ({ smooth, ...rows }) => {
    const colours = rows.colours.map((colour, i) => colourOf(rows.states[i], colour));
    const columns = Object.entries({ ...rows, colours }).map(([name, numbers]) => [name, (REAL.includes(name) ? Float64Array : Int32Array).from(numbers)]);
    return { n: colours.length, ...Object.fromEntries(columns), smooth };
  };
  const { lengths, long, ...drawn } = strokes;
  return { strokes: group(drawn), faces: group(faces), rounds: group(rounds), labels: { points: Int32Array.from(labels.points), texts: labels.texts } };
}

// The shapes of a path for an angle, in degrees. Their points stay where they are until the path is placed for another.
export function placed(path, angle) {
  if (path.placed?.angle !== angle) path.placed = { angle, shapes: placedAnew(path, angle) };
  return path.placed.shapes;
}

function placedAnew(path, angle) {
  const { dimension, trail, amounts, palette, heading, typical, faces, rounds, labels } = path, { n, x, y, z } = trail;
  if (dimension === 2) placeInPlane(trail, angle, heading);
  else placeInSpace(trail, amounts, angle, heading);
  const unit = unitOf(path);
  return { dimension, n, x, y, z, strokes: { ...path.strokes, widths: path.strokes.widths.map((width) => (width < 0 ? width : width * unit)) },
    faces, rounds, labels, palette, typical, pixel: path.unit === "pixels" ? unit : 1 };
}

// The unit of widths of strokes: of pixels one of a picture of the usual size, and at most 1. Widths by the pipe model are in
// proportion to the drawing, and others may be no broader than fits it or its strokes.
function unitOf(path) {
  const { broadest, unit, strokes: { n, from, to }, trail: { x, y, z } } = path, spans = spansOf(path, z ? [x, y, z] : [x, y]);
  const [extent, lesser] = [...spans].sort((a, b) => b - a);
  if (unit === "pipes") return (TRUNK * clamped(extent / SLENDER, extent, SLENDER * lesser)) / broadest;
  if (broadest <= 0 || unit === "units") return 1;
  if (unit === "auto") {
    const lengths = times(n, (i) => Math.hypot(x[to[i]] - x[from[i]], y[to[i]] - y[from[i]], z ? z[to[i]] - z[from[i]] : 0));
    return clamped(FINE * extent, Math.max(BROAD * extent, STOUT * greatest(lengths, 0)), broadest) / broadest;
  }
  const room = Math.min(broadest, BROADEST_PART * PICTURE_HEIGHT) + 2 * PICTURE_MARGIN;
  const [wide, high, highest] = [PICTURE_WIDTH, PICTURE_HEIGHT, TALLEST].map((size) => size - room), [across] = spans, up = spans.at(-1);
  return 1 / clamped(1, LARGEST_SCALE, Math.min(wide / across, highest / up, Math.sqrt((wide * high) / (across * up))));
}

const greatest = (numbers, least) => numbers.reduce((most, number) => Math.max(most, number), least);

function medianLength(numbers) {
  const sorted = Float64Array.from(numbers).sort(), many = sorted.length;
  return many ? (sorted[many >> 1] + sorted[(many - 1) >> 1]) / 2 : 1;
}
