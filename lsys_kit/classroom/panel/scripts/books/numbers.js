// Numbers: bounded, rounded, written; and numbers, bytes and texts out of the texts in which a page or a book has them.

export const times = (many, made) => Array.from({ length: many }, (_, i) => made(i));

export const clamped = (least, most, value) => Math.max(least, Math.min(most, value));

// A number with commas between thousands.
export const grouped = (number) => number.toLocaleString("en");

// A number rounded to a whole one, halves to the even one, as the kernel does it.
export function halfToEven(value) {
  const whole = Math.round(value);
  return whole - value === 0.5 && whole % 2 !== 0 ? whole - 1 : whole;
}

const KINDS = { u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, i1: Int8Array, i2: Int16Array, i4: Int32Array };

export function bytesOf(text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

// Whole numbers from the text of their bytes, the lowest first, where they are not numbers already.
export function whole(given) {
  return given.type ? Int32Array.from(new KINDS[given.type](bytesOf(given.data).buffer)) : given;
}

// The text of a deflated stream, which may have no more than so many bytes.
export async function inflated(data, format, most = 100_000_000) {
  const reader = new Blob([data]).stream().pipeThrough(new DecompressionStream(format)).getReader(), parts = [];
  let size = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    size += part.value.length;
    if (size > most) throw new RangeError("a stream that is too long");
  }
  return new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(parts).arrayBuffer());
}
