// The tokens of the stage diagram on their way from a step to the next: in the first half each runs to the bar of its production, and in the
// second half those that it becomes run along their arcs.

import { grouped } from "../books/numbers.js";
import { drawn } from "./controls.js";

const EDGE = 36; // pixels from the right edge where there is no room for a number
const NEAR = 3; // pixels by which the ends of lines lie beside what they join
const ways = new WeakMap();

// Show the tokens between a step and the next in the stage diagram of a part of the page, or where they lie, at 0.
export function runTokens(body, book, step, part) {
  const sheet = body.querySelector(".lsys-net"), old = sheet?.querySelector(".lsys-running");
  old?.remove();
  for (const each of sheet?.querySelectorAll(".lsys-stage .lsys-tokens") ?? []) each.style.visibility = part ? "hidden" : "";
  if (!sheet || !part) return;
  const half = Number(part >= 0.5), running = movesOf(book, step)[half].map(({ line, many, whole }) => {
    const { x, y } = line.getPointAtLength((whole ? part : 2 * part - half) * line.getTotalLength()), side = x > book.data.net.width - EDGE ? ["end", -7] : ["start", 7];
    return drawn("g", { transform: `translate(${x} ${y})` }, drawn("circle", { r: 4.5 }),
      ...(many > 1 ? [drawn("text", { x: side[1], y: -5, "text-anchor": side[0], "font-size": 12, "font-weight": "bold" }, grouped(many))] : []));
  });
  sheet.append(drawn("g.lsys-tokens.lsys-running", { "aria-hidden": "true" }, ...running));
}

// Of the tokens that go the same way, in the first half and in the second, the line along which they run, whether it is that of both halves, and
// how many they are.
function movesOf(book, step) {
  const known = ways.get(book);
  if (known?.step === step) return known.moves;
  const { states, net } = book.data, halves = [new Map(), new Map()], word = book.word(step), next = book.word(step + 1);
  const shown = new Set(net.places.map(({ place }) => place)), placeOf = (state) => (shown.has(states[state][2]) ? states[state][2] : -1);
  const add = (half, key, made) => {
    const found = halves[half].get(key) ?? { ...made(), many: 0 };
    found.many += 1;
    halves[half].set(key, found);
  };
  for (let at = 0; at < word.length; at++) {
    const [from, to] = book.daughters(step, at), mother = placeOf(word[at]), stays = to - from === 1 && word[at] === next[from];
    if (mother < 0) continue;
    const daughters = Array.from(next.subarray(from, to), placeOf).filter((place) => place >= 0), bar = stays ? null : barOf(net, mother, daughters);
    if (bar) add(0, `${net.bars.indexOf(bar)}`, () => ({ line: lineTo(net, bar, mother) }));
    for (const daughter of daughters) for (const half of bar ? [1] : [0, 1])
      add(half, `${net.bars.indexOf(bar)} ${mother} ${daughter}`, () => ({ line: lineFrom(net, bar, mother, daughter), whole: !bar }));
  }
  const moves = halves.map((each) => [...each.values()]);
  ways.set(book, { step, moves });
  return moves;
}

const path = (d) => drawn("path", { d });
const startOf = (d) => d.match(/^M([-\d.]+) ([-\d.]+)/).slice(1).map(Number);
const endOf = (d) => d.match(/([-\d.]+) ([-\d.]+)$/).slice(1).map(Number);
const placeAt = (net, number) => net.places.find(({ place }) => place === number);
const isAt = (net, { x, y }, [left, top]) => Math.hypot(left - x, top - y) < net.radius + NEAR;

const arcsOf = (net, { x, y, half }) => net.arcs.filter((arc) => {
  const [left, top] = startOf(arc.path);
  return Math.abs(left - x) < NEAR && Math.abs(top - y) <= half + NEAR;
});

// The bar behind a place from which arcs lead to all daughters, and to no other place.
function barOf(net, mother, daughters) {
  const place = placeAt(net, mother), bars = net.bars.filter((bar) => place && isAt(net, place, startOf(bar.line)));
  const leads = (bar, daughter) => arcsOf(net, bar).find((arc) => isAt(net, placeAt(net, daughter), endOf(arc.path)));
  const alike = bars.filter((bar) => daughters.every((daughter) => leads(bar, daughter)));
  return alike.find((bar) => arcsOf(net, bar).every((arc) => daughters.some((daughter) => isAt(net, placeAt(net, daughter), endOf(arc.path))))) ?? alike[0] ?? null;
}

function lineTo(net, { line }, mother) {
  const { x, y } = placeAt(net, mother);
  return path(`M${x} ${y}L${line.slice(1)}`);
}

function lineFrom(net, bar, mother, daughter) {
  const from = placeAt(net, mother), to = placeAt(net, daughter), arc = bar && arcsOf(net, bar).find((each) => isAt(net, to, endOf(each.path)));
  return path(`${arc ? arc.path : `M${from.x} ${from.y}`}L${to.x} ${to.y}`);
}
