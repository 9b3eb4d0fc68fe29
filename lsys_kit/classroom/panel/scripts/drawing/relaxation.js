// The relaxation of a map: springs pull, cells press, vertices move until they are nearly at rest. The same iterations as the
// kernel's, so that they can be watched, and so that a page without a kernel finds where cells are at rest under other forces.

import { whole } from "../books/numbers.js";
import { AT_REST, FARTHEST, LEAST_AREA, LEAST_LENGTH, MOST_ITERATIONS, SHORTEST_TIME_STEP, TIME_STEP } from "./constants.js";

const SURELY_AT_REST = 1e-9; // where no kernel goes on from there
const known = new WeakMap();

// Which points bound the walls and cells of a step.
export function tissueOf(book, step) {
  const page = book.data.maps[step];
  if (!known.has(page)) {
    const ends = whole(page.ends), corners = whole(page.corners), starts = whole(page.starts);
    const following = new Int32Array(corners.length), cellOf = new Int32Array(corners.length);
    for (let cell = 0; cell + 1 < starts.length; cell++) {
      for (let i = starts[cell]; i < starts[cell + 1]; i++) [following[i], cellOf[i]] = [corners[i + 1], cell];
      following[starts[cell + 1] - 1] = corners[starts[cell]];
    }
    known.set(page, { from: ends.filter((_, i) => i % 2 === 0), to: ends.filter((_, i) => i % 2), corners, following, cellOf, cells: starts.length - 1 });
  }
  return known.get(page);
}

// Where the points of a step are before its cells relax: x and y of each.
export function startOf(book, step) {
  if (!step) return split(book.data.first);
  const before = split(book.data.maps[step - 1].points), made = book.data.maps[step].new;
  const between = (places) => Float64Array.from([...places, ...made.map(([a, b, share]) => places[a] * (1 - share) + places[b] * share)]);
  return { x: between(before.x), y: between(before.y) };
}

function split(points) {
  return { x: Float64Array.from(points.filter((_, i) => i % 2 === 0)), y: Float64Array.from(points.filter((_, i) => i % 2)) };
}

// The tension of each wall: positive where it pulls its ends together, negative where it pushes them apart.
export function tensionsOf({ from, to }, { x, y }, { stiffness, rest }) {
  return Float64Array.from(from, (a, i) => stiffness * (Math.hypot(x[to[i]] - x[a], y[to[i]] - y[a]) - rest));
}

// The pressure in each cell.
export function pressuresOf(tissue, points, { pressure }) {
  return areasOf(tissue, points).map((area) => pressure / Math.max(area, LEAST_AREA));
}

function areasOf({ corners, following, cellOf, cells }, { x, y }) {
  const areas = new Float64Array(cells);
  for (let i = 0; i < corners.length; i++) {
    const a = corners[i], b = following[i];
    areas[cellOf[i]] += (x[b] * y[a] - x[a] * y[b]) / 2;
  }
  return areas;
}

function forceOn({ from, to, corners, following, cellOf }, { x, y }, room, { stiffness, rest, pressure }) {
  const across = new Float64Array(x.length), up = new Float64Array(x.length);
  for (let i = 0; i < from.length; i++) {
    const a = from[i], b = to[i], dx = x[b] - x[a], dy = y[b] - y[a];
    const pull = stiffness * (1 - rest / Math.max(Math.sqrt(dx * dx + dy * dy), LEAST_LENGTH));
    across[a] += pull * dx;
    up[a] += pull * dy;
    across[b] -= pull * dx;
    up[b] -= pull * dy;
  }
  for (let i = 0; i < corners.length; i++) {
    const a = corners[i], b = following[i], push = pressure / Math.max(room[cellOf[i]], LEAST_AREA) / 2;
    const outX = push * (y[a] - y[b]), outY = push * (x[b] - x[a]);
    across[a] += outX;
    up[a] += outY;
    across[b] += outX;
    up[b] += outY;
  }
  return { across, up };
}

// A relaxation from some points on; `next` is an iteration. It has { x, y, iteration, farthest: how far a point moved, end }, where
// `end` is "" while points move, then "rest", "unsettled" or "blown up".
export function relaxation(tissue, points, forces, atRest = AT_REST) {
  const n = points.x.length, speeds = { x: new Float64Array(n), y: new Float64Array(n) };
  const now = { x: points.x, y: points.y, iteration: 0, farthest: Infinity, end: "" };
  let room = areasOf(tissue, points);

  function moved(push, pace) {
    const x = new Float64Array(n), y = new Float64Array(n);
    for (let i = 0; i < n; i++) {
      x[i] = now.x[i] + (speeds.x[i] + push.across[i] * pace) * pace;
      y[i] = now.y[i] + (speeds.y[i] + push.up[i] * pace) * pace;
    }
    return { x, y };
  }

  // A time step short enough that no cell loses more than half of its area.
  function integrated(push) {
    for (let pace = TIME_STEP; ; pace /= 2) {
      const there = moved(push, pace), left = areasOf(tissue, there);
      if (pace < SHORTEST_TIME_STEP || !isCollapsing(room, left)) return { there, left, pace };
    }
  }

  function next() {
    if (now.end) return now;
    const push = forceOn(tissue, now, room, forces);
    for (let i = 0; i < n; i++) {
      push.across[i] -= forces.damping * speeds.x[i];
      push.up[i] -= forces.damping * speeds.y[i];
    }
    const { there, left, pace } = integrated(push);
    let farthest = 0, outermost = 0;
    for (let i = 0; i < n; i++) {
      speeds.x[i] += push.across[i] * pace;
      speeds.y[i] += push.up[i] * pace;
      farthest = Math.max(farthest, Math.abs(there.x[i] - now.x[i]), Math.abs(there.y[i] - now.y[i]),
        Math.abs(push.across[i]) * TIME_STEP ** 2, Math.abs(push.up[i]) * TIME_STEP ** 2);
      outermost = Math.max(outermost, Math.abs(there.x[i]), Math.abs(there.y[i]));
    }
    if (!(outermost < FARTHEST)) return Object.assign(now, { end: "blown up" });
    room = left;
    Object.assign(now, there, { iteration: now.iteration + 1, farthest });
    now.end = farthest < atRest ? "rest" : now.iteration >= MOST_ITERATIONS ? "unsettled" : "";
    return now;
  }

  return { now, next };
}

function isCollapsing(room, left) {
  for (let cell = 0; cell < room.length; cell++) if (!(left[cell] > room[cell] / 2 || room[cell] < LEAST_AREA)) return true;
  return false;
}

// A book under other forces: its maps are relaxed here one after another, as long as there is time. Its settings are texts.
export function relaxedBook(data, settings, forces, milliseconds) {
  const begun = performance.now(), maps = [];
  let ended = "";
  for (let step = 0; step <= data.steps && !ended; step++) {
    const book = { data: { ...data, maps: [...maps, data.maps[step]] } };
    const way = relaxation(tissueOf(book, step), startOf(book, step), forces, SURELY_AT_REST);
    let iterations = 0; // after which points are nearly at rest, as where they are watched
    while (!way.now.end && performance.now() - begun < milliseconds) {
      way.next();
      if (!iterations && way.now.farthest < AT_REST) iterations = way.now.iteration;
    }
    const { x, y, end } = way.now;
    if (!end || end === "blown up") ended = ENDS[end](step);
    else maps.push({ ...data.maps[step], points: Array.from(x).flatMap((place, i) => [place, y[i]]), iterations: iterations || way.now.iteration, settled: end === "rest" });
  }
  if (!maps.length) return { mistake: { message: ended, hint: "" } };
  return { book: { ...data, settings, forces, maps, steps: maps.length - 1, end: ended || data.end } };
}

const ENDS = {
  "": (step) => `The panel ends at step ${step - 1}: step ${step} takes long to come to rest under these forces.`,
  "blown up": (step) => `The panel ends at step ${step - 1}: at step ${step} the relaxation blows up under these forces; make stiffness or pressure smaller, or damping nearer to 1.`,
};
