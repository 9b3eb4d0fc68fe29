// The walk: the turtle obeys the word command by command, by a slider, by keys, or by itself; the pile of the turtles that wait.
//
// Where it is, is what is traced: whatever is clicked in the drawing or in the word is where the walk goes on.

import { grouped, times } from "../books/numbers.js";
import { degreesOf, directionOf, paintWalk, stanceOf, turnBefore, waitingAt, walkOf } from "../drawing/walking.js";
import { placed, traced } from "../drawing/turtle.js";
import { button, drawn, face, list, made, slider, worded } from "./controls.js";
import { roving } from "./folding.js";

const PACES = ["0.5", "1", "2", "3", "5", "10", "20", "50", "100"]; // commands a second
const GLIDING = 10; // commands a second up to which the turtle is seen on its way
const LONGEST = 20_000; // commands that can be walked
const CARD = 24, MOST_CARDS = 6; // pixels of a card of the pile
const CLOSE = 1e-9;
const MOST_ORDERS = 6; // that can be chosen for a stride

// `seen` says what there is: { book, step, angle, traced }; `sentence` is where a panel says what is traced; `trace` traces a module of
// a step, and `light` shows it again.
export function walkView(view, sentence, seen, trace, light) {
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let known = null, shown = "", fault = "", walk = null, pace = 2, frame = 0, share = 1, begun = 0, from = 0, stride = "command";
  const bar = slider("command", worded("how many commands of the word the turtle has obeyed"), ["0"], 0, (at) => stopAt(at), worded("command"));
  const speed = slider("pace", worded("commands a second, when it walks by itself"), PACES, 2, (at) => {
    pace = Number(PACES[at]);
    if (frame) start();
  }, worded("pace"));
  const play = button("play", worded("let the turtle walk"), toggle, { class: "lsys-button lsys-play" });
  const strides = list("stride", worded("how far it goes at once: to the end of a branch, or of one of this order"), [], stride, (each) => {
    stride = each;
    if (frame) start();
  }, worded("stride"));
  const player = made("div.lsys-player", { role: "toolbar", "aria-label": worded("walk") },
    button("first", worded("to the beginning of the word"), () => stopAt(0)), button("back", worded("one stride back"), () => one(-1)), play,
    button("forward", worded("one stride on"), () => one(1)));
  const said = made("div.lsys-caption", { role: "status", style: "min-height: 2.9em" }), pile = drawn("svg", { width: 220, role: "img" });
  const parts = [made("div.lsys-controls", player, bar.element, strides.element, speed.element), said, pile];
  const buttons = roving(player);

  // What there is, and how many commands are obeyed.
  function present() {
    const { book, traced: there, ...rest } = seen(), step = Math.min(rest.step, book.steps);
    return { ...rest, book, step, at: there?.step === step ? there.position + 1 : 0 };
  }

  const goTo = (at) => trace(present().step, Math.min(walk?.last ?? 0, at) - 1, 0, view);

  function stopAt(at) {
    stop();
    goTo(Math.max(0, at));
  }

  function one(way) {
    stopAt(strideFrom(present().at, way));
  }

  // Where a stride ends: after a command, after one that lets a turtle wait or is its return, or where a branch is done, perhaps of an order.
  function strideFrom(at, way) {
    const { stops, last } = walk ?? { stops: [], last: 0 }, waits = (stop) => stops[stop].waiting?.number ?? 0, order = Number(stride);
    const ends = { command: () => true, bracket: (stop) => stops[stop].waiting !== stops[stop - 1].waiting, branch: (stop) => waits(stop) < waits(stop - 1) }[stride]
      ?? ((stop) => waits(stop) < order && waits(stop - 1) >= order);
    for (let next = at + way; next > 0 && next < last; next += way) if (ends(next)) return next;
    return way > 0 ? last : 0;
  }

  function toggle() {
    if (frame) return stop();
    if (!walk) return;
    if (present().at >= walk.last) goTo(0);
    start();
  }

  function start() {
    [begun, from] = [performance.now(), present().at];
    face(play, "pause", worded("pause"));
    said.setAttribute("aria-live", "off");
    frame ||= requestAnimationFrame(run);
  }

  function run(time) {
    frame = requestAnimationFrame(run);
    const gone = (Math.max(0, time - begun) / 1000) * pace, way = from + gone, at = Math.min(walk.last, Math.floor(way) + 1);
    if (stride !== "command") return gone >= 1 && goOn(time);
    share = still.matches || pace > GLIDING ? 1 : Math.min(1, way - at + 1);
    if (at !== present().at) goTo(at);
    else if (share < 1) light();
    if (way >= walk.last) stop();
  }

  // A stride of several commands is gone at once.
  function goOn(time) {
    [begun, share] = [time, 1];
    goTo(strideFrom(present().at, 1));
    if (present().at >= walk.last) stop();
  }

  function stop() {
    share = 1;
    if (!frame) return;
    cancelAnimationFrame(frame);
    frame = 0;
    said.setAttribute("aria-live", "polite");
    face(play, "play", worded("let the turtle walk"));
    light();
  }

  function show() {
    const { book, step, at, angle } = present(), isOther = book !== known || step !== walk?.step;
    sentence.setAttribute("aria-live", view.open ? "off" : "polite"); // what is told of the command is enough
    if (isOther || !view.open) stop();
    if (!view.open || (!isOther && shown === `${at} ${angle}`)) return;
    if (!said.isConnected) view.body.prepend(made("div", ...parts)); // it is opened for the first time; what is traced is told below all of them
    shown = `${at} ${angle}`;
    if (isOther) {
      [known, walk, fault] = [book, null, worded("The word of step {step} is too long to be walked; go back to an earlier step.", { step })];
      try {
        if (book.length(step) <= LONGEST) walk = walkOf(book, step);
      } catch (error) {
        fault = error.message;
      }
      bar.offer(times((walk?.last ?? 0) + 1, String), walk ? at : 0);
      const orders = times(Math.min(MOST_ORDERS, walk?.deepest ?? 0), (i) => [String(i + 1), worded("order {order}", { order: i + 1 })]);
      if (!orders.length || Number(stride) > orders.length) stride = "command";
      strides.offer([["command", worded("command")], ["bracket", worded("bracket")], ["branch", worded("branch")], ...orders], stride);
    }
    bar.show(at);
    for (const each of [pile, strides.element]) each.toggleAttribute("hidden", !walk?.deepest);
    buttons.refresh();
    if (!walk) said.textContent = fault;
    else {
      said.textContent = toldAt(book, angle, at);
      showPile(book, angle, at);
    }
  }

  function showPile(book, angle, at) {
    const waiting = waitingAt(walk, at), rows = Math.min(MOST_CARDS, walk.deepest), shown = waiting.slice(0, waiting.length > rows ? rows - 1 : rows), hidden = waiting.length - shown.length;
    const label = waiting.length ? worded("The pile: {number} turtles wait, the last one on top", { number: waiting.length }) : worded("The pile: no turtle waits");
    pile.setAttribute("aria-label", label);
    pile.setAttribute("height", String(CARD * rows + 20));
    const text = (row, words) => drawn("text", { x: 62, y: CARD * row + 16, fill: "currentColor", "font-size": 12 }, words);
    const cards = shown.map((each, i) => {
      const row = rows - shown.length - (hidden ? 1 : 0) + i, way = book.data.mode === "plane" ? directionOf(book, angle, each.orientation) : 90;
      return drawn("g", drawn("rect", { x: 1, y: CARD * row + 1, width: 218, height: CARD - 2, rx: 4, fill: "none", stroke: "currentColor" }),
        drawn("text", { x: 10, y: CARD * row + 16, fill: "currentColor", "font-size": 12 }, String(each.number)),
        drawn("path", { d: "M9 0L-6 6L-3 0L-6 -6Z", transform: `translate(44 ${CARD * row + 12}) rotate(${-way})`, fill: "none", stroke: "currentColor", "stroke-dasharray": "3 2" }),
        text(row, worded("waits since command {number}", { number: grouped(each.place) })));
    });
    pile.replaceChildren(...cards, ...(hidden ? [text(rows - 1, worded("and {number} more", { number: hidden }))] : []),
      drawn("path", { d: `M0 ${CARD * rows + 2}H220`, stroke: "currentColor", "stroke-width": 2 }),
      drawn("text", { x: 110, y: CARD * rows + 16, fill: "currentColor", "font-size": 12, "text-anchor": "middle" }, worded("pile")));
  }

  // What the last command was, and where the turtle is now.
  function toldAt(book, angle, at) {
    const parts = [at ? worded("{at} of {all}, {letter}: {done}.", { at: grouped(at), all: grouped(walk.last), letter: book.label(book.word(walk.step)[at - 1]).text, done: doneAt(book, angle, at) })
      : worded("The turtle stands at the beginning of the word.")];
    const { place: [x, y], degrees } = stanceOf(book, walk.step, angle, walk.stops[at]), waiting = waitingAt(walk, at).length;
    if (degrees !== undefined) parts.push(worded("It is at ({x}, {y}) and looks towards {angle}°.", { x: short(x), y: short(y), angle: short(degrees + book.data.turtle.heading) }));
    if (at === walk.last && waiting) parts.push(worded("At the end {number} still wait: not every branch is closed.", { number: waiting }));
    return parts.join(" ");
  }

  function doneAt(book, angle, at) {
    const calls = book.data.turtle.calls[book.word(walk.step)[at - 1]], turn = turnBefore(book, walk, at, angle);
    const [from, to] = [at - 1, at].map((stop) => stanceOf(book, walk.step, angle, walk.stops[stop]).place), size = short(Math.hypot(...to.map((each, i) => each - from[i])));
    const number = (stop) => walk.stops[stop].waiting?.number ?? 0;
    const phrases = calls.map(([name, factor, addend]) => {
      if (name.startsWith("draw") && !/circle|disc|sphere|label|surface|box|patch/.test(name)) return worded("draws a stroke, {size} long", { size });
      if (name.startsWith("move")) return worded("goes ahead by {size} without drawing", { size });
      if (name === "push") return worded("lets turtle {number} wait here", { number: number(at) });
      if (name === "pop") return number(at - 1) ? worded("goes back to where turtle {number} waited", { number: number(at - 1) }) : worded("finds no turtle that waits, and stays");
      const turned = turn ?? { kind: name.startsWith("turn") ? "turn" : name, degrees: factor * angle + addend }, ways = WAYS[turned.kind]?.(degreesOf(turned));
      return ways?.[turned.degrees < -CLOSE ? 1 : 0] ?? worded("obeys: {command}", { command: name });
    });
    return phrases.length ? phrases.join(", ") : worded("is no command, and nothing happens");
  }

  // Paint the drawing with the turtle on it, unless the walk is closed, or the drawing is on its way to another step.
  function paint(pen, shapes, frame_, look) {
    const now = present();
    if (!view.open || !walk || now.book !== known || now.step !== walk.step || shapes !== placed(traced(now.book, now.step), now.angle)) return false;
    paintWalk(pen, shapes, frame_, look, { ...now, share: now.at ? share : 1 });
    return true;
  }

  return { show, paint, stop };
}

const WAYS = { // of positive and of negative turns
  turn: (angle) => [worded("turns left by {angle}°", { angle }), worded("turns right by {angle}°", { angle })],
  pitch: (angle) => [worded("lowers its head by {angle}°", { angle }), worded("lifts its head by {angle}°", { angle })],
  roll: (angle) => [worded("rolls to the left by {angle}°", { angle }), worded("rolls to the right by {angle}°", { angle })],
};

const short = (number) => Number(number.toFixed(2)) + 0; // no -0
