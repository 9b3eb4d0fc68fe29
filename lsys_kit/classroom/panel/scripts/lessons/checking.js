// When what was typed into the cells of a table is right, where no kernel says so: as lessons/lesson.py and lessons/worksheet.py
// have it. Numbers are exact fractions.

import { LONGEST_ENTRY } from "../drawing/constants.js";
import { plain } from "./asking.js";

const NUMBER = /^([+-]?)(?=\.?\d)(\d{0,30})(?:\.(\d{1,30}))?(?:\/(\d{1,30}))?(%?)$/;
const THOUSANDS = /^[+-]?\d{1,3}(,\d{3})+(\.\d+)?$/, DECIMAL_COMMA = /^[+-]?\d*,\d+$/;
const RIGHT = "right", NOT_YET = "not yet", MISSING = "not filled in yet";

export function checked({ sheet, blanks }, entries) {
  const marks = blanks.map(({ right, within }, number) => markOf(entries[number] ?? "", right, within));
  return { marks, text: summary(sheet, marks) };
}

function markOf(entry, right, within) {
  if (!entry.trim()) return MISSING;
  return isRight(entry, right, within) ? RIGHT : NOT_YET;
}

export function isRight(entry, right, within = "0") {
  if ([...entry].length > LONGEST_ENTRY) return false;
  const near = numberOf(within) ?? numberOf("0");
  return right.some((each) => bare(entry).toLowerCase() === bare(each).toLowerCase()
    || readings(entry).some((number) => isNear(number, numberOf(each), near)));
}

// The number that a text is, { above, below }, or null: a whole number, a decimal, a fraction, a percentage.
function numberOf(text) {
  const found = NUMBER.exec(bare(text).replaceAll("\u2212", "-"));
  if (!found || (found[4] && !BigInt(found[4]))) return null;
  const [, sign, whole, part = "", below = "1", percent] = found;
  const above = BigInt(whole + part) * (sign === "-" ? -1n : 1n);
  return { above, below: 10n ** BigInt(part.length) * BigInt(below) * (percent ? 100n : 1n) };
}

// The numbers that an entry may mean: a comma parts thousands, or stands for the decimal point.
function readings(entry) {
  const text = bare(entry), found = [numberOf(text)];
  if (THOUSANDS.test(text)) found.push(numberOf(text.replaceAll(",", "")));
  if (DECIMAL_COMMA.test(text)) found.push(numberOf(text.replace(",", ".")));
  return found.filter(Boolean);
}

function isNear(one, other, near) {
  if (!other) return false;
  const apart = one.above * other.below - other.above * one.below, unit = one.below * other.below;
  return (apart < 0n ? -apart : apart) * near.below <= near.above * unit;
}

const bare = (text) => text.replace(/\s+/g, "");

function summary(sheet, marks) {
  const count = (word) => marks.filter((each) => each === word).length, right = count(RIGHT), missing = count(MISSING), total = marks.length;
  if (right === total) return total > 1 ? "All cells are right." : "The cell is right.";
  const parts = [`${right} of ${total} cell${total > 1 ? "s" : ""} ${right === 1 || total === 1 ? "is" : "are"} right`];
  if (missing) parts.push(`${missing} ${missing === 1 ? "is" : "are"} not filled in yet`);
  const wrong = marks.indexOf(NOT_YET), again = wrong < 0 ? "" : ` Look again at ${placeOf(sheet, wrong)}.`;
  return `${parts.join(", ")}.${again}`;
}

function placeOf({ columns, rows }, number) {
  const places = rows.flatMap((cells) => cells.flatMap((cell, column) => (cell === null ? [[cells[0], column]] : [])));
  const [row, column] = places[number];
  return `row ${plain(row)}, ${plain(columns[column])}`;
}
