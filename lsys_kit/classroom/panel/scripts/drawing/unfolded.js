// The unfolding: between two steps every module becomes its successor in place, all at the same time.
//
// A part of the way from 0 to 1 is drawn by the turtle itself, from a word in between. It has the modules of the later step, whose commands
// are on their way: at 0 they do together what those of the mother did, at 1 what they are. A stroke of the mother is shared out among those
// on the trunk of its successor, in the proportion of their lengths; a command that both have goes from one number to the other; what the
// successor has besides grows from nothing, and what it lacks shrinks to nothing. How broad a stroke is, and its natural colour, goes from that of
// the mother's stroke to its own, since both follow from the whole plant. So the drawing at 0 and at 1 is that of the steps.

import { RAMP_END, RAMP_START } from "./constants.js";
import { placed, traced } from "./turtle.js";

const AHEAD = ["draw", "move", "draw without vertex", "move without vertex"];
const GROWING = [...AHEAD, "turn", "turn back", "turn by mirrored angle", "pitch", "roll", "gravitropism", "draw surface", "draw expected surface",
  "draw circle", "draw disc", "draw sphere", "draw box", "turn second heading", "draw by second heading", "move by second heading"]; // an amount of 0 is none
const QUANTITIES = ["set length", "set width", "set scale", "set gravitropism", "set length once", "set width once", "set gravitropism once"]; // the same times 1
const BRACKETS = ["push", "pop", "begin polygon", "record vertex", "end polygon", "expect surface"]; // wholly there from the beginning, or up to the end
const INFINITE = 1e300; // in books
const unfoldings = new WeakMap();

// The word between a step and the next: { word, rows, ways, mothers, later }, the modules as numbers, of each number the state of which it
// looks, and its commands on their way, and of each module the position of its mother in the word before, and its own in the later word.
function unfoldingOf(book, step) {
  const known = unfoldings.get(book);
  if (known?.step === step) return known;
  const before = book.word(step), after = book.word(step + 1), numbers = new Map(), word = [], rows = [], ways = [], mothers = [], later = [];
  for (let first = 0, next = 1; first < before.length; first = next++) {
    const [from, to] = book.daughters(step, first);
    while (next < before.length && from !== to && book.daughters(step, next)[0] === from) next++;
    const states = [before.subarray(first, next), after.subarray(from, to)], key = states.join(">");
    if (!numbers.has(key)) {
      const made = waysOf(book.data.turtle, ...states);
      numbers.set(key, made.map((way, i) => {
        rows.push(book.data.states[states[1][i] ?? before[first]]);
        return ways.push(way) - 1;
      }));
    }
    numbers.get(key).forEach((number, i) => {
      word.push(number);
      mothers.push(first);
      later.push(to > from ? from + i : -1);
    });
  }
  const found = { step, word: Int32Array.from(word), rows, ways, mothers, later };
  unfoldings.set(book, found);
  return found;
}

// For each daughter, or for one where there is none, its commands, each as a function of the part of the way.
function waysOf({ calls, length }, mothers, daughters) {
  const owners = [...daughters].flatMap((state, i) => calls[state].map(() => i)), later = deepened([...daughters].flatMap((state) => calls[state]));
  const earlier = deepened([...mothers].flatMap((state) => calls[state])), found = Array.from({ length: Math.max(1, daughters.length) }, () => []);
  const starts = shares(earlier, later, length);
  let at = 0;
  const add = (place, way) => found[owners[place] ?? found.length - 1].push(way);
  const arrive = (end) => {
    for (; at < end; at++) add(at, starts.has(at) ? between(starts.get(at), later[at]) : growing(later[at]));
  };
  for (const call of earlier) {
    if (call === starts.shared) continue;
    const same = later.findIndex((each, i) => i >= at && !starts.has(i) && each[0] === call[0] && each.depth === call.depth && each[4] === call[4]);
    if (same < 0) add(at, shrinking(call));
    else {
      arrive(same);
      add(at++, between(call, later[same]));
    }
  }
  arrive(later.length);
  return found;
}

// The commands with how deep in brackets each stands.
function deepened(calls) {
  let depth = 0;
  return calls.map((call) => {
    const [name] = call, own = name === "pop" ? --depth : depth;
    if (name === "push") depth++;
    return Object.assign([...call], { depth: own });
  });
}

// What of the only stroke of the mothers falls to each of those on the trunk of its successor, by their places among its commands.
function shares(earlier, later, length) {
  const strokes = earlier.filter(([name]) => AHEAD.includes(name)), starts = new Map();
  if (strokes.length !== 1) return Object.assign(starts, { shared: null });
  const [name, factor, addend, ...rest] = strokes[0], heirs = later.flatMap((each, i) => (each[0] === name && !each.depth ? [i] : []));
  const sizes = heirs.map((i) => Math.abs(later[i][1] * length + Number(later[i][2]))), all = sizes.reduce((sum, size) => sum + size, 0);
  heirs.forEach((place, i) => {
    const share = all ? sizes[i] / all : 1 / heirs.length;
    starts.set(place, [name, share * factor, share * addend, ...rest]);
  });
  return Object.assign(starts, { shared: heirs.length ? strokes[0] : null });
}

// From one number to another; what stands for an infinite one is there from the middle on.
function way(from, to, part) {
  if (Math.max(Math.abs(from), Math.abs(to)) >= INFINITE) return part < 0.5 ? from : to;
  return Number(from) + part * (to - from);
}

const isNumber = (name) => GROWING.includes(name) || QUANTITIES.includes(name);

// From the numbers of one command to those of another of its name; what has no size changes in the middle.
function between([name, factor, addend, values, surface], [, factor1, addend1, values1, surface1]) {
  const alike = values && values1 && values.length === values1.length;
  return (part) => {
    if (!isNumber(name)) return part < 0.5 ? [name, factor, addend, values, surface] : [name, factor1, addend1, values1, surface1];
    const numbers = alike ? values1.map((value, i) => way(values[i], value, part)) : values1;
    return [name, way(factor, factor1, part), way(addend, addend1, part), numbers, surface1];
  };
}

function growing(call) {
  const [name, , , values, surface] = call;
  if (BRACKETS.includes(name)) return () => call;
  if (!isNumber(name)) return (part) => (part < 0.5 ? null : call);
  const from = between([name, QUANTITIES.includes(name) ? 1 : 0, 0, values, surface], call);
  return (part) => (part || GROWING.includes(name) ? from(part) : null);
}

function shrinking(call) {
  const [name] = call, grown = growing(call);
  return (part) => (BRACKETS.includes(name) ? (part < 1 ? call : null) : isNumber(name) || part !== 0.5 ? grown(1 - part) : null);
}

// The shapes of a part of the way from a step to the next. What is drawn of a module belongs to its mother.
export function unfoldedShapes(book, step, angle, part) {
  const ends = [step, Math.min(step + 1, book.steps)].map((each) => placed(traced(book, each), angle));
  if (part <= 0 || part >= 1) return ends[part <= 0 ? 0 : 1];
  return { ...shapesBetween(book, step, angle, part, ends), typical: (1 - part) * ends[0].typical + part * ends[1].typical };
}

function shapesBetween(book, step, angle, part, ends) {
  const { mode, symbols, turtle } = book.data, { word, rows, ways, mothers, later } = unfoldingOf(book, step);
  const calls = ways.map((way) => way.map((each) => each(part)).filter(Boolean));
  const shapes = placed(traced({ data: { mode, symbols, states: rows, turtle: { ...turtle, calls } }, word: () => word }, 0), angle);
  const named = (group) => ({ ...group, positions: group.positions.map((position) => mothers[position]) });
  const looks = looksBetween(shapes, ends, [mothers, later], part, turtle.colours.slice(RAMP_START, RAMP_END + 1));
  return { ...shapes, palette: looks.palette, faces: named(shapes.faces), rounds: named(shapes.rounds), strokes: { ...named(shapes.strokes), ...looks.strokes } };
}

// The widths and colours of strokes between those of two steps, given where each module stands in both; natural colours go through the
// shades of the ramp, and others change in the middle.
function looksBetween({ strokes: { n, positions, ...own }, palette, pixel }, ends, places, part, ramp) {
  const first = ends.map(({ strokes }) => firstStrokes(strokes)), names = [...palette], widths = own.widths.slice(), colours = own.colours.slice();
  const numberOf = (name) => (names.includes(name) ? names.indexOf(name) : names.push(name) - 1);
  for (let i = 0, nth = 0; i < n; i++) {
    nth = i && positions[i] === positions[i - 1] ? nth + 1 : 0;
    const pair = ends.map((_, end) => {
      const [from, to] = first[end].get(places[end][positions[i]]) ?? [0, 0];
      return from < to ? Math.min(from + nth, to - 1) : -1;
    });
    if (Math.max(...pair) < 0) continue;
    const [one, other] = pair.map((at, end) => (at < 0 ? [1 - end, pair[1 - end]] : [end, at])); // what one step lacks looks as in the other
    const [wide, wider] = [one, other].map(([end, at]) => ends[end].strokes.widths[at] / ends[end].pixel);
    if (wide >= 0 && wider >= 0) widths[i] = way(wide, wider, part) * pixel;
    const [name, next] = [one, other].map(([end, at]) => ends[end].palette[ends[end].strokes.colours[at]]), shades = [name, next].map((each) => ramp.indexOf(each));
    colours[i] = numberOf(Math.min(...shades) < 0 ? (part < 0.5 ? name : next) : ramp[Math.round(way(...shades, part))]);
  }
  return { palette: names, strokes: { widths, colours } };
}

// For each module that draws strokes from which up to which.
function firstStrokes({ n, positions }) {
  const found = new Map();
  for (let i = 0; i < n; i++) found.set(positions[i], [found.get(positions[i])?.[0] ?? i, i + 1]);
  return found;
}
