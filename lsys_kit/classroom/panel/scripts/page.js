// The host of a panel on a page without a kernel: the books of all settings are in the page.

import { bytesOf, inflated, packedLink, unpackedLink } from "./books/link.js";
import { relaxedBook } from "./drawing/relaxation.js";
import { openPanel } from "./panels/panel.js";

const MOST_BYTES = 100_000_000; // of the books of a page
const LONGEST = 3_000; // milliseconds in which the cells of a map come to rest under other forces

// Open the panel of the data that stand in the page; where that cannot be done, say so.
export async function openPage() {
  const here = document.getElementById("lsys-here"), data = JSON.parse(document.getElementById("lsys-data").textContent);
  try {
    openPanel(here, await hostWith(data, true));
    addEventListener("hashchange", () => location.reload());
  } catch (fault) {
    here.textContent = cannot(fault);
  }
}

export const cannot = (fault) => `This browser cannot show the panel; a newer one can. (${fault})`;

// The host of a panel with the books that are in its data. `alone` on a page it keeps what is seen in the page's address.
export async function hostWith(data, alone) {
  const books = JSON.parse(await inflated(bytesOf(data.books), "deflate", MOST_BYTES));
  return pageHost(data, books, await linkedSettings(data), alone);
}

export function pageHost(data, books, linked, alone = true) {
  const { constants } = data.model, answer = data.mode === "map" ? (settings) => relaxedTo(answerAt(books, [], []).book, settings)
    : (settings) => answerAt(books, constants.map((each) => each.texts.indexOf(settings[each.name])), constants);
  const first = Object.fromEntries(data.model.constants.map((each) => [each.name, each.texts[each.index]]));
  const settings = { ...first, ...linked.settings }, { step, angle, around, above, seed } = data.model, handlers = new Map();
  const values = { step, angle, around, above, seed, mark: "", ...linked.others, settings, model: { ...data.model, book: answer(settings).book } };
  if (!values.model.book) Object.assign(values, { settings: first, model: { ...data.model, book: answer(first).book } });

  const address = async () => location.href.split("#")[0] + await packedLink(contentOf(data, values));
  return {
    get: (name) => values[name],
    set(name, value) {
      values[name] = value;
      for (const handler of handlers.get(name) ?? []) handler(value);
    },
    on(name, handler) {
      handlers.set(name, [...(handlers.get(name) ?? []), handler]);
      return () => handlers.set(name, handlers.get(name).filter((each) => each !== handler));
    },
    // The address says what is seen, so that it can be sent, and the page opened again as it was.
    save: () => alone && address().then((there) => history.replaceState(null, "", there)).catch(() => {}),
    book: (asked) => Promise.resolve(answer(asked.constants)),
    rules: () => Promise.resolve(null),
    variants: () => Promise.resolve({ variants: [] }),
    keep: async () => ({ text: await address() }),
    keeps: ["link"],
    editable: false, ahead: data.mode !== "map",
  };
}

// The book of a map under some forces; the page holds that under the first ones.
function relaxedTo(book, settings) {
  if (Object.keys(book.settings).every((name) => book.settings[name] === settings[name])) return { book };
  const forces = Object.fromEntries(Object.entries(settings).map(([name, text]) => [name, numberOf(text)]));
  return relaxedBook(book, settings, forces, LONGEST);
}

// The book of some values of the constants, or the mistake that there is none; books share what they have in common.
function answerAt({ names, parts, rows }, places, constants) {
  if (places.some((place) => place < 0)) return { mistake: { message: "This page does not hold the book of these settings", hint: "" } };
  const row = rows[places.reduce((at, place, i) => at * constants[i].texts.length + place, 0)];
  const found = Object.fromEntries(names.flatMap((name, i) => (row[i] < 0 ? [] : [[name, parts[i][row[i]]]])));
  return found.mistake ? found : { book: found };
}

// The settings of the address, if it has a link of this model.
async function linkedSettings({ model, system }) {
  const content = await unpackedLink(location.href), others = {}, settings = {};
  if (content?.notation !== system.notation || content.text !== system.text) return { others, settings };
  const { step, angle } = content.settings;
  if (/^\d{1,9}$/.test(step)) others.step = Number(step);
  if (numberOf(angle) >= 0 && numberOf(angle) <= 180) others.angle = Math.round(numberOf(angle) * 10) / 10;
  for (const each of model.constants) if (each.texts.includes(content.settings[each.name])) settings[each.name] = content.settings[each.name];
  return { others, settings };
}

function numberOf(text = "") {
  const [above, below = "1"] = text.split("/");
  return above === "" ? NaN : Number(above) / Number(below);
}

function contentOf({ system, model, fixed }, { step, angle, settings }) {
  const turn = angle === system.angle ? {} : { angle }, seed = model.seed ? { seed: model.seed } : {};
  return { ...system, settings: { step, ...turn, ...seed, ...fixed, ...settings } };
}
