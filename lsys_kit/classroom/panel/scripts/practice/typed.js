// What is typed, in the normal form by which scorm/page.py finds its reply: { key }, or { unreadable } with what is to be said.

import { worded } from "../views/controls.js";

const ASSIGNED = /^\s*[A-Za-z_]\w*\s*(\([^()=]*\))?\s*=(?!=)\s*/; // the beginning of "N(12) = 21"
const WITH_UNIT = /^(.*?[\d)])\s*([^\W\d_][\w .]*|°|%)\s*$/s;
const THOUSANDS = /^[+-]?\d{1,3}(,\d{3})+$/, DECIMAL_COMMA = /^[+-]?\d+,\d{1,2}$/;
const DECIMAL = /^([+-]?)(\d{0,60})(?:\.(\d{0,60}))?$/;
const COUNTED = ["cell", "letter", "module", "symbol", "character", "element", "piece"];
const DEGREES = ["°", "degree", "degrees", "deg", "grad"], PERCENT = ["%", "percent", "prozent"];
const UNKNOWN = 'The question has no symbol "{symbol}". The symbols are: {symbols}.';
export const MOST_CHARACTERS = 2000;

export function read(data, text) {
  if (text.length > MOST_CHARACTERS) return { unreadable: worded("That is longer than {most} characters.", { most: MOST_CHARACTERS }) };
  return { number, table, word, choice: exact, line: exact }[data.kind](data, text.replaceAll("\u2212", "-").replaceAll("\u00a0", " "));
}

const exact = (_, text) => ({ key: text });

// Numbers: exact fractions { above, below }.

function number({ unit, known, part }, text) {
  const bare = text.replace(ASSIGNED, "").trim().replace(/^[$≈~ "']+|[$≈~ "']+$/g, "").replace(/[. ]+$/, "");
  const found = WITH_UNIT.exec(bare), typed = (found?.[2] ?? "").trim().toLowerCase();
  const value = fractionOf(found ? found[1].trim() : bare);
  if (!value) return { unreadable: worded("A number is needed here, such as 21, 0.5 or 3/4.") };
  const scale = typed && scaleOf(typed, unit.toLowerCase(), known);
  if (scale === null) return { unreadable: unit ? worded("Its unit is: {unit}.", { unit }) : worded("Write the number alone.") };
  return { key: part ? rounded(/** @type {any} */ (value), part.map(BigInt)) : keyOf({ above: value.above, below: /** @type {any} */ (value.below) * (scale || 1n) }) };
}

// By what a number with a unit is divided, or null where the unit does not fit.
function scaleOf(typed, unit, known) {
  if (typed === unit || [DEGREES, PERCENT].some((names) => names.includes(typed) && names.includes(unit))) return 1n;
  if (PERCENT.includes(typed) && !unit) return 100n;
  const noun = typed.replace(/s+$/, "");
  if ([...DEGREES, ...PERCENT].includes(typed)) return null;
  return known.includes(noun) || (COUNTED.includes(noun) && COUNTED.includes(unit.replace(/s+$/, ""))) ? 1n : null;
}

function fractionOf(text) {
  const plain = THOUSANDS.test(text) ? text.replaceAll(",", "") : DECIMAL_COMMA.test(text) ? text.replace(",", ".") : text;
  const parts = plain.split("/").map((part) => decimalOf(part.trim()));
  if (parts.length > 2 || !parts.every(Boolean)) return null;
  const [above, below = { above: 1n, below: 1n }] = parts;
  return below.above ? { above: above.above * below.below, below: above.below * below.above } : null;
}

function decimalOf(text) {
  const [, sign, whole, part = ""] = DECIMAL.exec(text) ?? [];
  return whole || part ? { above: BigInt(whole + part) * (sign === "-" ? -1n : 1n), below: 10n ** BigInt(part.length) } : null;
}

function keyOf({ above, below }) {
  let [a, b] = [above < 0n ? -above : above, below < 0n ? -below : below];
  while (b) [a, b] = [b, a % b];
  const sign = below < 0n ? -1n : 1n;
  return `${(sign * above) / a}/${(sign * below) / a}`;
}

// How often a part goes into a number, rounded.
/** @param {{ above: bigint, below: bigint }} number @param {bigint[]} part */
function rounded({ above, below }, [partAbove, partBelow]) {
  const top = 2n * above * partBelow + below * partAbove, bottom = 2n * below * partAbove;
  const [up, down] = bottom < 0n ? [-top, -bottom] : [top, bottom];
  return `~${up / down - (up % down < 0n ? 1n : 0n)}`;
}

// Several numbers, in order.

function table(_, text) {
  const parts = text.replace(text.includes("\n") ? "" : ASSIGNED, "").split(/[\s,;|[\](){}&"']+/).filter(Boolean);
  const values = parts.map(fractionOf), wrong = values.indexOf(null);
  if (wrong >= 0) return { unreadable: worded('"{text}" is no number.', { text: parts[wrong].slice(0, 40) }) };
  return parts.length ? { key: values.map(keyOf).join(",") } : { unreadable: worded("Numbers are needed here, such as 1, 2, 3.") };
}

// Words: symbols of the question, some with numbers in brackets behind them.

function word({ symbols }, text) {
  const plain = text.trim().replace(/^["'`]+|["'`]+$/g, "").replace(/^\s*[{[]([^{}[\]]*,[^{}[\]]*)[}\]]\s*$/s, "$1");
  const modules = [];
  for (let at = 0; at < plain.length;) {
    const blank = /^[\s,]+/.exec(plain.slice(at));
    if (blank) { at += blank[0].length; continue; }
    const symbol = symbols.find((each) => plain.startsWith(each, at));
    if (!symbol) return { unreadable: worded(UNKNOWN, { symbol: nameAt(plain, at), symbols: symbols.join(", ") }) };
    at += symbol.length;
    const values = symbols.includes("(") ? null : /^\s*\(([^()]*)\)/.exec(plain.slice(at));
    const numbers = values ? values[1].split(",").map((each) => fractionOf(each.trim())) : [];
    if (numbers.includes(null)) return { unreadable: worded("The numbers behind {symbol} cannot be read.", { symbol }) };
    modules.push(symbol + (numbers.length ? `(${numbers.map(keyOf).join(",")})` : ""));
    at += values ? values[0].length : 0;
  }
  return modules.length ? { key: modules.join(" ") } : { unreadable: worded("A word is needed here.") };
}

const nameAt = (text, at) => /^(\w+|.)/su.exec(text.slice(at))[0].slice(0, 20);
