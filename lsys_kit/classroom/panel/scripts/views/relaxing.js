// The relaxation of a step, watched iteration by iteration: the controls of it, and what is to be painted.

import { mapShapes, movedShapes, UNIT } from "../drawing/map.js";
import { boundsOf } from "../drawing/projection.js";
import { relaxation, startOf, tissueOf } from "../drawing/relaxation.js";
import { forcesOf, PULL, PUSH, strongest } from "../drawing/tension.js";
import { button, drawn, face, list, made } from "./controls.js";
import { roving } from "./folding.js";
import { counted } from "./word.js";

const SPEEDS = [["1", "slow"], ["4", "normal"], ["20", "fast"]]; // iterations a frame
const STILLS = 8, STILL = 1000; // with reduced motion so many stills, each shown for so many milliseconds

// `changed` is called when the picture is another.
export function relaxing(changed) {
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let book, shownBook, step = 0, way = null, timer = 0, frame = 0, perFrame = 4, room = null, most = 0;
  const first = button("first", "iteration 0 of the relaxation", () => { stop(); restart(); });
  const play = button("play", "play the relaxation", toggle, { class: "lsys-button lsys-play" });
  const forward = button("forward", "one iteration on", () => { stop(); advance(1); });
  const end = button("to rest", "show the map at rest", () => { stop(); leave(); });
  const speed = list("relaxation", "how fast the relaxation is shown", SPEEDS, "4", (value) => { perFrame = Number(value); });
  const forces = made("input", { type: "checkbox", "data-control": "forces", onchange: () => { legend.hidden = !forces.checked; changed(); } });
  const said = made("span.lsys-relaxed", { role: "status" }), legend = made("div.lsys-caption", { hidden: true });
  const player = made("div.lsys-player", first, play, forward, end);
  const element = made("div", made("div.lsys-controls.lsys-relaxation", { role: "group", "aria-label": "relaxation" },
    made("label.lsys-check", forces, "forces"), speed.element, player, said), legend);
  roving(player);

  function offer(next) {
    stop();
    [book, way] = [next, null];
    element.hidden = book.data.mode !== "map";
  }

  // Another step is shown: at rest at first.
  function goTo(at) {
    if (at === step && book === shownBook) return;
    [step, shownBook, way] = [at, book, null];
    stop();
    [room, most] = [boundsOf(mapShapes(book, step)), strongest(forcesNow().tensions)];
    tell();
  }

  const now = () => way?.now ?? split(book.data.maps[step].points);
  const forcesNow = () => forcesOf(tissueOf(book, step), now(), book.data.forces);

  function restart() {
    forces.checked = true;
    legend.hidden = false;
    way = relaxation(tissueOf(book, step), startOf(book, step), book.data.forces);
    shown();
  }

  function leave() {
    way = null;
    shown();
  }

  function advance(iterations) {
    if (!way) restart();
    for (let i = 0; i < iterations && !way.now.end; i++) way.next();
    if (way.now.end) stop();
    shown();
  }

  // The room grows with what overshoots, and does not shrink, so that nothing jumps; so does the scale of forces.
  function shown() {
    if (way) [room, most] = [around(room, boundsOf(shapes())), Math.max(most, strongest(forcesNow().tensions))];
    tell();
    changed();
  }

  const shapes = () => (way && way.now.end !== "rest" ? movedShapes(book, step, way.now) : null) ?? mapShapes(book, step);

  function tell() {
    const page = book.data.maps[step], { iteration, farthest, end: ended } = way?.now ?? { iteration: page.iterations, end: page.settled ? "rest" : "unsettled" };
    said.textContent = (SAID[ended] ?? SAID[""])(iteration, farthest);
    legend.replaceChildren(sample(PULL, ""), ` pulls, at most with ${strongest(forcesNow().tensions).toPrecision(2)}; `, sample(PUSH, "6 4"), " pushes; arrows: the pressure on a wall, or the difference of two");
  }

  function toggle() {
    if (timer || frame) return stop();
    if (!way || way.now.end) restart();
    said.setAttribute("aria-live", "off");
    face(play, "pause", "pause the relaxation");
    if (still.matches) timer = setInterval(() => advance(Math.ceil(book.data.maps[step].iterations / STILLS)), STILL);
    else frame = requestAnimationFrame(run);
  }

  function run() {
    frame = requestAnimationFrame(run);
    advance(perFrame);
  }

  function stop() {
    if (!timer && !frame) return;
    clearInterval(timer);
    cancelAnimationFrame(frame);
    [timer, frame] = [0, 0];
    said.setAttribute("aria-live", "polite");
    face(play, "play", "play the relaxation");
  }

  return {
    element, offer, goTo, stop,
    watched: () => way !== null,
    shapes, room: () => room,
    forces: () => (forces.checked ? { ...forcesNow(), most, unit: UNIT } : null),
  };
}

const SAID = {
  "": (iteration, farthest) => `iteration ${iteration.toLocaleString("en")}${Number.isFinite(farthest) ? `: a vertex moved by ${farthest.toPrecision(2)}` : ""}`,
  rest: (iteration) => `at rest after ${counted(iteration, "iteration")}`,
  unsettled: (iteration) => `does not settle: still moving after ${counted(iteration, "iteration")}`,
  "blown up": (iteration) => `blows up after ${counted(iteration, "iteration")}: the vertices fly apart`,
};

const split = (points) => ({ x: points.filter((_, i) => i % 2 === 0), y: points.filter((_, i) => i % 2) });

// The least room around two others.
function around(one, other) {
  const sides = [0, 1].map((axis) => {
    const half = axis ? "up" : "across";
    return [Math.min(one.middle[axis] - one[half], other.middle[axis] - other[half]), Math.max(one.middle[axis] + one[half], other.middle[axis] + other[half])];
  });
  const [across, up] = sides.map(([least, most]) => (most - least) / 2);
  return { ...one, middle: sides.map(([least, most]) => (least + most) / 2), across, up };
}

function sample(colour, dashes) {
  const line = drawn("line", { x1: 1, x2: 23, y1: 4, y2: 4, stroke: colour, "stroke-width": 4, "stroke-dasharray": dashes });
  return drawn("svg", { viewBox: "0 0 24 8", width: 24, height: 8, "aria-hidden": "true" }, line);
}
