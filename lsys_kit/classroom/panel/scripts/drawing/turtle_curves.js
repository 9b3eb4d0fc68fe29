// What a turtle in space spans between points that it has passed: generalised cylinders and patches, and headings that are given.
//
// The axis of a generalised cylinder is a row of cubic Hermite curves, the tangents of which have the directions of the headings at
// its control points, and are 1.2 times as long as these are apart.

import { OWN_LOOK, addFace, amountOf, recordStroke, strokeWidth } from "./turtle_actions.js";

const TANGENT = 1.2; // the lengths of tangents, where their points are 1 apart
const MOST_PARTS = 100, PATCH_FACES = 5, ROWS = 4;

const here = (turtle) => ({ position: turtle.position, orientation: turtle.orientation, width: strokeWidth(turtle) });

const boundedNumber = (value) => Math.max(1, Math.min(MOST_PARTS, Math.round(value)));

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
  const set = [...(turtle.patches.get(number)?.values() ?? [])], { colour, place, state } = turtle;
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
      addFace(turtle.faces, { corners: [at, at + over + 1, at + over + 2, at + 1].map((k) => grid[k]), colour, place, state }, true);
    }
}

const products = (a, b) => a.flatMap((x) => b.map((y) => x * y));

const bernstein = (t) => [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t ** 2 * (1 - t), t ** 3];

export function curveActions() {
  return {
    "begin cylinder": (turtle) => { turtle.axis = here(turtle); },
    "continue cylinder": continueCylinder, "end cylinder": endCylinder,
    "begin patch": (turtle, { values: [number = 0] }) => { turtle.patches.set(number, new Map()); },
    "set control point": setControlPoint, "draw patch": drawPatch,
  };
}

// Where the point at a share of a Hermite curve lies, given its ends and the tangents of length 1 there.
export function onCurve(share, first, last, headings) {
  const reach = TANGENT * Math.hypot(...last.map((place, axis) => place - first[axis])), rest = 1 - share;
  return first.map((place, axis) => (1 + 2 * share) * rest ** 2 * place + share * rest ** 2 * reach * headings[0][axis]
    + share ** 2 * (3 - 2 * share) * last[axis] - share ** 2 * rest * reach * headings[1][axis]);
}
