// What all views are made of: elements, native controls with names (sliders with number boxes, buttons, lists), keys and the mouse,
// and texts in the language of a panel or page; in the scripts they stand in English, which is the id of their translation.

import { clamped } from "../books/numbers.js";
import { amongStops, stopsOf } from "./stops.js";

const words = {};

export const speak = (given) => Object.assign(words, given);

// A text with values in the place of its names in braces.
export function worded(text, values = {}) {
  return (words[text] ?? text).replace(/\{(\w+)\}/g, (_, name) => values[name]);
}

const handlers = new WeakMap();

// What is to be done with keys while an element, or something in it, has the focus.
export function onKey(element, handler) {
  handlers.set(element, handler);
}

// Keep the keys of a panel from whoever else listens, but for those pressed together with Ctrl, Alt or the like. What the browser
// itself does with a key, as in sliders and lists, is not touched.
export function ownKeys(root) {
  const pressed = (event) => {
    if (!root.contains(event.target) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.stopImmediatePropagation();
    for (let element = event.target; element && element !== root.parentElement; element = element.parentElement) {
      const handler = handlers.get(element);
      if (handler) return handler(event);
    }
  };
  window.addEventListener("keydown", pressed, true);
  return () => window.removeEventListener("keydown", pressed, true);
}

// A function that calls another at the next frame, once, with what it was given last.
export function eachFrame(handler) {
  let latest, waiting = 0;
  const later = (value) => {
    latest = value;
    waiting ||= requestAnimationFrame(() => {
      waiting = 0;
      handler(latest);
    });
  };
  later.cancel = () => {
    cancelAnimationFrame(waiting);
    waiting = 0;
  };
  return later;
}

// Call a handler where the mouse moves over an element with no button pressed, once for each frame, and with null when it leaves.
// A finger does not point before it touches.
export function onMouse(element, handler) {
  const later = eachFrame((event) => element.isConnected && handler(event));
  element.addEventListener("pointermove", (event) => event.pointerType === "mouse" && !event.buttons && later(event));
  element.addEventListener("pointerleave", () => later(null));
}

const SVG = "http://www.w3.org/2000/svg";

// An element with a tag and classes, as in `made("p.lsys-said", { role: "status" }, "...")`; attributes may be left out.
export const made = (what, ...parts) => filled((tag) => document.createElement(tag), what, parts);

export const drawn = (what, ...parts) => filled((tag) => document.createElementNS(SVG, tag), what, parts);

function filled(create, what, parts) {
  const [tag, ...classes] = what.split("."), element = create(tag), named = parts[0]?.constructor === Object ? parts.shift() : {};
  for (const [name, value] of Object.entries(classes.length ? { class: classes.join(" "), ...named } : named)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== false && value !== undefined) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...parts);
  return element;
}

// An id that nothing else of the page has: each panel of a notebook has a copy of this script, so that counting is not enough.
export function freshId() {
  return `lsys-${Math.random().toString(36).slice(2)}`;
}

const PITCH = { mouse: 4, finger: 7 }; // pixels between two stops of a slider
const THUMB = 16; // pixels
const REST = 500; // milliseconds without a key after which a number that is typed is taken
const NARROW = 150; // pixels of a slider that has not been laid out
const DIGIT = 6; // pixels of a digit of the numbers below a slider

const fits = new WeakMap(), sizes = new ResizeObserver((all) => all.forEach(({ target }) => fits.get(target)()));

// A slider over some texts of numbers, with a box in which one can be typed; `chosen` is called with the index and the text.
// It stops where a hand can stop it (stops.js): at every `least` value at least. An arrow key goes on to the next of every `pace`
// values, one with Shift to the next, Page Up and Down to the next stop; moved with Shift held, each pixel is a value. Where it has
// values between its stops, or no `bar`, buttons go to the next. `whole`: any whole number may be typed. What stands in the box is
// selected where it is entered, so that typing replaces it, and is taken when nothing more is typed; a number beyond the ends is
// refused at the end, and the value stays.
export function slider(name, hint, texts, index, chosen, label = name, { least = 1, pace = 1, bar = true, whole = false } = {}) {
  const id = freshId();
  const box = made("input.lsys-box", { id, type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false" });
  const said = made("span.lsys-refused", { id: freshId(), role: "status" });
  const range = made("input.lsys-range", { type: "range", "aria-label": worded("{name}, slider", { name: label }), min: 0, step: "any" });
  const scale = made("span.lsys-scale", { "aria-hidden": "true" }), track = made("span.lsys-track", range, scale);
  const beside = (sign, hint, way) => button(sign, hint, () => choose(way(false)), { "aria-label": hint, tabindex: -1, class: "lsys-button lsys-next" });
  const less = beside("\u2212", worded("{name}: the value before", { name: label }), back), more = beside("+", worded("{name}: the next value", { name: label }), on);
  const element = made("div.lsys-control", { "data-control": name }, made("label", { for: id, title: hint }, label), less, box, more, said, ...(bar ? [track] : []));
  let numbers = [], stops = [0], marked = [], named = [], grip = null, typing = false, resting = 0;

  function show(at) {
    if (at !== index) refuse(false);
    index = clamped(0, numbers.length - 1, at);
    range.value = amongStops(stops, index);
    range.setAttribute("aria-valuetext", texts[index]);
    if (document.activeElement !== box) box.value = texts[index];
    less.disabled = !index;
    more.disabled = index === numbers.length - 1;
  }

  function choose(at) {
    const before = index;
    show(at);
    if (index !== before) chosen(index, texts[index]);
  }

  function typed() {
    if (box.value === texts[index]) return;
    refuse(!read());
    write();
  }

  // Take the number in the box, if it is one of those that can be chosen; it stays as it is typed.
  function read() {
    clearTimeout(resting);
    const wanted = valueOf(box.value);
    take(wanted);
    const known = wanted >= numbers[0] && wanted <= numbers.at(-1);
    if (known) choose(nearest(numbers, wanted));
    return known;
  }

  function write() {
    typing = false;
    box.value = texts[index];
    if (document.activeElement === box) box.select();
  }

  // Say among which numbers one can choose, or no longer.
  function refuse(refused) {
    if (!refused && !said.textContent) return;
    said.textContent = !refused ? "" : whole ? worded("a whole number") : worded("{least} to {most}", { least: texts[0], most: texts.at(-1) });
    for (const [name, value] of [["aria-invalid", "true"], ["aria-describedby", said.id]]) refused ? box.setAttribute(name, value) : box.removeAttribute(name);
  }

  // Any whole number is among the values of some sliders as soon as somebody wants it.
  function take(number) {
    if (!whole || !Number.isSafeInteger(number) || numbers.includes(number)) return;
    const now = numbers[index], all = [...numbers, number].sort((one, other) => one - other);
    offer(all.map(String), all.indexOf(now));
  }

  // `marks` are the indices of values that matter: the slider stops there in any case. Those in `names` stand below it as numbers,
  // the first ones first, where there is room, and are chosen by a click.
  function offer(others, at, marks = [], names = marks) {
    texts = others;
    numbers = texts.map(valueOf);
    [marked, named] = [marks, names];
    track.style.setProperty("--lsys-stops", String(stopsOf(numbers, marked, Infinity, least).length));
    box.style.width = `${clamped(3, 12, texts.reduce((most, { length }) => Math.max(most, length), 0)) + 2}ch`;
    index = at;
    fit();
  }

  function fit() {
    const pitch = matchMedia("(pointer: coarse)").matches ? PITCH.finger : PITCH.mouse;
    stops = stopsOf(numbers, marked, Math.floor(((range.clientWidth || NARROW) - THUMB) / pitch) + 1, least);
    range.max = Math.max(1, stops.length - 1);
    const numbered = apart(named);
    scale.replaceChildren(...marked.map((at) => made("span", { style: `left: ${100 * wayTo(at)}%`, onclick: () => choose(at) }, numbered.includes(at) ? texts[at] : "")));
    less.hidden = more.hidden = bar && stops.length === numbers.length;
    show(index);
  }

  const wayTo = (at) => stops.indexOf(at) / (stops.length - 1 || 1);

  // Of some indices those whose numbers do not touch those before them.
  function apart(names) {
    const kept = [], half = (at) => (DIGIT * (texts[at].length + 1)) / 2, far = (one, other) => Math.abs(wayTo(one) - wayTo(other)) * (range.clientWidth - THUMB);
    for (const at of names) if (kept.every((other) => far(at, other) >= half(at) + half(other))) kept.push(at);
    return kept;
  }

  // Where keys and buttons lead: to the next of every `pace` values, or of all.
  function on(ofAll) {
    return ofAll ? index + 1 : (Math.floor(index / pace) + 1) * pace;
  }

  function back(ofAll) {
    return ofAll ? index - 1 : (Math.ceil(index / pace) - 1) * pace;
  }

  const keys = { ArrowUp: on, ArrowDown: back, PageUp: () => stops.find((stop) => stop > index), PageDown: () => stops.findLast((stop) => stop < index) };
  const keysOfBar = { ...keys, ArrowRight: on, ArrowLeft: back, Home: () => 0, End: () => numbers.length - 1 };

  const keyed = (known) => (event) => {
    if (event.key === "Enter") return typed();
    if (!known[event.key]) return;
    event.preventDefault();
    choose(known[event.key](event.shiftKey) ?? index);
    write();
  };

  // With Shift held a movement goes on from where it is, by a value for each pixel.
  function held(event) {
    if (!event.shiftKey || !(event.buttons & 1)) return (grip = null);
    grip ??= { x: event.clientX, index };
    choose(grip.index + Math.round(event.clientX - grip.x));
  }

  range.addEventListener("input", () => (grip ? show(index) : choose(stops[Math.round(Number(range.value))])));
  for (const each of ["pointerdown", "pointermove", "pointerup"]) range.addEventListener(each, held);
  onKey(range, keyed(keysOfBar));
  onKey(box, keyed(keys));
  box.addEventListener("change", typed);
  box.addEventListener("blur", () => show(index));
  box.addEventListener("input", () => {
    typing = true;
    refuse(false);
    clearTimeout(resting);
    resting = setTimeout(read, REST);
  });
  box.addEventListener("focus", write);
  box.addEventListener("mousedown", (event) => { // also after a tap; until something is typed no cursor is put into the number
    if (event.button || (typing && document.activeElement === box)) return;
    event.preventDefault();
    box.focus();
    box.select();
  });
  offer(texts, index);
  fits.set(range, () => range.clientWidth && fit());
  sizes.observe(range);
  return {
    element, box, show, offer, get index() { return index; },
    find(text) {
      take(Number(text));
      show(texts.indexOf(text));
    },
  };
}

// The value of a number as a person writes it: 0.7, 0,7 or 7/10.
function valueOf(text) {
  const parts = text.trim().replace(",", ".").replace("\u2212", "-").split("/");
  if (parts.length > 2 || parts.some((part) => !/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(part.trim()))) return NaN;
  return parts.length === 2 ? Number(parts[0]) / Number(parts[1]) : Number(parts[0]);
}

function nearest(numbers, wanted) {
  let best = 0;
  numbers.forEach((number, at) => {
    if (Math.abs(number - wanted) < Math.abs(numbers[best] - wanted)) best = at;
  });
  return best;
}

export function button(face, hint, pressed, more = {}) {
  const inside = ICONS[face] ? icon(face) : face, name = ICONS[face] ? { "aria-label": hint } : {};
  return made("button.lsys-button", { type: "button", title: hint, ...name, onclick: pressed, ...more }, inside);
}

const ICONS = { // of 16 x 16 pixels
  first: "M8 3L3 8l5 5zM13 3L8 8l5 5z", back: "M13 3L6 8l7 5zM3.5 3v10", play: "M4 3l9 5-9 5z", pause: "M4 3h2v10H4zM10 3h2v10h-2z",
  forward: "M5 3l7 5-7 5zM13 3v10", wide: "M2.5 6V2.5H6M10 2.5h3.5V6M13.5 10v3.5H10M6 13.5H2.5V10",
  die: "M2.5 2.5h11v11h-11zM5 5h1v1H5zM10 5h1v1h-1zM5 10h1v1H5zM10 10h1v1h-1zM7.5 7.5h1v1h-1z",
};

export function icon(name) {
  return drawn(`svg.lsys-icon.lsys-icon-${name}`, { viewBox: "0 0 16 16", width: 16, height: 16, "aria-hidden": "true" }, drawn("path", { d: ICONS[name] }));
}

export function face(element, name, hint) {
  element.replaceChildren(icon(name));
  element.setAttribute("aria-label", hint);
  element.title = hint;
}

// A list to choose from: `options` are pairs of a value and its text.
export function list(name, hint, options, value, chosen, label = name) {
  const id = freshId();
  const select = made("select.lsys-list", { id });
  const element = made("div.lsys-control", { "data-control": name }, made("label", { for: id, title: hint }, label), select);
  select.addEventListener("change", () => chosen(select.value));

  function offer(others, chosenValue) {
    select.replaceChildren(...others.map(([each, text]) => made("option", { value: each }, text)));
    select.value = chosenValue;
  }

  offer(options, value);
  return { element, select, offer, show(other) { select.value = other; } };
}
