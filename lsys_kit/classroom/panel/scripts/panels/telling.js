// What a panel shows, told: in a sentence, and as the line of code that makes it.

import { filamentLength } from "../drawing/filament.js";
import { counted, sizeOf } from "../views/word.js";

const rounded = (size, digits = 2) => Number((size + 1e-9).toFixed(digits));

// A step with its tokens, and the width and height of its drawing, if there is one.
export function caption(book, now, tokens, measured) {
  const occupied = book.data.net.places.filter((each) => tokens[each.place] > 0).length, stages = book.data.net.places.length;
  const parts = [`step ${now}: ${sizeOf(book, now)}`];
  if (stages > 1) parts.push(`${occupied} of ${counted(stages, "stage")} occupied`);
  if (changesNothing(book, now)) parts.push("this step changes nothing");
  if (book.data.mode === "filament") parts.push(`length ${rounded(filamentLength(book, now), 4)}`);
  if (measured) parts.push(`width ${rounded(measured[0])}, height ${rounded(measured[1])}`);
  if (book.data.said) parts.push(book.data.said);
  if (now === book.steps && book.data.end) parts.push(book.data.end);
  return parts.join("; ");
}

// Whether the word of a step is that of the step before.
function changesNothing(book, now) {
  if (!now || ["map", "tissue"].includes(book.data.mode) || book.length(now) !== book.length(now - 1)) return false;
  const before = book.word(now - 1);
  return book.word(now).every((state, position) => state === before[position]);
}

// The line of code that makes a panel as it stands; `turns` says whether its angle has a slider.
export function code(host, book, turns) {
  const model = host.get("model");
  const changed = model.constants.filter((each) => host.get("settings")[each.name] !== each.texts[each.index]);
  const reader = { map: "read_map", cellwork: "read_cellwork" }[book.data.notation], notation = reader ? "" : `, ${JSON.stringify(book.data.notation)}`;
  const first = book.data.title ? JSON.stringify(book.data.title) : `${reader ?? "read"}(${JSON.stringify(book.data.text)}${notation})`;
  const more = [String(host.get("step")), ...(host.get("angle") !== model.angle ? [`angle=${host.get("angle")}`] : []),
    ...(host.get("seed") ? [`seed=${host.get("seed")}`] : []),
    ...(model.without?.length ? [`sliders=${JSON.stringify([...model.constants.map((each) => each.name), ...(turns ? ["angle"] : []), ...(model.chance ? ["seed"] : [])])}`] : []),
    ...(model.unfold ? [`unfold=${model.unfold === true ? "True" : JSON.stringify(model.unfold)}`] : []),
    ...(model.show ? [`show=${JSON.stringify(model.show)}`] : []),
    ...changed.map((each) => `${each.name}=${/^[-\d.]+$/.test(host.get("settings")[each.name]) ? host.get("settings")[each.name] : JSON.stringify(host.get("settings")[each.name])}`)];
  return `explore(${[first, ...more].join(", ")})`;
}
