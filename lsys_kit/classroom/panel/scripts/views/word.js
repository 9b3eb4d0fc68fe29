// The word of a step: each module on the tint of its symbol; a long word without its middle.

import { clamped, grouped } from "../books/numbers.js";
import { MOST_MODULES_SHOWN } from "../drawing/constants.js";
import { button, eachFrame, made, onKey, onMouse, worded } from "./controls.js";
import { maths } from "./letters.js";

// `told` learns of the module that was chosen, `pointed` of the one that the mouse is on, or of -1.
export function wordView(parent, told, pointed) {
  const box = made("div.lsys-word", { tabindex: 0, role: "application", "aria-roledescription": "word" });
  const help = "Arrow keys go from one to the next; Escape ends that.";
  const all = button(worded("show all"), worded("the whole word, or its first lines"), () => {
    all.setAttribute("aria-expanded", String(box.classList.toggle("lsys-all")));
    all.textContent = box.classList.contains("lsys-all") ? worded("show less") : worded("show all");
  }, { "aria-expanded": "false", hidden: true });
  const fold = eachFrame(() => (all.hidden = !(box.classList.contains("lsys-all") || box.scrollHeight > box.clientHeight + 2)));
  new ResizeObserver(fold).observe(box);
  parent.append(box, all);
  let book, word, chips = new Map();

  function chip(position) {
    const state = word[position], label = book.label(state);
    const element = made(label.steering ? "span.lsys-steering" : "span.lsys-module", { "data-position": position });
    if (label.colour) element.style.setProperty("--symbol", label.colour);
    if (label.values && !label.text.endsWith(label.values)) element.title = label.text;
    element.append(...labelled(label));
    chips.set(position, element);
    return element;
  }

  function show(nextBook, step) {
    [book, word, chips] = [nextBook, nextBook.word(step), new Map()];
    const n = word.length, half = MOST_MODULES_SHOWN / 2, parts = [];
    const from = n > MOST_MODULES_SHOWN ? half : n;
    for (let i = 0; i < from; i++) parts.push(chip(i));
    if (n > MOST_MODULES_SHOWN) {
      parts.push(made("span.lsys-gap", `… ${grouped(n - MOST_MODULES_SHOWN)} more …`));
      for (let i = n - half; i < n; i++) parts.push(chip(i));
    }
    if (!n) parts.push(made("span.lsys-gap", "The word is empty."));
    box.replaceChildren(...parts);
    fold();
    box.setAttribute("aria-label", `Word of step ${step}, ${counted(n, book.data.noun)}. ${help}`);
  }

  function light(marked, traced) {
    for (const [position, element] of chips) {
      element.classList.toggle("lsys-marked", marked.has(word[position]));
      const kind = traced.get(position);
      if (kind) element.dataset.traced = kind;
      else delete element.dataset.traced;
    }
  }

  function differ(positions) {
    for (const [position, element] of chips) element.classList.toggle("lsys-different", positions.has(position));
  }

  const moduleAt = (event) => Number(event.target.closest("[data-position]")?.dataset.position ?? -1);
  box.addEventListener("click", (event) => {
    if (moduleAt(event) >= 0) told(moduleAt(event));
  });
  onMouse(box, (event) => pointed(event ? moduleAt(event) : -1));
  onKey(box, (event) => {
    const way = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: 10, ArrowUp: -10 }[event.key];
    if (!way && !["Home", "End", "Escape"].includes(event.key)) return;
    event.preventDefault();
    if (event.key === "Escape") told(-1);
    else if (event.key === "Home") told(0);
    else if (event.key === "End") told(word.length - 1);
    else told(null, way);
  });

  // Move the word, and not the page, until a module is seen.
  function reveal(position) {
    const chip = chips.get(position);
    if (chip) box.scrollTop = clamped(chip.offsetTop + chip.offsetHeight - box.clientHeight, chip.offsetTop, box.scrollTop);
  }

  return { show, light, differ, reveal, box };
}

// A label as nodes: an italic letter, a subscript, upright values or a formula of them.
export function labelled({ letter, subscript, values, formula, walls = [] }) {
  if (walls.length) return walls.map(([label, colour, edges]) => wallOf(label, colour, edges));
  const parts = [/^\p{L}/u.test(letter) ? made("i", letter) : letter];
  if (subscript) parts.push(made("sub", subscript));
  if (values) parts.push(formula ? maths(formula, values) : values);
  return parts;
}

function wallOf(label, colour, edges) {
  const name = made("b.lsys-wall", label);
  name.style.setProperty("--symbol", colour);
  return made("span.lsys-cycle", name, made("i", edges));
}

// A number with its noun: "1 module", "2 modules".
export function counted(number, noun, several = `${noun}s`) {
  return `${grouped(number)} ${number === 1 ? noun : several}`;
}

// The size of a step in words: of cells as the kit says it, of a map its vertices, walls and cells, of a word its modules, and what of
// them is seen: the strokes of the turtle, so many, or the cells of a filament in which there is more.
export function sizeOf(book, step, strokes = 0) {
  if (book.data.sizes) return book.data.sizes[step];
  if (book.data.mode !== "map") return [...seenOf(book, step, strokes), counted(book.length(step), book.data.noun)].join(", ");
  return [["vertex", "vertices"], ["wall"], ["cell"]].map((nouns, i) => counted(book.data.counts[step][i], ...nouns)).join(", ");
}

function seenOf(book, step, strokes) {
  if (book.data.mode !== "filament" || book.data.noun === "cell") return strokes ? [counted(strokes, "stroke")] : [];
  const cells = book.data.cells.map((row) => row.filter(([wall]) => !wall).length);
  return [counted(book.word(step).reduce((sum, state) => sum + cells[state], 0), "cell")];
}
