// The host of a panel on a page without a kernel: the books of all settings are in the page.

import { heldSettings } from "./books/held.js";
import { hasLink, packedLink, unpackedLink } from "./books/link.js";
import { unpacked } from "./books/packed.js";
import { relaxedBook } from "./drawing/relaxation.js";
import { openPanel } from "./panels/panel.js";

const LONGEST = 3_000; // milliseconds in which the cells of a map come to rest under other forces

export async function openPage() {
  const here = document.getElementById("lsys-here"), data = JSON.parse(document.getElementById("lsys-data").textContent);
  try {
    openPanel(here, await hostWith(data, true));
    addEventListener("hashchange", () => location.reload());
  } catch (fault) {
    here.append(cannot(fault));
  }
}

export const cannot = (fault) => `This browser cannot show the panel; a newer one can. (${fault})`;

// The host of a panel with the books that are in its data. `alone` on a page it keeps what is seen in the page's address.
export async function hostWith(data, alone) {
  const books = JSON.parse(await unpacked(data.books)), linked = await linkedSettings(data);
  return pageHost(data, books, { ...linked, notice: alone ? linked.notice : null }, alone);
}

// Values by their names, told to whoever listens when they are set.
export function store(values) {
  const handlers = new Map(), of = (name) => handlers.get(name) ?? [];
  const tell = (name) => of(name).forEach((handler) => handler(values[name]));
  return {
    tell,
    get: (name) => values[name],
    set(name, value) {
      values[name] = value;
      tell(name);
    },
    on(name, handler) {
      handlers.set(name, [...of(name), handler]);
      return () => handlers.set(name, of(name).filter((each) => each !== handler));
    },
  };
}

function pageHost(data, books, linked, alone = true) {
  const held = heldSettings(data.model), relaxes = data.mode === "map", { step, angle, around, above, seed } = data.model;
  const answer = relaxes ? ({ constants }) => relaxedTo(bookAt(books, 0).book, constants) : (asked) => ofSeed(bookAt(books, held.rowAt(held.placesOf(asked))), asked.seed);
  const ofSeed = (found, asked) => (found.book?.choices || !found.book?.chance || data.model.seeds.length || asked === seed ? found : NOT_THERE);
  const first = Object.fromEntries(data.model.constants.map((each) => [each.name, each.texts[each.index]]));
  const values = { step, angle, around, above, seed, mark: "", letters: data.model.letters, ...linked.others, settings: { ...first, ...linked.settings } };
  const asked = () => ({ constants: values.settings, seed: values.seed, letters: values.letters });
  const there = Boolean(answer(asked()).book);
  if (!there) Object.assign(values, { settings: first, seed });
  values.model = { ...data.model, asked: asked(), book: answer(asked()).book };
  let notice = linked.notice ?? (linked.asked && (!there || isLost(linked.asked, values, data.fixed)) ? NOT_HELD : null);
  const { get, tell, on } = store(values);

  // Whatever the page does not hold together with what was moved goes back to its first value.
  function settle(before) {
    const wanted = held.placesOf(asked()), there = held.settled(wanted, before), { constants, seed: sown } = held.settingsAt(there);
    notice = held.told(wanted, there);
    if (notice) Object.assign(values, { settings: constants, seed: sown });
    return notice ? ["settings", "seed"] : [];
  }

  const address = async () => location.href.split("#")[0] + await packedLink(contentOf(data, values));
  return {
    get, on,
    set(name, value) {
      const before = held.placesOf(asked());
      values[name] = value;
      const others = !relaxes && ["settings", "seed"].includes(name) ? settle(before) : [];
      for (const each of new Set([name, ...others])) tell(each);
    },
    // The address says what is seen, so that it can be sent, and the page opened again as it was.
    save: () => alone && address().then((there) => history.replaceState(null, "", there)).catch(() => {}),
    book: async (wanted) => answer(wanted),
    notice: () => notice,
    rules: async () => null,
    variants: async () => ({ variants: [] }),
    keep: async () => ({ text: await address() }),
    keeps: ["link"], file: data.file, editable: false, ahead: !relaxes,
  };
}

// The book of a map under some forces; the page holds that under the first ones.
function relaxedTo(book, settings) {
  if (Object.keys(book.settings).every((name) => book.settings[name] === settings[name])) return { book };
  const forces = { ...book.forces, ...Object.fromEntries(Object.entries(settings).map(([name, text]) => [name, numberOf(text)])) };
  return relaxedBook(book, settings, forces, LONGEST);
}

// The book of a row, or the mistake that there is none; books share what they have in common.
function bookAt({ names, parts, rows }, at) {
  if (at < 0) return NOT_THERE;
  const found = Object.fromEntries(names.flatMap((name, i) => (rows[at][i] < 0 ? [] : [[name, parts[i][rows[at][i]]]])));
  return found.mistake ? found : { book: found };
}

/** @type {any} */
const NOT_THERE = { mistake: { message: "This page does not hold the book of these settings", hint: "Press reset, and move one slider alone." } };
export const BROKEN = { message: "The link in the address is broken, and this page shows its own settings", hint: "Copy the whole link again." };
export const ANOTHER = { message: "The link in the address leads to another model than that of this page", hint: "In Jupyter explore(\"...\") opens it." };
const NOT_HELD = { message: "This page does not hold all that the link in its address says", hint: "What it lacks stands at its first value, or at the last step." };

// The settings of the address, if it has a link of this model; and what of it the page cannot show.
async function linkedSettings({ model, system }) {
  const content = await unpackedLink(location.href), others = {}, settings = {};
  if (!content) return { others, settings, notice: hasLink(location.href) ? BROKEN : null };
  if (content.notation !== system.notation || content.text !== system.text) return { others, settings, notice: ANOTHER };
  const { step, angle, seed = "0", letters = "" } = content.settings, turn = numberOf(angle);
  if (model.lettered) others.letters = model.lettered.filter((name) => letters.split(",").includes(name));
  if (model.chance && (model.seeds.length ? model.seeds.includes(seed) : /^-?\d{1,15}$/.test(seed))) others.seed = Number(seed);
  if (/^\d{1,9}$/.test(step)) others.step = Number(step);
  if (turn >= 0 && turn <= 180) others.angle = Math.round(turn * 10) / 10;
  for (const { name, texts } of model.constants) if (texts.includes(content.settings[name])) settings[name] = content.settings[name];
  return { others, settings, notice: null, asked: { ...content.settings, seed, letters } };
}

// Whether something of a link is not shown: a later step than there is, or a value that the page does not hold.
function isLost({ step, angle, seed, ...others }, { settings, letters, model: { book }, ...values }, fixed) {
  const shown = { ...fixed, ...settings, letters: `${letters ?? ""}` };
  return Number(step) > book.steps || (book.chance && seed !== `${values.seed}`) || Object.entries(others).some(([name, text]) => shown[name] !== text);
}

export function numberOf(text = "") {
  const [above, below = "1"] = text.split("/");
  return above === "" ? NaN : Number(above) / Number(below);
}

function contentOf({ system, fixed }, { step, angle, seed, letters, settings }) {
  return { ...system, settings: { step, ...(angle !== system.angle && { angle }), ...(seed && { seed }), ...(letters?.length && { letters }), ...fixed, ...settings } };
}
