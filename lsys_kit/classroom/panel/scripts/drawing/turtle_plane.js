// A turtle's trail in the plane: for each point how often the turtle has turned by the angle, how many degrees it has turned
// besides, how far it went, and from which earlier point. None of this depends on the angle.
//
// An orientation is [turns, degrees, side]: both to the left, and the side on which its left lies, 1, or -1 after a roll by
// half a turn. Point 0 is the origin. Fractint's turtle, which never leaves the plane, has a second heading, in degrees.

import { FRACTINT_COLOURS, FRACTINT_WHITE, LARGEST_EXACT, OWN_LOOK } from "./constants.js";
import { amountOf, commonActions, drawBox, goAhead, roomFor } from "./turtle_actions.js";

const RADIANS_PER_DEGREE = Math.PI / 180, STRIDE = 4; // numbers of a point

export function planeTrail({ side }) {
  const points = [0, 0, 0, 0];
  const record = (turns, degrees, length, parent) => roomFor(points.push(turns, degrees, length, parent) / STRIDE) - 1;
  return {
    orientation: [0, 0, side],
    headed: (degrees) => [0, degrees, 1],
    step: ([turns, degrees], length, parent) => record(turns, degrees, length, parent),
    local: ([turns, degrees, left], parent, ahead, across) =>
      record(turns, degrees + (left * Math.atan2(across, ahead)) / RADIANS_PER_DEGREE, Math.hypot(ahead, across), parent),
    between(last, part) {
      const [turns, degrees, length, parent] = points.slice(STRIDE * last, STRIDE * last + STRIDE);
      return record(turns, degrees, length * part, parent);
    },
    packed() {
      const n = points.length / STRIDE;
      return { n, points: new Float64Array(points), x: new Float64Array(n), y: new Float64Array(n) };
    },
  };
}

function turn(turtle, call) {
  const [turns, degrees, side] = turtle.orientation;
  turtle.orientation = [turns + side * call.factor, degrees + side * call.addend, side];
}

function turnMirrored(turtle, call) {
  const [turns, degrees, side] = turtle.orientation;
  turtle.orientation = [turns + turtle.mirror * call.factor, degrees, side];
}

function roll(turtle, call) {
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

const wrapped = (value, round) => ((value % round) + round) % round;

const rectangle = (length, half) => [[[0, -half, 0], [length, -half, 0], [length, half, 0], [0, half, 0]]];

export function planeActions() {
  return {
    ...commonActions(), "turn": turn, "turn back": turn, "roll": roll, "return to stroke": returnToStroke, "draw box": drawBox(rectangle),
    "draw by second heading": bySecondHeading(true), "move by second heading": bySecondHeading(false),
    "turn second heading": (turtle, call) => { turtle.secondHeading += turtle.mirror * call.addend; },
    "mirror turns": (turtle) => { turtle.mirror = -turtle.mirror; },
    "turn by mirrored angle": turnMirrored, "set palette colour": setPaletteColour,
  };
}

export function placeInPlane({ n, points, x, y }, wanted, heading) {
  const angle = Math.abs(wanted) > LARGEST_EXACT ? wanted % 360 : wanted; // the number of turns is whole
  for (let i = 1, at = STRIDE; i < n; i++, at += STRIDE) {
    const direction = (points[at] * angle + points[at + 1] + heading) * RADIANS_PER_DEGREE, length = points[at + 2], from = points[at + 3];
    x[i] = x[from] + length * Math.cos(direction);
    y[i] = y[from] + length * Math.sin(direction);
  }
}
