// What the entries of a table are worth, where no kernel says so: as lessons/entries.py and lessons/worksheet.py have it. Numbers
// are exact fractions.

import { LONGEST_ENTRY } from "../drawing/constants.js";
import { plain } from "./asking.js";

const NUMBER = /^([+-]?)(?=\.?\d)(\d{0,30})(?:\.(\d{1,30}))?(?:\/(\d{1,30}))?(%?)$/;
const PRODUCT = /^\d{1,9}(?:\^\d{1,2})?(?:[*·×]\d{1,9}(?:\^\d{1,2})?){0,9}$/;
/** @type {[RegExp, Record<string, string>][]} */
const OTHER_FORMS = [
  [/^[+-]?\d{1,3}(?:[,']\d{3})+(?:\.\d+)?$/, { ",": "", "'": "" }],
  [/^[+-]?\d{1,3}(?:\.\d{3})+(?:,\d+)?$/, { ".": "", ",": "." }],
  [/^[+-]?\d*,\d+%?$/, { ",": "." }],
];
const BEFORE = /^(?:.*[=≈~]|(?:about|approx\.?|ca\.?)(?=\s))/is;
const NOUNS = /\s*(?:\p{L}+|°)(?:\s+\p{L}+){0,9}$/u, NOUN = /\p{L}+|°/gu;
const SHORT = { y: "yes", j: "yes", ja: "yes", n: "no", nein: "no", l: "left", links: "left", r: "right", rechts: "right" };
const RIGHT = "right", NOT_YET = "not yet", NO_NUMBER = "no number", MISSING = "not filled in yet";
const MOST_NOTES = 3;

export function checked({ sheet, blanks, says }, entries) {
  const nouns = nounsIn(sheet.title, ...sheet.columns), marks = blanks.map((blank, number) => markOf(entries[number] ?? "", blank, nouns));
  const places = new Map(), unexplained = [];
  marks.forEach((mark, number) => {
    if (mark === RIGHT || mark === MISSING) return;
    const shown = shownBy(entries[number], mark, blanks[number], nouns, says);
    if (shown) places.set(shown, [...(places.get(shown) ?? []), placeOf(sheet, number)]);
    else unexplained.push(number);
  });
  const notes = [...places].slice(0, MOST_NOTES).map(([shown, where]) => `${where.join("; ")}: ${shown}`);
  return { marks, text: summary(sheet, marks, unexplained), notes };
}

function markOf(entry, { right, within }, nouns) {
  if (!entry.trim()) return MISSING;
  if (isRight(entry, right, within, nouns)) return RIGHT;
  return readings(entry, nouns).length || !right.some(numberOf) ? NOT_YET : NO_NUMBER;
}

function shownBy(entry, mark, { right, slips }, nouns, says) {
  if (mark === NO_NUMBER) return "That cannot be read as a number. Write it in digits, such as 21, 0.5 or 3/4.";
  if (right.some((each) => each === "yes" || each === "no") && !isRight(entry, ["yes", "no"])) return 'Answer "yes" or "no".';
  const known = slips.find(([answer, within]) => isRight(entry, [answer], within, nouns));
  return known ? says[known[2]] : "";
}

export function isRight(entry, right, within = "0", nouns = []) {
  if ([...entry].length > LONGEST_ENTRY) return false;
  const near = numberOf(within) ?? numberOf("0"), numbers = readings(entry, nouns);
  return right.some((each) => word(entry) === word(each) || numbers.some((number) => isNear(number, numberOf(each), near)));
}

function word(text) {
  const found = text.replace(/\s+/g, "").toLowerCase();
  return Object.hasOwn(SHORT, found) ? SHORT[found] : found;
}

// The number that a text is, { above, below }, or null: a whole number, a decimal, a fraction, a percentage, a product of powers.
function numberOf(text) {
  const signs = bare(text);
  if (PRODUCT.test(signs)) {
    const powers = signs.split(/[*·×]/).map((factor) => factor.split("^").map(BigInt));
    return { above: powers.reduce((product, [base, power = 1n]) => product * base ** power, 1n), below: 1n };
  }
  const found = NUMBER.exec(signs);
  if (!found || (found[4] && !BigInt(found[4]))) return null;
  const [, sign, whole, part = "", below = "1", percent] = found;
  const above = BigInt(whole + part) * (sign === "-" ? -1n : 1n);
  return { above, below: 10n ** BigInt(part.length) * BigInt(below) * (percent ? 100n : 1n) };
}

// The numbers that an entry may mean; some nouns may stand behind it.
function readings(entry, nouns) {
  if ([...entry].length > LONGEST_ENTRY) return [];
  const signs = bare(alone(entry, nouns)), texts = [signs, signs.replace(/%$/, "")];
  for (const [form, marks] of OTHER_FORMS) {
    if (!form.test(signs)) continue;
    const other = [...signs].map((sign) => marks[sign] ?? sign).join("");
    texts.push(other, other.replace(/%$/, ""));
  }
  return texts.map(numberOf).filter(Boolean);
}

function alone(entry, nouns) {
  const text = entry.trim().replace(BEFORE, ""), behind = NOUNS.exec(text);
  const known = behind && behind[0].match(NOUN).every((each) => nouns.includes(singular(each)));
  return known ? text.slice(0, behind.index) : text;
}

const singular = (noun) => noun.toLowerCase().replace(/s$/, "");
const nounsIn = (...texts) => [...texts.flatMap((text) => (text.match(NOUN) ?? []).map(singular)), "°"];

// Without blanks, with the minus sign and the fractions of a keyboard.
function bare(text) {
  const signs = text.replace(/\s+/g, "").replace(/[\u2212\u2013]/g, "-");
  return signs.replace(/(?<![\d.,])[¼-¾⅐-⅞]/g, (sign) => sign.normalize("NFKC").replace("\u2044", "/"));
}

function isNear(one, other, near) {
  if (!other) return false;
  const apart = one.above * other.below - other.above * one.below, unit = one.below * other.below;
  return (apart < 0n ? -apart : apart) * near.below <= near.above * unit;
}

function summary(sheet, marks, unexplained) {
  const count = (mark) => marks.filter((each) => each === mark).length, right = count(RIGHT), missing = count(MISSING), total = marks.length;
  if (right === total) return total > 1 ? "All cells are right." : "The cell is right.";
  const parts = [`${right} of ${total} cell${total > 1 ? "s" : ""} ${right === 1 || total === 1 ? "is" : "are"} right`];
  if (missing) parts.push(`${missing} ${missing === 1 ? "is" : "are"} not filled in yet`);
  const again = unexplained.length ? ` Look again at ${placeOf(sheet, unexplained[0])}.` : "";
  return `${parts.join(", ")}.${again}`;
}

function placeOf({ columns, rows }, number) {
  const places = rows.flatMap((cells) => cells.flatMap((cell, column) => (cell === null ? [[cells[0], column]] : [])));
  const [row, column] = places[number], name = plain(row);
  return `${numberOf(name) ? `${plain(columns[0])} ${name}` : name}, ${plain(columns[column])}`;
}
