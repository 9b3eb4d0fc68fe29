// Several small drawings beside each other: nine seeds of one model, or nine variants of which one can be taken on.

import { openBook } from "../books/book.js";
import { grouped } from "../books/numbers.js";
import { made } from "../views/controls.js";
import { roving } from "../views/folding.js";
import { paintSequence, sequence } from "./filament.js";
import { cleared } from "./outlines.js";
import { paint } from "./painter.js";
import { frameOf } from "./projection.js";
import { placed, traced } from "./turtle.js";

const MANY = 9;

// Nine seeds: those of the row of nine to which the seed of the panel belongs. `sow` is called with the one that was chosen.
export function seedsView(parent, sow, say) {
  let shown = { books: null, key: "", first: 0 };
  const gallery = galleryView(parent, (number) => sow(shown.first + number));

  async function show(books, request, now, look) {
    const first = Math.floor(request.seed / MANY) * MANY, key = JSON.stringify([request.constants, first]);
    if (shown.books !== books || shown.key !== key) {
      const asked = shown = { books, key, first }, entries = [];
      for (let seed = first; seed < first + MANY; seed++) {
        const answer = await books.book({ ...request, seed });
        if (answer.mistake) return say(answer.mistake);
        entries.push({ label: `seed ${seed}`, book: answer.book });
      }
      if (shown !== asked) return;
      gallery.open(entries);
    }
    gallery.show(now, look, request.seed - first);
  }

  return { show };
}

// Nine variants of the model; `take` is called with the text of the one that was chosen.
export function variantsView(parent, take, say) {
  let found = null, bred = 0;
  const gallery = galleryView(parent, (number) => take(found[number].text));

  async function show(host, now, look) {
    if (!found) {
      const number = ++bred;
      found = [];
      const answer = await host.variants();
      if (number !== bred) return;
      if (answer.mistake) return say(answer.mistake);
      found = answer.variants;
      gallery.open(found.map((each, i) => ({ label: `variant ${i + 1}`, book: openBook(each.book) })));
    }
    gallery.show({ ...now, angle: null }, look);
  }

  return { show, forget() { [found, bred] = [null, bred + 1]; } };
}

// `entries` are { label, book }; `chosen` is called with the number of one.
function galleryView(parent, chosen) {
  let tiles = [], shown = [];
  const resized = new ResizeObserver(() => tiles.length && show(...shown)); // as on the whole screen

  function open(entries) {
    tiles = entries.map((entry, number) => {
      const canvas = made("canvas.lsys-tile", { "aria-hidden": "true" });
      const tile = made("button.lsys-button.lsys-tile-button", { type: "button", onclick: () => chosen(number) }, canvas, made("span", entry.label));
      return { ...entry, canvas, tile };
    });
    const sheet = made("div.lsys-gallery", { role: "group" }, ...tiles.map(({ tile }) => tile));
    roving(sheet);
    parent.replaceChildren(sheet);
    resized.disconnect();
    resized.observe(sheet);
  }

  // Each at the step that is shown, or at its last one where it has fewer; `current` is the number of the one in the panel.
  function show(now, look, current = -1) {
    shown = [now, look, current];
    tiles.forEach(({ book, canvas, tile, label }, number) => {
      const step = Math.min(now.step, book.steps);
      tile.setAttribute("aria-pressed", String(number === current));
      tile.setAttribute("aria-label", `${label}: ${grouped(book.length(step))} ${book.data.noun}s at step ${step}`);
      paintTile(canvas, book, { ...now, step, angle: now.angle ?? book.data.turtle?.angle }, look);
    });
  }

  return { open, show };
}

export function paintTile(canvas, book, now, look) {
  const sheet = cleared(canvas, look.theme), plain = { theme: look.theme, marked: new Set(), lit: new Map(), litAt: () => new Map(), current: -1 };
  if (!sheet) return;
  const { pen, width, height } = sheet;
  if (book.data.mode === "filament") return paintSequence(pen, sequence(book, now.step, { rows: 12, width, height, boxed: null, labelled: false }), plain);
  const shapes = placed(traced(book, now.step), now.angle);
  paint(pen, shapes, frameOf(shapes, width, height, { around: now.around, above: now.above, near: 1, shift: [0, 0], box: null }), plain);
}
