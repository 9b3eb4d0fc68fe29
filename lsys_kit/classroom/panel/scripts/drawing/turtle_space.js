// A turtle's trail in space: a tree of frames, each made from an earlier one by a rotation, and a tree of points, each so far
// ahead, to the left and up from an earlier one in some frame. Neither depends on the angle.
//
// A frame is three unit vectors: the heading H, the left L and the up U, where H x L = U. x grows to the right, z upwards and y
// away from the viewer. An orientation is the number of a frame, of which 0 is the first; point 0 is the origin.

import { commonActions, drawBox, roomFor } from "./turtle_actions.js";
import { curveActions, onCurve } from "./turtle_curves.js";
import { returnToStroke } from "./turtle_plane.js";

const TURNED = 0, PITCHED = 1, ROLLED = 2, LEVELLED = 3, BENT_DOWN = 4, BENT_TOWARDS = 5, POINTED = 6; // how a frame is made
// Points that lie in no frame: given by coordinates, as a part of the way to another, on a curve, or as a mean of others.
const ABSOLUTE = -1, BETWEEN = -2, CURVED = -3, BLENDED = -4;
const HEAD_AT = 0, LEFT_AT = 3, UP_AT = 6, FRAME_SIZE = 9; // where the vectors of a frame stand, and how many numbers it has
const NEGLIGIBLE = 1e-12; // smaller sines are taken for 0
const RENORMALISED_AFTER = 1000; // rotations a frame is made orthonormal again
const DEGREES_PER_TURN = 360, QUARTER = 90;
const QUARTERS = [[1, 0], [0, 1], [-1, 0], [0, -1]];

export function spaceTrail(setting) {
  const frames = { parents: [0], kinds: [TURNED], numbers: [0], values: [0] };
  const points = { parents: [0], frames: [ABSOLUTE], a: [0], b: [0], c: [0] }, pulls = [], spans = [];

  // A rotation by an amount, by gravitropism of a strength, by a tropism; the meaning of number and value depends on the kind.
  function frame(parent, kind, number, value) {
    frames.kinds.push(kind);
    frames.numbers.push(number);
    frames.values.push(value);
    return roomFor(frames.parents.push(parent)) - 1;
  }

  function point(parent, within, a, b, c) {
    points.frames.push(within);
    points.a.push(a);
    points.b.push(b);
    points.c.push(c);
    return roomFor(points.parents.push(parent)) - 1;
  }

  function bent(orientation, tropisms) {
    for (const pull of tropisms.values()) orientation = frame(orientation, BENT_TOWARDS, pulls.push(pull) - 1, 0);
    return orientation;
  }

  return {
    frame, bent, orientation: 0,
    step: (orientation, length, parent) => point(parent, orientation, length, 0, 0),
    local: (orientation, parent, ahead, left, up) => point(parent, orientation, ahead, left, up),
    between: (last, part) => point(points.parents[last], BETWEEN, part, last, 0),
    at: ([x, y, z]) => point(0, ABSOLUTE, x, y, z),
    curved: (before, after, share) => point(0, CURVED, share, spans.push([before, after]) - 1, 0),
    blended: (numbers, weights) => point(0, BLENDED, 0, spans.push([numbers, weights]) - 1, 0),
    pointed: (orientation, directions) => frame(orientation, POINTED, pulls.push(directions) - 1, 0),
    packed: () => packedTrail(setting, points, frames, pulls, spans),
  };
}

function packedTrail({ side }, points, frames, pulls, spans) {
  const n = points.parents.length, m = frames.parents.length, real = (numbers) => new Float64Array(numbers);
  return {
    n, x: real(n), y: real(n), z: real(n), parents: new Int32Array(points.parents), frames: new Int32Array(points.frames),
    a: real(points.a), b: real(points.b), c: real(points.c), spans,
    rotations: {
      n: m, side, pulls, axes: real(FRAME_SIZE * m), since: new Int32Array(m), parents: new Int32Array(frames.parents),
      kinds: new Uint8Array(frames.kinds), numbers: new Int32Array(frames.numbers), values: real(frames.values),
    },
  };
}

const rotationBy = (kind) => (turtle, call) => {
  turtle.orientation = turtle.trail.frame(turtle.orientation, kind, call.amount, 0);
};

function rollLevel(turtle) {
  turtle.orientation = turtle.trail.frame(turtle.orientation, LEVELLED, 0, 0);
}

function bendByGravitropism(turtle, call) {
  const strength = call.factor * turtle.gravitropism + call.addend;
  turtle.orientation = turtle.trail.frame(turtle.orientation, BENT_DOWN, 0, strength);
}

// `@Ts(e)`, or as in cpfg `@Ts(number, e)`, or with a direction `@Ts(number, e, x, y, z)`.
function setTropism(turtle, { values }) {
  const [number, elasticity, ...direction] = values.length > 1 ? values : [1, values[0] ?? 0];
  const towards = direction.length === 3 ? direction : [0, -1, 0];
  turtle.tropisms = new Map(turtle.tropisms).set(number, fromCpfg(towards.map((part) => elasticity * part)));
}

// `@R(x, y, z)`, or with an up `@R(x, y, z, x, y, z)`.
function setHeading(turtle, { values }) {
  const [x, y, z, ...up] = [...values, 0, 0, 0];
  const heading = fromCpfg([x, y, z]);
  if (Math.hypot(...heading) <= NEGLIGIBLE) return;
  turtle.orientation = turtle.trail.pointed(turtle.orientation, [heading, values.length > 5 ? fromCpfg(up) : null]);
}

function setPosition(turtle, { values }) {
  turtle.position = turtle.trail.at(fromCpfg([...values, 0, 0, 0]));
}

// In cpfg's axes y grows upwards and z towards the viewer.
const fromCpfg = ([x, y, z]) => [x, -z, y];

// The sides of a box, each with its corners counter-clockwise as seen from outside.
function boxSides(length, half) {
  const ends = [[Math.min(length, 0), Math.max(length, 0)], [-half, half], [-half, half]];
  const around = [[0, 0], [1, 0], [1, 1], [0, 1]];
  return [0, 1, 2].flatMap((axis) => [around.map(([one, other]) => [other, one]), around].map((corners, end) =>
    corners.map(([one, other]) => {
      const side = [end, one, other];
      return ends.map(([least, greatest], k) => (side[(k - axis + 3) % 3] ? greatest : least));
    })));
}

export function spaceActions() {
  return {
    ...commonActions(), ...curveActions(), "draw box": drawBox(boxSides), "set heading": setHeading, "turn": rotationBy(TURNED), "pitch": rotationBy(PITCHED),
    "roll": rotationBy(ROLLED), "level": rollLevel, "gravitropism": bendByGravitropism,
    "set tropism": setTropism, "set position": setPosition, "return to stroke": returnToStroke,
  };
}

// Cosine and sine, exact for quarter turns.
function cosineAndSine(degrees) {
  if (degrees % QUARTER === 0) return QUARTERS[(((degrees / QUARTER) % 4) + 4) % 4];
  const radians = ((degrees % DEGREES_PER_TURN) * Math.PI) / 180;
  return [Math.cos(radians), Math.sin(radians)];
}

// Find where the points of a trail lie for an angle; an amount of rotation is a factor of the angle and further degrees.
export function placeInSpace(trail, amounts, angle, heading) {
  const { n, x, y, z, parents, frames, a, b, c, spans, rotations } = trail, { axes } = rotations;
  placeFrames(rotations, amounts, angle, heading);
  for (let i = 1; i < n; i++) {
    const from = parents[i], at = FRAME_SIZE * frames[i], ahead = a[i];
    if (at >= 0) {
      x[i] = x[from] + ahead * axes[at] + b[i] * axes[at + LEFT_AT] + c[i] * axes[at + UP_AT];
      y[i] = y[from] + ahead * axes[at + 1] + b[i] * axes[at + LEFT_AT + 1] + c[i] * axes[at + UP_AT + 1];
      z[i] = z[from] + ahead * axes[at + 2] + b[i] * axes[at + LEFT_AT + 2] + c[i] * axes[at + UP_AT + 2];
    } else if (frames[i] === ABSOLUTE) {
      [x[i], y[i], z[i]] = [ahead, b[i], c[i]];
    } else if (frames[i] === BETWEEN) {
      for (const places of [x, y, z]) places[i] = places[from] + ahead * (places[b[i]] - places[from]);
    } else {
      [x[i], y[i], z[i]] = frames[i] === CURVED ? placeOnCurve(trail, ahead, spans[b[i]]) : blend(trail, spans[b[i]]);
    }
  }
}

function placeOnCurve({ x, y, z, rotations: { axes } }, share, ends) {
  const [first, last] = ends.map(({ position: i }) => [x[i], y[i], z[i]]);
  return onCurve(share, first, last, ends.map(({ orientation }) => axes.subarray(FRAME_SIZE * orientation, FRAME_SIZE * orientation + 3)));
}

function blend({ x, y, z }, [numbers, weights]) {
  return [x, y, z].map((places) => numbers.reduce((sum, number, k) => sum + weights[k] * places[number], 0));
}

function placeFrames({ n, side, pulls, axes, since, parents, kinds, numbers, values }, amounts, angle, heading) {
  const turned = amounts.map(([factor, addend]) => cosineAndSine(factor * angle + addend));
  placeFirstFrame(axes, side, heading);
  for (let i = 1; i < n; i++) {
    const to = FRAME_SIZE * i, kind = kinds[i];
    axes.copyWithin(to, FRAME_SIZE * parents[i], FRAME_SIZE * (parents[i] + 1));
    const rotated = kind <= ROLLED ? rotateTowards(axes, to, kind, turned[numbers[i]])
      : kind === LEVELLED ? makeLevel(axes, to)
      : kind === BENT_DOWN ? bendDown(axes, to, values[i])
      : kind === BENT_TOWARDS ? bendTowards(axes, to, pulls[numbers[i]])
      : pointTowards(axes, to, pulls[numbers[i]]);
    since[i] = kind === POINTED ? 0 : since[parents[i]] + rotated;
    if (since[i] > RENORMALISED_AFTER) since[i] = renormalise(axes, to);
  }
}

function placeFirstFrame(axes, side, heading) {
  const [cos, sin] = cosineAndSine(heading);
  axes.set([cos, 0, sin, -side * sin, 0, side * cos]);
  setCross(axes, UP_AT, HEAD_AT, LEFT_AT);
}

// A rotation of the first of two vectors towards the second: of H towards L, of U towards H, of U towards L.
const ROTATED = [[HEAD_AT, LEFT_AT], [UP_AT, HEAD_AT], [UP_AT, LEFT_AT]];

function rotateTowards(axes, at, kind, [cos, sin]) {
  const [first, second] = ROTATED[kind];
  for (let i = at; i < at + 3; i++) {
    const a = axes[i + first], b = axes[i + second];
    axes[i + first] = cos * a + sin * b;
    axes[i + second] = cos * b - sin * a;
  }
  return true;
}

// Roll until L is level: it becomes that of vertical x H, unless H is vertical.
function makeLevel(axes, at) {
  const across = Math.hypot(axes[at], axes[at + 1]);
  if (across > NEGLIGIBLE) {
    axes.set([-axes[at + 1] / across, axes[at] / across, 0], at + LEFT_AT);
    setCross(axes, at + UP_AT, at + HEAD_AT, at + LEFT_AT);
  }
  return false;
}

// H takes the direction of H - strength * vertical; a vertical H can only be reversed.
function bendDown(axes, at, strength) {
  const x = axes[at], y = axes[at + 1], z = axes[at + 2], across = Math.hypot(x, y);
  if (across > NEGLIGIBLE) {
    rotateAbout(axes, at, [-y / across, x / across, 0], Math.atan2(across, z - strength) - Math.atan2(across, z));
    return true;
  }
  return z > 0 && strength > 1 && rotateTowards(axes, at, PITCHED, [-1, 0]);
}

// A tropism T of elasticity e bends by the angle e |H x T| about H x T; the pull is e T.
function bendTowards(axes, at, [px, py, pz]) {
  const x = axes[at], y = axes[at + 1], z = axes[at + 2];
  const axis = [y * pz - z * py, z * px - x * pz, x * py - y * px], radians = Math.hypot(...axis);
  if (radians <= NEGLIGIBLE) return false;
  rotateAbout(axes, at, axis.map((part) => part / radians), radians);
  return true;
}

// H takes a direction, and U one that is given, or the one that it has, as far as that lets it.
function pointTowards(axes, at, [heading, up]) {
  const length = Math.hypot(...heading), head = heading.map((part) => part / length), before = [...axes.subarray(at, at + FRAME_SIZE)];
  const own = before.slice(UP_AT), sides = [cross(up ?? own, head), cross(own, head), before.slice(LEFT_AT, UP_AT)];
  axes.set(head, at + HEAD_AT);
  axes.set(sides.find((side) => Math.hypot(...side) > NEGLIGIBLE), at + LEFT_AT);
  scaleToUnit(axes, at + LEFT_AT);
  setCross(axes, at + UP_AT, at + HEAD_AT, at + LEFT_AT);
  return false;
}

const cross = ([ax, ay, az], [bx, by, bz]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];

function rotateAbout(axes, at, [ax, ay, az], radians) {
  const cos = Math.cos(radians), sin = Math.sin(radians);
  for (let i = at; i < at + FRAME_SIZE; i += 3) {
    const x = axes[i], y = axes[i + 1], z = axes[i + 2], along = (1 - cos) * (ax * x + ay * y + az * z);
    axes[i] = cos * x + sin * (ay * z - az * y) + along * ax;
    axes[i + 1] = cos * y + sin * (az * x - ax * z) + along * ay;
    axes[i + 2] = cos * z + sin * (ax * y - ay * x) + along * az;
  }
}

function renormalise(axes, at) {
  scaleToUnit(axes, at + HEAD_AT);
  setCross(axes, at + UP_AT, at + HEAD_AT, at + LEFT_AT);
  scaleToUnit(axes, at + UP_AT);
  setCross(axes, at + LEFT_AT, at + UP_AT, at + HEAD_AT);
  return 0;
}

function scaleToUnit(axes, at) {
  const length = Math.hypot(axes[at], axes[at + 1], axes[at + 2]);
  for (let i = at; i < at + 3; i++) axes[i] /= length;
}

function setCross(axes, to, a, b) {
  axes.set(cross(axes.subarray(a, a + 3), axes.subarray(b, b + 3)), to);
}
