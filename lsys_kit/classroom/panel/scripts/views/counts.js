// How many modules each step has, as a small plot; a click or the arrow keys go to a step.

import { clamped, grouped } from "../books/numbers.js";
import { drawn, made } from "./controls.js";
import { counted } from "./word.js";

const WIDTH = 380, HEIGHT = 150, LEFT = 52, RIGHT = 12, TOP = 14, BOTTOM = 24;
const STEEP = 50; // from this ratio of the greatest to the least on, the scale is logarithmic

export function countsView(parent, chosen) {
  let lengths = [], points = [], noun = "module", dot, said;

  function open(book) {
    lengths = book.lengths();
    noun = book.data.noun;
    const least = Math.max(1, Math.min(...lengths)), most = Math.max(1, ...lengths), steep = most / least > STEEP;
    const scaled = steep ? (n) => Math.log(Math.max(n, 1)) : (n) => n, low = steep ? scaled(least) : 0, high = scaled(most) || 1;
    const x = (step) => LEFT + ((WIDTH - LEFT - RIGHT) * step) / Math.max(1, lengths.length - 1);
    const y = (n) => HEIGHT - BOTTOM - ((HEIGHT - TOP - BOTTOM) * (scaled(n) - low)) / (high - low || 1);
    points = lengths.map((n, step) => [x(step), y(n)]);
    dot = drawn("circle.lsys-count-now", { r: 5 });
    said = drawn("text.lsys-terms", { "text-anchor": "middle" });
    const sheet = drawn("svg.lsys-counts", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", tabindex: 0 },
      drawn("path.lsys-axis", { d: `M${LEFT} ${TOP}V${HEIGHT - BOTTOM}H${WIDTH - RIGHT}` }),
      ...[least, most].filter((n, i) => i || most !== least).map((n) => drawn("text.lsys-terms", { x: LEFT - 6, y: y(n) + 4, "text-anchor": "end" }, grouped(n))),
      drawn("text.lsys-terms", { x: x(0), y: HEIGHT - 6, "text-anchor": "middle" }, "0"),
      drawn("text.lsys-terms", { x: x(lengths.length - 1), y: HEIGHT - 6, "text-anchor": "end" }, `step ${lengths.length - 1}`),
      drawn("path.lsys-curve", { d: "M" + points.map(([a, b]) => `${a.toFixed(1)} ${b.toFixed(1)}`).join("L") }),
      ...points.map(([cx, cy]) => drawn("circle.lsys-count", { cx, cy, r: 2.2 })), dot, said);
    const rate = book.data.growth?.rate;
    const told = `${noun[0].toUpperCase()}${noun.slice(1)}s a step${steep ? ", on a logarithmic scale" : ""}${rate ? `; growth rate ${rate}` : ""}`;
    sheet.setAttribute("aria-label", `${told}: ${lengths.slice(0, 12).map((n, step) => `step ${step}, ${n}`).join("; ")}`);
    sheet.addEventListener("click", (event) => {
      const box = sheet.getBoundingClientRect(), at = ((event.clientX - box.left) / box.width) * WIDTH;
      const share = (at - LEFT) / (WIDTH - LEFT - RIGHT);
      chosen(clamped(0, lengths.length - 1, Math.round(share * (lengths.length - 1))));
    });
    parent.replaceChildren(made("div.lsys-caption", told), sheet);
  }

  function show(step) {
    if (!points[step]) return;
    const [x, y] = points[step];
    dot.setAttribute("cx", x);
    dot.setAttribute("cy", y);
    said.setAttribute("x", clamped(LEFT + 40, WIDTH - 60, x));
    said.setAttribute("y", Math.max(12, y - 9));
    said.textContent = counted(lengths[step], noun);
  }

  return { open, show };
}
