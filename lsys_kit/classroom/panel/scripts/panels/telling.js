// What a panel shows, told: in sentences, in what is lit where a module is traced, and as the line of code that makes it.

import { grouped, times } from "../books/numbers.js";
import { filamentLength } from "../drawing/filament.js";
import { wallsBeside } from "../drawing/map.js";
import { counted, sizeOf } from "../views/word.js";

const MOST_TOLD = 12; // of the modules that one becomes

// What is lit at a step when a module of some step is traced: a map from positions to "self", "mother" or "daughter".
export function litAt(book, traced, step) {
  const lit = new Map();
  if (!traced) return lit;
  if (step === traced.step) lit.set(traced.position, "self");
  if (step === traced.step - 1) {
    for (const each of originsOf(book, traced)) lit.set(book.mother(step + 1, each), "mother");
  }
  if (step === traced.step + 1) {
    const [from, to] = book.daughters(traced.step, traced.position) ?? [0, 0];
    for (let i = from; i < to; i++) lit.set(i, "daughter");
  }
  return lit;
}

// Where in the model's text the productions stand that made a module and that will replace it.
export function placesOf(book, traced) {
  if (!traced) return [];
  const numbers = new Set(originsOf(book, traced).map((each) => book.production(traced.step, each)));
  return [...numbers].flatMap((number) => book.data.productions[number]?.at ? [book.data.productions[number].at] : []);
}

// The modules of a step by whose mothers one was made: the module itself; of a wall that divides a cell the two beside it.
function originsOf(book, { step, position }) {
  if (!step) return [];
  if (book.mother(step, position) >= 0) return [position];
  return book.data.mode === "map" ? wallsBeside(book, step, position) : [];
}

const numbered = (number) => grouped(number + 1); // places are told from 1 on

// What a module is, where it came from and what it becomes, as a sentence.
export function told(book, { step, position }) {
  const { noun } = book.data, parts = book.data.mode === "tissue" ? partsOfCell : partsOfModule, { text, numbers } = book.label(book.word(step)[position]);
  const [origin, future] = parts(book, step, position), link = origin.startsWith("Mother: ") ? "." : "";
  return `${noun[0].toUpperCase()}${noun.slice(1)} ${numbered(position)} of step ${step}, ${text}${numbers}${link} ${origin}${future ? `; ${future}` : ""}.`;
}

function partsOfModule(book, step, position) {
  const text = (at, where) => book.label(book.word(at)[where]).text, mother = book.mother(step, position), range = book.daughters(step, position);
  const origin = !step ? "stands in the axiom"
    : mother < 0 ? `is new and divides a cell: ${halves(book, { step, position })}`
    : madeFrom(`${text(step - 1, mother)}, ${book.data.noun} ${numbered(mother)} of step ${step - 1}`, divided(book, step, mother), by(book, book.production(step, position)));
  if (!range) return [origin];
  const [from, to] = range, many = to - from, made = Array.from(book.word(step + 1).subarray(from, Math.min(to, from + MOST_TOLD)), (state) => book.label(state).text).join(" ");
  const becomes = many === 1 && book.production(step + 1, from) < 0 ? "stays as it is" : many ? `becomes ${made}${many > MOST_TOLD ? " …" : ""}` : "is gone";
  return [origin, `it ${becomes} at step ${step + 1}`];
}

const madeFrom = (before, isMother, how) => (isMother ? `Mother: ${before}; it divided ${how}` : `comes from ${before}, ${how}`);

// Whether there is more than one cell of a cell in the next word, which then has it as their mother.
function divided(book, step, mother) {
  const [from, to] = book.daughters(step - 1, mother);
  return book.data.noun === "cell" && to - from > 1;
}

// How a cell was and will be divided.
function partsOfCell(book, step, position) {
  const sisters = ([from, to]) => times(to - from, (i) => from + i), listed = (cells) => cells.map(numbered).join(" and ");
  const mother = book.mother(step, position), others = step ? sisters(book.daughters(step - 1, mother)).filter((each) => each !== position) : [];
  const before = `cell ${numbered(mother)} of step ${step - 1}`, range = book.daughters(step, position);
  const origin = !step ? "is there from the beginning"
    : others.length ? `Mother: ${before}, which was divided into this cell and cell ${listed(others)}` : `was ${before}, which was not divided`;
  if (!range) return [origin];
  const next = sisters(range);
  return [origin, `at step ${step + 1} it is ${next.length > 1 ? `divided into cells ${listed(next)}` : `cell ${listed(next)}, not divided`}`];
}

function halves(book, traced) {
  const { step } = traced, found = originsOf(book, traced).map((each) => {
    const mother = book.mother(step, each);
    return `${book.label(book.word(step - 1)[mother]).text}, wall ${numbered(mother)}`;
  });
  return `markers of ${found.join(", and ")} of step ${step - 1} match`;
}

function by(book, number) {
  return number < 0 ? "for which no production matches, so it stays" : `by production ${number + 1}, ${book.data.productions[number].text}`;
}

const rounded = (size, digits = 2) => Number((size + 1e-9).toFixed(digits));

// A step, its tokens where the stages are shown, and the width and height of its drawing and its strokes, if there are any.
export function caption(book, now, tokens, measured) {
  const stages = book.data.net.places, parts = [`step ${now}: ${sizeOf(book, now, measured?.strokes)}`];
  if (tokens && stages.length > 1) parts.push(`${stages.filter((each) => tokens[each.place] > 0).length} of ${counted(stages.length, "stage")} occupied`);
  if (changesNothing(book, now)) parts.push(book.data.chance && isAtRest(book, now) ? "nothing changes any more at this seed" : "this step changes nothing");
  if (book.data.mode === "filament") parts.push(`length ${rounded(filamentLength(book, now), 4)}`);
  if (measured?.size) parts.push(`width ${rounded(measured.size[0])}, height ${rounded(measured.size[1])}`);
  if (book.data.held?.[now]) parts.push(book.data.held[now]);
  if (book.data.said) parts.push(book.data.said);
  if (now === book.steps && book.data.end) parts.push(book.data.end);
  return parts.join("; ");
}

function changesNothing(book, now) {
  if (!now || ["map", "tissue"].includes(book.data.mode) || book.length(now) !== book.length(now - 1)) return false;
  const before = book.word(now - 1);
  return book.word(now).every((state, position) => state === before[position]);
}

// Whether no production was applied, so that none will be.
function isAtRest(book, now) {
  return times(book.length(now), (position) => book.production(now, position)).every((number) => number < 0);
}

// The line of code that makes a panel as it stands; `turns` says whether its angle has a slider.
export function code(seen, book, turns) {
  const { model, settings, step, angle, seed } = seen, { title, text, notation } = book.data, named = (name, value) => `${name}=${value}`;
  const reader = { map: "read_map", cellwork: "read_cellwork" }[notation], written = JSON.stringify;
  const first = title ? written(title) : reader ? `${reader}(${written(text)})` : `read(${written(text)}, ${written(notation)})`;
  const sliders = [...model.constants.map((each) => each.name), ...(turns ? ["angle"] : []), ...(model.chance ? ["seed"] : [])];
  const more = [
    seen.letters?.length && named("letters", written(seen.letters)), angle !== model.angle && named("angle", angle), seed && named("seed", seed), model.without?.length && named("sliders", written(sliders)),
    model.unfold && named("unfold", model.unfold === true ? "True" : written(model.unfold)), model.show && named("show", written(model.show)),
    ...model.constants.map(({ name, texts, index }) => settings[name] !== texts[index]
      && named(name, /^[-\d.]+$/.test(settings[name]) ? settings[name] : written(settings[name]))),
  ];
  return `explore(${[first, step, ...more.filter(Boolean)].join(", ")})`;
}
