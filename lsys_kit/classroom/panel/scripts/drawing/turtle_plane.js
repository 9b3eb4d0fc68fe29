// A turtle's trail in the plane: for each point how often the turtle has turned by the angle, how many degrees it has turned
// besides, how far it went, and from which earlier point. None of this depends on the angle.
//
// An orientation is [turns, degrees, side]: both to the left, and the side on which its left lies, 1, or -1 after a roll by
// half a turn. Point 0 is the origin. Fractint's turtle, which never leaves the plane, has a second heading, in degrees.

import { OWN_LOOK, amountOf, commonActions, drawBox, goAhead, roomFor } from "./turtle_actions.js";

const RADIANS_PER_DEGREE = Math.PI / 180;
const FRACTINT_COLOURS = 256, FRACTINT_WHITE = 15;
const LARGEST_EXACT = 2 ** 40; // greater angles are reduced to less than a full turn: the number of turns is whole

export function planeTrail({ side }) {
  const turns = [0], degrees = [0], lengths = [0], parents = [0];

  function record(turned, offset, length, parent) {
    turns.push(turned);
    degrees.push(offset);
    lengths.push(length);
    return roomFor(parents.push(parent)) - 1;
  }

  return {
    orientation: [0, 0, side],
    headed: (offset) => [0, offset, 1],
    step: ([turned, offset], length, parent) => record(turned, offset, length, parent),
    local: ([turned, offset, left], parent, ahead, across) =>
      record(turned, offset + (left * Math.atan2(across, ahead)) / RADIANS_PER_DEGREE, Math.hypot(ahead, across), parent),
    // A point on the step that leads to another.
    between: (last, part) => record(turns[last], degrees[last], lengths[last] * part, parents[last]),
    packed: () => ({
      n: parents.length, turns: new Float64Array(turns), degrees: new Float64Array(degrees),
      lengths: new Float64Array(lengths), parents: new Int32Array(parents),
      x: new Float64Array(parents.length), y: new Float64Array(parents.length),
    }),
  };
}

function turnInPlane(turtle, call) {
  const [turns, degrees, side] = turtle.orientation;
  turtle.orientation = [turns + side * call.factor, degrees + side * call.addend, side];
}

function turnMirroredInPlane(turtle, call) {
  const [turns, degrees, side] = turtle.orientation;
  turtle.orientation = [turns + turtle.mirror * call.factor, degrees, side];
}

function rollInPlane(turtle, call) {
  const [turns, degrees, side] = turtle.orientation;
  if (call.factor === 0 && wrapped(call.addend, 360) === 180) turtle.orientation = [turns, degrees, -side];
}

export function returnToStroke(turtle, call) {
  if (turtle.last) turtle.position = turtle.trail.between(turtle.last, call.factor + call.addend);
}

function bySecondHeading(drawn) {
  const ahead = goAhead(drawn, true);
  return (turtle, call) => {
    const { orientation } = turtle;
    turtle.orientation = turtle.trail.headed(turtle.secondHeading);
    ahead(turtle, call);
    turtle.orientation = orientation;
  };
}

// Of Fractint's colours a step never leads to 0, that of the background.
function setPaletteColour(turtle, call) {
  const before = turtle.colour === OWN_LOOK ? FRACTINT_WHITE : turtle.colour, step = call.factor !== 0;
  const colour = wrapped(Math.floor(amountOf(call, before)), FRACTINT_COLOURS);
  turtle.colour = colour || !step ? colour : call.addend > 0 ? 1 : FRACTINT_COLOURS - 1;
}

// The remainder, which is never negative.
function wrapped(value, round) {
  return ((value % round) + round) % round;
}

const rectangle = (length, half) => [[[0, -half, 0], [length, -half, 0], [length, half, 0], [0, half, 0]]];

export function planeActions() {
  return {
    ...commonActions(), "turn": turnInPlane, "turn back": turnInPlane, "roll": rollInPlane, "return to stroke": returnToStroke,
    "draw box": drawBox(rectangle),
    "draw by second heading": bySecondHeading(true), "move by second heading": bySecondHeading(false),
    "turn second heading": (turtle, call) => { turtle.secondHeading += turtle.mirror * call.addend; },
    "mirror turns": (turtle) => { turtle.mirror = -turtle.mirror; },
    "turn by mirrored angle": turnMirroredInPlane, "set palette colour": setPaletteColour,
  };
}

// Find where the points of a trail lie for an angle.
export function placeInPlane({ n, turns, degrees, lengths, parents, x, y }, wanted, heading) {
  const angle = Math.abs(wanted) > LARGEST_EXACT ? wanted % 360 : wanted;
  for (let i = 1; i < n; i++) {
    const direction = (turns[i] * angle + degrees[i] + heading) * RADIANS_PER_DEGREE, from = parents[i];
    x[i] = x[from] + lengths[i] * Math.cos(direction);
    y[i] = y[from] + lengths[i] * Math.sin(direction);
  }
}
