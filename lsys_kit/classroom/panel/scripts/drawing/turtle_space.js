// A turtle's trail in space: a tree of frames, each made from an earlier one by a rotation, and a tree of points, each so far
// ahead, to the left and up from an earlier one in some frame. Neither depends on the angle.
//
// A frame is three unit vectors: the heading H, the left L and the up U, where H x L = U. x grows to the right, z upwards and y
// away from the viewer. An orientation is the number of a frame, of which 0 is the first; point 0 is the origin.
//
// Between points that it has passed a turtle spans generalised cylinders and patches. The axis of a cylinder is a row of cubic
// Hermite curves, the tangents of which have the directions of the headings at its control points.

import { clamped } from "../books/numbers.js";
import { MOST_PARTS, NEGLIGIBLE, OWN_LOOK, PATCH_FACES, RENORMALISED_AFTER, TANGENT } from "./constants.js";
import { amountOf, commonActions, drawBox, recordFace, recordStroke, roomFor, strokeWidth } from "./turtle_actions.js";
import { returnToStroke } from "./turtle_plane.js";

const TURNED = 0, PITCHED = 1, ROLLED = 2, LEVELLED = 3, BENT_DOWN = 4, BENT_TOWARDS = 5, POINTED = 6; // how a frame is made
// Points that lie in no frame: given by coordinates, as a part of the way to another, on a curve, or as a mean of others.
const ABSOLUTE = -1, BETWEEN = -2, CURVED = -3, BLENDED = -4;
const HEAD_AT = 0, LEFT_AT = 3, UP_AT = 6, FRAME_SIZE = 9; // where the vectors of a frame stand, and how many numbers it has
const ROTATION_SIZE = 4, POINT_SIZE = 5; // numbers of what is recorded of a frame and of a point
const DEGREES_PER_TURN = 360, QUARTER = 90, QUARTERS = [[1, 0], [0, 1], [-1, 0], [0, -1]];
const ROWS = 4; // of the control points of a patch, and their columns

export function spaceTrail({ side }) {
  const rotations = [0, TURNED, 0, 0], points = [0, ABSOLUTE, 0, 0, 0], pulls = [], spans = [];

  // A rotation by an amount, by gravitropism of a strength, by a tropism; the meaning of number and value depends on the kind.
  const frame = (parent, kind, number, value) => roomFor(rotations.push(parent, kind, number, value) / ROTATION_SIZE) - 1;
  const point = (parent, within, a, b, c) => roomFor(points.push(parent, within, a, b, c) / POINT_SIZE) - 1;

  function bent(orientation, tropisms) {
    for (const pull of tropisms.values()) orientation = frame(orientation, BENT_TOWARDS, pulls.push(pull) - 1, 0);
    return orientation;
  }

  return {
    frame, bent, orientation: 0,
    step: (orientation, length, parent) => point(parent, orientation, length, 0, 0),
    local: (orientation, parent, ahead, left, up) => point(parent, orientation, ahead, left, up),
    between: (last, part) => point(points[POINT_SIZE * last], BETWEEN, part, last, 0),
    at: ([x, y, z]) => point(0, ABSOLUTE, x, y, z),
    curved: (before, after, share) => point(0, CURVED, share, spans.push([before, after]) - 1, 0),
    blended: (numbers, weights) => point(0, BLENDED, 0, spans.push([numbers, weights]) - 1, 0),
    pointed: (orientation, directions) => frame(orientation, POINTED, pulls.push(directions) - 1, 0),
    packed() {
      const n = points.length / POINT_SIZE, many = rotations.length / ROTATION_SIZE, [x, y, z] = [0, 1, 2].map(() => new Float64Array(n));
      return { n, x, y, z, points: new Float64Array(points), spans, side, pulls, rotations: new Float64Array(rotations),
        axes: new Float64Array(FRAME_SIZE * many), since: new Int32Array(many) };
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
  turtle.orientation = turtle.trail.frame(turtle.orientation, BENT_DOWN, 0, amountOf(call, turtle.gravitropism));
}

// `@Ts(e)`, or as in cpfg `@Ts(number, e)`, or with a direction `@Ts(number, e, x, y, z)`.
function setTropism(turtle, { values }) {
  const [number, elasticity, ...direction] = values.length > 1 ? values : [1, values[0] ?? 0];
  const towards = direction.length === 3 ? direction : [0, -1, 0];
  turtle.tropisms = new Map(turtle.tropisms).set(number, fromCpfg(towards.map((part) => elasticity * part)));
}

// `@R(x, y, z)`, or with an up `@R(x, y, z, x, y, z)`.
function setHeading(turtle, { values }) {
  const [x, y, z, ...up] = [...values, 0, 0, 0], heading = fromCpfg([x, y, z]);
  if (Math.hypot(...heading) > NEGLIGIBLE)
    turtle.orientation = turtle.trail.pointed(turtle.orientation, [heading, values.length > 5 ? fromCpfg(up) : null]);
}

function setPosition(turtle, { values }) {
  turtle.position = turtle.trail.at(fromCpfg([...values, 0, 0, 0]));
}

// In cpfg's axes y grows upwards and z towards the viewer.
const fromCpfg = /** @param {number[]} point */ ([x, y, z]) => [x, -z, y];

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

// Cylinders and patches

const here = (turtle) => ({ position: turtle.position, orientation: turtle.orientation, width: strokeWidth(turtle) });

const boundedNumber = (value) => clamped(1, MOST_PARTS, Math.round(value));

function continueCylinder(turtle, call) {
  const before = turtle.axis;
  if (!before) return;
  const after = (turtle.axis = here(turtle)), parts = boundedNumber(amountOf(call, 0)), bare = [before.width, after.width].includes(OWN_LOOK);
  let from = before.position;
  for (let number = 1; number <= parts; number++) {
    const share = number / parts, to = number < parts ? turtle.trail.curved(before, after, share) : after.position;
    recordStroke(turtle, from, to, bare ? OWN_LOOK : (1 - share) * before.width + share * after.width);
    from = to;
  }
}

function endCylinder(turtle, call) {
  continueCylinder(turtle, call);
  turtle.axis = null;
}

function setControlPoint(turtle, { values: [number = 0, row = 0, column = 0] }) {
  turtle.patches.get(number)?.set(`${row} ${column}`, { row, column, point: turtle.position });
}

// Rows and columns count from 0 or from 1.
function drawPatch(turtle, { values: [number = 0, along = PATCH_FACES, across = PATCH_FACES] }) {
  const set = [...(turtle.patches.get(number)?.values() ?? [])];
  const [rows, columns] = ["row", "column"].map((kind) => [...new Set(set.map((each) => each[kind]))].sort((a, b) => a - b));
  if (set.length !== ROWS ** 2 || rows.length !== ROWS || columns.length !== ROWS) return;
  const control = [];
  for (const { row, column, point } of set) control[ROWS * rows.indexOf(row) + columns.indexOf(column)] = point;
  const [down, over] = [along, across].map(boundedNumber), grid = [];
  for (let i = 0; i <= down; i++)
    for (let j = 0; j <= over; j++) grid.push(turtle.trail.blended(control, products(bernstein(i / down), bernstein(j / over))));
  for (let i = 0; i < down; i++)
    for (let j = 0; j < over; j++) {
      const at = i * (over + 1) + j;
      recordFace(turtle.faces, [at, at + over + 1, at + over + 2, at + 1].map((k) => grid[k]), turtle, true);
    }
}

const products = (a, b) => a.flatMap((x) => b.map((y) => x * y));

const bernstein = (t) => [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t ** 2 * (1 - t), t ** 3];

export function spaceActions() {
  return {
    ...commonActions(), "draw box": drawBox(boxSides), "set heading": setHeading, "turn": rotationBy(TURNED), "turn back": rotationBy(TURNED),
    "pitch": rotationBy(PITCHED), "roll": rotationBy(ROLLED), "level": rollLevel, "gravitropism": bendByGravitropism,
    "set tropism": setTropism, "set position": setPosition, "return to stroke": returnToStroke,
    "begin cylinder": (turtle) => { turtle.axis = here(turtle); },
    "continue cylinder": continueCylinder, "end cylinder": endCylinder,
    "begin patch": (turtle, { values: [number = 0] }) => { turtle.patches.set(number, new Map()); },
    "set control point": setControlPoint, "draw patch": drawPatch,
  };
}

// Where everything lies

// Cosine and sine, exact for quarter turns.
function cosineAndSine(degrees) {
  if (degrees % QUARTER === 0) return QUARTERS[(((degrees / QUARTER) % 4) + 4) % 4];
  const radians = ((degrees % DEGREES_PER_TURN) * Math.PI) / 180;
  return [Math.cos(radians), Math.sin(radians)];
}

// Find where the points of a trail lie for an angle; an amount of rotation is a factor of the angle and further degrees.
export function placeInSpace(trail, amounts, angle, heading) {
  const { n, x, y, z, points, spans, axes } = trail;
  placeFrames(trail, amounts, angle, heading);
  for (let i = 1, row = POINT_SIZE; i < n; i++, row += POINT_SIZE) {
    const from = points[row], frame = points[row + 1], at = FRAME_SIZE * frame, ahead = points[row + 2], left = points[row + 3], up = points[row + 4];
    if (at >= 0) {
      x[i] = x[from] + ahead * axes[at] + left * axes[at + LEFT_AT] + up * axes[at + UP_AT];
      y[i] = y[from] + ahead * axes[at + 1] + left * axes[at + LEFT_AT + 1] + up * axes[at + UP_AT + 1];
      z[i] = z[from] + ahead * axes[at + 2] + left * axes[at + LEFT_AT + 2] + up * axes[at + UP_AT + 2];
    } else if (frame === ABSOLUTE) {
      [x[i], y[i], z[i]] = [ahead, left, up];
    } else if (frame === BETWEEN) {
      for (const places of [x, y, z]) places[i] = places[from] + ahead * (places[left] - places[from]);
    } else {
      [x[i], y[i], z[i]] = frame === CURVED ? onCurve(trail, ahead, spans[left]) : blend(trail, spans[left]);
    }
  }
}

// Where the point at a share of a Hermite curve lies, given its ends.
function onCurve({ x, y, z, axes }, share, ends) {
  const [first, last] = ends.map(({ position: i }) => [x[i], y[i], z[i]]), headings = ends.map(({ orientation }) => FRAME_SIZE * orientation);
  const reach = TANGENT * Math.hypot(...last.map((place, axis) => place - first[axis])), rest = 1 - share;
  return first.map((place, axis) => (1 + 2 * share) * rest ** 2 * place + share * rest ** 2 * reach * axes[headings[0] + axis]
    + share ** 2 * (3 - 2 * share) * last[axis] - share ** 2 * rest * reach * axes[headings[1] + axis]);
}

function blend({ x, y, z }, [numbers, weights]) {
  return [x, y, z].map((places) => numbers.reduce((sum, number, k) => sum + weights[k] * places[number], 0));
}

function placeFrames({ side, pulls, rotations, axes, since }, amounts, angle, heading) {
  const turned = amounts.map(([factor, addend]) => cosineAndSine(factor * angle + addend));
  placeFirstFrame(axes, side, heading);
  for (let i = 1, row = ROTATION_SIZE, to = FRAME_SIZE; i < since.length; i++, row += ROTATION_SIZE, to += FRAME_SIZE) {
    const parent = rotations[row], kind = rotations[row + 1], number = rotations[row + 2];
    axes.copyWithin(to, FRAME_SIZE * parent, FRAME_SIZE * (parent + 1));
    const rotated = kind <= ROLLED ? rotateTowards(axes, to, kind, turned[number])
      : kind === LEVELLED ? makeLevel(axes, to)
      : kind === BENT_DOWN ? bendDown(axes, to, rotations[row + 3])
      : kind === BENT_TOWARDS ? bendTowards(axes, to, pulls[number])
      : pointTowards(axes, to, pulls[number]);
    since[i] = kind === POINTED ? 0 : since[parent] + rotated;
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

const cross = /** @type {(a: any, b: any) => number[]} */ ([ax, ay, az], [bx, by, bz]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];

function rotateAbout(axes, at, axis, radians) {
  const [ax, ay, az] = axis, cos = Math.cos(radians), sin = Math.sin(radians);
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
