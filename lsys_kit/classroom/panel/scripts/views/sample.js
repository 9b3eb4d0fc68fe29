// The sample: plants of the seeds 0, 1, 2, ... one by one, and what is counted of them as a histogram that grows bar by bar; with their mean, how
// far it may be off, and on demand what is exact, and which throw came first.

import { openBook } from "../books/book.js";
import { exactMean, exactShares, firstThrow } from "../books/chance.js";
import { grouped, times } from "../books/numbers.js";
import { paintTile } from "../drawing/gallery.js";
import { button, drawn, list, made, worded } from "./controls.js";
import { roving } from "./folding.js";

const MOST = 5_000, TILES = 6, BARS = 24; // plants, of which the last ones are drawn, and bars at most
const PAUSE = 150, EAGER = 40; // milliseconds between two plants; later there are more at a time: one for every so many that stand there
const WIDTH = 420, HEIGHT = 220, LEFT = 40, RIGHT = 20, TOP = 26, BOTTOM = 42; // pixels
const NEARLY = 0.0005; // of all plants, beyond which an end of the exact distribution is not shown
const SURE = 1.96; // deviations between which 19 of 20 means lie
const COLOURS = ["#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9"]; // of the first throw

// `seen` says what there is: { book, step, angle, asked, theme, sow(seed), sown(seed) }, the last one with a promise of a book.
export function sampleView(view, seen) {
  let plants = [], key = "", known = null, counted = "", timer = 0, going = 0, exact = null;
  const one = (many, text, hint) => button(text, hint, () => { stop(); more(many); });
  const run = button(worded("until I stop"), worded("plant after plant, until it is stopped"), toggle);
  const player = made("div.lsys-player", { role: "toolbar", "aria-label": worded("sample") }, one(1, worded("one more"), worded("one more plant")),
    one(10, worded("ten more"), worded("ten more plants")), run, button(worded("clear"), worded("begin again without a plant"), () => { stop(); begin(0); }));
  const what = list("counted", worded("what is counted"), [["", ""]], "", (name) => { counted = name; draw(); }, worded("count"));
  const switched = (text, hint) => {
    const element = button(text, hint, () => {
      element.setAttribute("aria-pressed", String(element.getAttribute("aria-pressed") !== "true"));
      draw();
    }, { "aria-pressed": "false" });
    return element;
  };
  const truth = switched(worded("exact"), worded("the exact mean and the exact distribution")), first = switched(worded("first throw"), worded("colour the plants by what was thrown first"));
  const isOn = (element) => !element.hidden && element.getAttribute("aria-pressed") === "true";
  const said = made("div.lsys-caption", { role: "status" }), chart = drawn("svg.lsys-counts", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" }), legend = made("div.lsys-caption");
  const tiles = times(TILES, () => {
    const canvas = made("canvas.lsys-tile", { "aria-hidden": "true", style: "height: 110px" }), label = made("span");
    return { canvas, label, element: made("button.lsys-button.lsys-tile-button", { type: "button", hidden: true, onclick: (event) => seen().sow(Number(event.currentTarget.value)) }, canvas, label) };
  });
  const sheet = made("div.lsys-gallery", { role: "group", "aria-label": worded("the last plants"), style: "flex: 1 1 240px; grid-template-columns: repeat(3, minmax(0, 1fr)); align-content: start" }, ...tiles.map(({ element }) => element));
  const parts = [made("div.lsys-controls", player, what.element, truth, first), said, made("div", { style: "display: flex; flex-wrap: wrap; gap: 8px 24px" }, sheet, made("div", { style: "flex: 2 1 300px" }, chart, legend))];
  roving(player);
  const ofTiles = roving(sheet);

  function show() {
    if (!view.open) return stop();
    const { book, step, asked } = seen(), now = Math.min(step, book.steps), next = JSON.stringify([asked.constants, now, book.data.text]);
    if (!said.isConnected) view.body.prepend(...parts); // it is opened for the first time
    if (key === next) return;
    const names = book.data.symbols.flatMap((symbol) => (symbol[3] ? [] : [[named(symbol), named(symbol)]]));
    const { noun } = book.data, again = known?.text === book.data.text && book.data.choices ? plants.length : 0;
    [key, known] = [next, book.data];
    if (!names.some(([name]) => name === counted)) counted = names[0]?.[0] ?? "";
    what.offer([...names, ["", `${noun}s`]], counted);
    for (const each of [truth, first]) each.hidden = !book.data.choices;
    begin(again);
  }

  function begin(many) {
    [plants, exact] = [[], null];
    for (const { element } of tiles) element.hidden = true;
    draw();
    more(many);
  }

  async function more(many) {
    const asked = key, number = ++going, { book } = seen(), step = Math.min(seen().step, book.steps);
    for (let i = 0; i < many && plants.length < MOST; i++) {
      const seed = plants.length, answer = known.choices ? { book: openBook({ ...known, seed, steps: step }) } : await seen().sown(seed);
      if (key !== asked || number !== going || seed !== plants.length) return;
      if (answer.mistake) return tell(answer.mistake.message);
      plants.push(measured(answer.book, step, seed));
      if (many - i <= TILES) paintPlant(answer.book, step, seed);
    }
    draw();
  }

  // How often each symbol occurs in a plant, at its last step where it has fewer; what was thrown first; and its seed.
  function measured(book, step, seed) {
    const found = new Map([["", 0]]), { states, symbols, choices } = book.data, add = (name, count) => found.set(name, (found.get(name) ?? 0) + count);
    book.counts(Math.min(step, book.steps)).forEach((count, state) => {
      add("", count);
      add(named(symbols[states[state][0]]), count);
    });
    return { seed, found, first: choices ? firstThrow(book) : -1 };
  }

  function paintPlant(book, step, seed) {
    const { canvas, label, element } = tiles[seed % TILES], { angle, around, above, theme } = seen();
    [element.hidden, element.value, label.textContent] = [false, seed, worded("seed {seed}", { seed })];
    for (const each of tiles) each.element.style.order = (seed - Number(each.element.value)); // the last one in front
    element.title = worded("show this plant");
    paintTile(canvas, book, { step: Math.min(step, book.steps), angle, around, above }, { theme });
    ofTiles.refresh();
  }

  function toggle() {
    if (timer) return stop();
    run.textContent = worded("stop");
    said.setAttribute("aria-live", "off");
    timer = setInterval(async () => {
      await more(1 + Math.floor(plants.length / EAGER));
      if (plants.length >= MOST) stop();
    }, PAUSE);
  }

  function stop() {
    if (!timer) return;
    clearInterval(timer);
    timer = 0;
    said.setAttribute("aria-live", "polite");
    run.textContent = worded("until I stop");
  }

  const tell = (text) => {
    stop();
    said.textContent = text;
  };

  // What is exact of what is counted: { mean, shares }, or null where chance does not decide alone.
  function truthOf(step) {
    if (!known.choices) return null;
    const is = (state) => counted === "" || named(known.symbols[known.states[state][0]]) === counted, asked = `${key} ${counted}`;
    if (exact?.asked !== asked) exact = { asked, mean: exactMean(known, is, step), shares: exactShares(known, is, step) };
    return exact;
  }

  function draw() {
    const { book, step } = seen(), now = Math.min(step, book.steps), numbers = plants.map(({ found }) => found.get(counted) ?? 0), law = truthOf(now), many = numbers.length;
    const mean = many && numbers.reduce((sum, each) => sum + each, 0) / many, spread = many > 1 ? Math.sqrt(numbers.reduce((sum, each) => sum + (each - mean) ** 2, 0) / (many - 1)) : NaN;
    const off = (SURE * spread) / Math.sqrt(many), bars = barsOf(numbers, law?.shares), shown = isOn(truth) ? law : null;
    said.textContent = told(numbers, mean, off, now, shown);
    const groups = isOn(first) ? [...new Set(plants.map((each) => each.first))].sort((a, b) => a - b) : [null];
    paintChart(bars, groups, mean, off, shown, many);
    legend.replaceChildren(...(isOn(first) ? groups.map((each, i) => legendOf(each, i, numbers)) : []));
  }

  function told(numbers, mean, off, step, law) {
    const many = numbers.length, parts = [], none = numbers.filter((each) => !each).length, name = what.select.selectedOptions[0].textContent;
    if (!many) parts.push(worded("No plant has been thrown yet. How many {name} will it have at step {step}?", { name, step }));
    else parts.push(worded("Plants at step {step}: {many}. Number of {name}: on average {mean}, from {least} to {most}.", { many: grouped(many), step, name, mean: short(mean), least: grouped(Math.min(...numbers)), most: grouped(Math.max(...numbers)) }));
    if (off >= 0 && many > 9) parts.push(worded("The mean of all plants lies between {low} and {high}, 19 times in 20.", { low: short(mean - off), high: short(mean + off) }));
    if (none) parts.push(worded("None at all: {none} of {many}.", { none: grouped(none), many: grouped(many) }));
    if (law) parts.push(worded("Exactly: {mean} on average.", { mean: short(law.mean) }));
    if (law?.shares?.[0]) parts.push(worded("Exactly {share} of 100 have none.", { share: short(100 * law.shares[0]) }));
    return parts.join(" ");
  }

  function legendOf(production, number, numbers) {
    const own = numbers.filter((_, i) => plants[i].first === production), text = known.productions[production]?.text ?? worded("none");
    return made("div", made("span", { style: `background: ${COLOURS[number % COLOURS.length]}; display: inline-block; width: 10px; height: 10px; margin-right: 6px` }),
      worded("{text}, {many} times: on average {mean}", { text, many: grouped(own.length), mean: short(own.reduce((sum, each) => sum + each, 0) / own.length) }));
  }

  function paintChart({ low, wide, many: bars }, groups, mean, off, law, many) {
    const across = (value) => LEFT + ((WIDTH - LEFT - RIGHT) * (value - low)) / (bars * wide), barOf = (value) => Math.floor((value - low) / wide);
    const rows = groups.map(() => new Array(bars).fill(0)), expected = new Array(bars).fill(0);
    for (const { found, first: thrown } of plants) rows[Math.max(0, groups.indexOf(groups[0] === null ? null : thrown))][barOf(found.get(counted) ?? 0)] += 1;
    if (law?.shares) law.shares.forEach((share, value) => { if (barOf(value) in expected) expected[barOf(value)] += share * many; });
    const highest = Math.max(5, ...expected, ...times(bars, (i) => rows.reduce((sum, row) => sum + row[i], 0))), foot = HEIGHT - BOTTOM, up = (count) => foot - ((foot - TOP) * count) / highest;
    const middle = wide === 1 ? 0.5 : 0, under = new Array(bars).fill(0), text = (x, y, words, anchor = "middle") => drawn("text.lsys-terms", { x, y, "text-anchor": anchor }, words);
    const columns = rows.flatMap((row, k) => row.flatMap((count, i) => {
      if (!count) return [];
      const y = up((under[i] += count)), x = across(low + i * wide);
      return [drawn("rect", { x: x + 0.5, y, width: across(low + wide) - LEFT - 1, height: up(0) - up(count), fill: groups[k] === null ? "var(--lsys-accent)" : COLOURS[k % COLOURS.length] })];
    }));
    const line = (value, more) => drawn("path", { d: `M${across(value + middle)} ${TOP - 10}V${foot}`, stroke: "currentColor", fill: "none", ...more });
    const steps = expected.map((count, i) => `${i ? "L" : "M"}${across(low + i * wide)} ${up(count)}H${across(low + (i + 1) * wide)}`).join("");
    const apart = wide * Math.ceil(bars / 5), ticks = times(6, (i) => (Math.ceil(low / apart) + i) * apart).filter((value) => value + middle <= low + wide * bars);
    chart.replaceChildren(...columns,
      ...(law?.shares ? [drawn("path", { d: steps, fill: "none", stroke: "currentColor", "stroke-width": 1.5 })] : []),
      ...(off >= 0 ? [drawn("rect", { x: across(mean - off + middle), y: TOP - 16, width: Math.max(1, across(mean + off) - across(mean - off)), height: 12, fill: "var(--lsys-lit)", opacity: 0.45 })] : []),
      ...(many ? [line(mean, { "stroke-width": 2, style: "color: var(--lsys-lit)" })] : []), ...(law ? [line(law.mean, { "stroke-dasharray": "4 3" })] : []),
      drawn("path.lsys-axis", { d: `M${LEFT} ${TOP}V${foot}H${WIDTH - RIGHT}` }),
      text(LEFT - 5, up(highest) + 4, grouped(Math.round(highest)), "end"), text(LEFT - 5, foot + 4, "0", "end"),
      ...(many ? [drawn("path", { d: `M${across((plants.at(-1).found.get(counted) ?? 0) + middle)} ${foot + 1}l-5 9h10z`, fill: "var(--lsys-lit)" })] : []), // where the last one fell
      ...ticks.map((value) => text(across(value + middle), foot + 22, grouped(value))),
      text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 4, worded("number of {name}", { name: what.select.selectedOptions[0].textContent })));
    chart.setAttribute("aria-label", said.textContent);
  }

  return { show, stop };
}

// From where on, how wide, and how many the bars are: of what was counted, and of what is likely.
function barsOf(numbers, shares) {
  const ends = shares ? likely(shares) : [0, 1], low = Math.min(...numbers, ends[0]), high = Math.max(...numbers, ends[1]), rough = (high - low + 1) / BARS;
  const power = 10 ** Math.floor(Math.log10(Math.max(1, rough))), wide = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= rough);
  const first = Math.floor(low / wide) * wide;
  return { low: first, wide, many: Math.floor((high - first) / wide) + 1 };
}

function likely(shares) {
  const ends = [shares, [...shares].reverse()].map((row) => {
    let sum = 0;
    return row.findIndex((share) => (sum += share) > NEARLY);
  });
  return [ends[0], shares.length - 1 - ends[1]];
}

const named = ([letter, subscript]) => letter + subscript; // the number of a symbol is another in another book
const short = (number) => Number(number.toPrecision(4)).toLocaleString("en");
