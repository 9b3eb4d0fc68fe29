// The turtle: what the words of a book look like, in the plane or in space.
//
// `traced` interprets a word once and records a path that depends neither on the angle nor on the heading; `placed` then finds
// where its points lie, as often as the angle changes.

import { grouped } from "../books/numbers.js";
import { BROADEST_PART, LARGEST_SCALE, MOST_CURVED, OWN_LOOK, PICTURE_HEIGHT, PICTURE_MARGIN, PICTURE_WIDTH, RAMP_START, SIGN_COLOUR } from "./constants.js";
import { colourNaturally, newTurtle, stretchRamp } from "./turtle_actions.js";
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
  const { inSpace, amounts, palette, chosen, ofStates } = opened, setting = book.data.turtle, turtle = interpreted(book, book.word(step), opened);
  if (setting.colour === RAMP_START) stretchRamp(turtle.strokes, turtle.faces, turtle.rounds);
  else if (setting.natural) colourNaturally(turtle.strokes);
  const colourOf = (state, colour) => (colour === OWN_LOOK ? ofStates[state] : chosen[colour % chosen.length]);
  return {
    dimension: inSpace ? 3 : 2, trail: turtle.trail.packed(), amounts, palette, heading: setting.heading, pixels: setting.pixels,
    typical: medianLength(turtle.strokes.lengths), broadest: broadestOf(turtle.strokes.widths, OWN_LOOK), placed: null,
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
  const { lengths, ...drawn } = strokes;
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
  const pixel = pixelOf(path, extentOf(path, trail));
  return { dimension, n, x, y, z, strokes: { ...path.strokes, widths: widthsInUnits(path.strokes.widths, pixel) },
    faces, rounds, labels, palette, typical, pixel };
}

// The least and the greatest of each coordinate of all that is drawn; zeros where that is nothing.
function extentOf({ strokes, faces, rounds, labels }, { x, y, z }) {
  const found = (z ? [x, y, z] : [x, y]).map((places) => {
    let least = Infinity, most = -Infinity;
    for (const numbers of [strokes.from, strokes.to, faces.corners, labels.points]) {
      for (let i = 0; i < numbers.length; i++) {
        const place = places[numbers[i]];
        if (place < least) least = place;
        if (place > most) most = place;
      }
    }
    for (let i = 0; i < rounds.n; i++) {
      least = Math.min(least, places[rounds.centres[i]] - rounds.radii[i]);
      most = Math.max(most, places[rounds.centres[i]] + rounds.radii[i]);
    }
    return least <= most ? [least, most] : [0, 0];
  });
  return { least: found.map(([least]) => least), most: found.map(([, most]) => most) };
}

// The length of a pixel, where widths of strokes are in pixels: one of a picture of the usual size, and at most a unit.
function pixelOf({ broadest, pixels }, { least, most }) {
  if (!(pixels === "pixels" || (pixels === "auto" && broadest >= 1))) return 1;
  const up = least.length - 1, room = Math.min(broadest, BROADEST_PART * PICTURE_HEIGHT);
  const across = Math.max(most[0] - least[0], 1e-9), high = Math.max(most[up] - least[up], 1e-9);
  const scale = Math.min((PICTURE_WIDTH - room - 2 * PICTURE_MARGIN) / across,
    (PICTURE_HEIGHT - room - 2 * PICTURE_MARGIN) / high, LARGEST_SCALE);
  return Math.min(1, 1 / scale);
}

function widthsInUnits(widths, pixel) {
  return pixel === 1 ? widths : widths.map((width) => (width === OWN_LOOK ? OWN_LOOK : width * pixel));
}

function broadestOf(numbers, least) {
  return numbers.reduce((most, number) => Math.max(most, number), least);
}

function medianLength(numbers) {
  if (!numbers.length) return 1;
  const sorted = Float64Array.from(numbers).sort(), middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}
