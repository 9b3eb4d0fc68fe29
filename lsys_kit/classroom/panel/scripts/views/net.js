// The stage diagram: places with tokens, bars, arcs. A place can be chosen, by mouse and by keyboard.

import { grouped } from "../books/numbers.js";
import { fillColour, lineColour } from "../drawing/colours.js";
import { drawn, onKey, onMouse } from "./controls.js";
import { roving } from "./folding.js";

const TERMS = 0.82, LABELS = 0.65; // where there is room, a diagram is no smaller: its smallest text is 9 pixels high then
const TINY = 0.4; // of a diagram that is smaller no stage can be hit
const DOTS = [[], [[0, 0]], [[-5, 0], [5, 0]], [[0, -5.5], [-5, 3.5], [5, 3.5]], [[-5, -5], [5, -5], [-5, 5], [5, 5]]];

// `chosen` learns of the place that was clicked, `pointed` of the one that the mouse is on, or of -1; `enlarge` is called where
// the diagram itself is clicked, which is shown whole, however small that is.
export function netView(parent, chosen, pointed, enlarge) {
  let net, places = new Map();

  function open(next, theme) {
    net = next;
    places = new Map();
    const { width, height } = net, sheet = drawn("svg.lsys-net", {
      viewBox: `0 0 ${width} ${height}`, width, height, role: "group", "aria-label": net.description,
    });
    parent.closest(".lsys-views").style.setProperty("--lsys-needed", `${Math.round(leastScale(net) * width)}px`);
    for (const place of net.places) sheet.append(stage(place, theme));
    for (const arc of net.arcs) sheet.append(
      drawn("path.lsys-band", { d: arc.band }), drawn("path.lsys-arc", { d: arc.path }), drawn("path.lsys-head", { d: arc.head }));
    for (const { x, y, half, line, terms, full, tx, ty } of net.bars) {
      const d = `M${x - 1.8} ${y - half}h3.6v${2 * half}h-3.6zm0 ${half}l-8.5-3.4v6.8z`;
      sheet.append(drawn("g.lsys-bar-of", drawn("path.lsys-arc", { d: line }), drawn("path.lsys-head", { d }),
        terms ? drawn("text.lsys-terms", { x: tx, y: ty }, drawn("title", full || terms), terms) : ""));
    }
    for (const [x, y, wide, text] of net.notes) sheet.append(
      drawn("rect.lsys-band-note", { x: x - wide / 2, y: y - 6, width: wide, height: 12 }),
      drawn("text.lsys-terms", { x, y: y + 4, "text-anchor": "middle" }, text));
    for (const line of net.footnotes) sheet.append(drawn("text.lsys-terms", { x: line.x, y: line.y }, line.text));
    const { press } = roving(sheet, ".lsys-stage"), under = (event) => Number(event.target.closest(".lsys-stage")?.dataset.place ?? -1);
    sheet.addEventListener("click", (event) => {
      const tiny = sheet.getBoundingClientRect().width < TINY * width;
      under(event) < 0 || (tiny && event.detail) ? enlarge() : chosen(under(event));
    });
    onKey(sheet, (event) => {
      if (event.key !== "Enter" && event.key !== " ") return press(event);
      event.preventDefault();
      chosen(under(event));
    });
    parent.replaceChildren(sheet);
  }

  function stage(place, theme) {
    const { x, y } = place, { radius } = net;
    const ring = drawn("circle.lsys-ring", { cx: x, cy: y, r: radius + 5 });
    const circle = drawn("circle.lsys-place", {
      cx: x, cy: y, r: radius, fill: fillColour(place.colour, theme, place.strength), stroke: lineColour(place.colour, theme),
    });
    const label = drawn("text.lsys-label", { x, y: y + radius + 17, "text-anchor": "middle" }, ...tspans(place));
    const tokens = drawn("g.lsys-tokens");
    const group = drawn("g.lsys-stage", { "data-place": place.place, role: "button", tabindex: -1, "aria-pressed": "false" },
      drawn("title", place.name), ring, circle, label, tokens);
    onMouse(group, (event) => pointed(event ? place.place : -1));
    places.set(place.place, { group, tokens, place, shown: -1 });
    return group;
  }

  function fill(counts) {
    for (const [number, entry] of places) {
      const count = counts[number];
      if (entry.shown === count) continue;
      entry.shown = count;
      entry.tokens.replaceChildren(...tokensAt(entry.place, count));
      entry.group.setAttribute("aria-label", `stage ${entry.place.name}, ${grouped(count)} token${count === 1 ? "" : "s"}`);
    }
  }

  function light(marked, lit, under) {
    for (const [number, { group }] of places) {
      group.setAttribute("aria-pressed", String(number === marked));
      group.classList.toggle("lsys-lit", lit.has(number) || number === under);
    }
  }

  return { open, fill, light };
}

function leastScale({ places, bars, notes, footnotes }) {
  return notes.length || footnotes.length || [...bars, ...places].some((each) => each.terms || each.subscript) ? TERMS : LABELS;
}

function tspans({ letter, subscript, values }) {
  const parts = [drawn("tspan", /^\p{L}/u.test(letter) ? { "font-style": "italic" } : {}, letter)];
  if (subscript) parts.push(drawn("tspan", { dy: 3, "font-size": "70%" }, subscript));
  if (values) parts.push(drawn("tspan", subscript ? { dy: -3 } : {}, values));
  return parts;
}

function tokensAt({ x, y }, count) {
  if (count < 5) return DOTS[count].map(([dx, dy]) => drawn("circle", { cx: x + dx, cy: y + dy, r: 3.6 }));
  const text = short(count), size = [15, 15, 15, 13, 11][text.length] ?? 10;
  return [drawn("text", { x, y: y + 0.36 * size, "font-size": size, "font-weight": "bold", "text-anchor": "middle" }, text)];
}

export function short(count) {
  if (count < 10_000) return String(count);
  for (const [size, letter] of /** @type {[number, string][]} */ ([[1e9, "G"], [1e6, "M"], [1e3, "k"]])) {
    if (count >= size) return `${(count / size).toPrecision(count / size < 10 ? 2 : 3).replace(/\.0$/, "")}${letter}`;
  }
  return String(count);
}
