// Links: a model and its settings in the fragment of an address, as lsys_kit/notation/fragments.py writes and reads them.

const MARK = "#lsys=", VERSION = "a", CHECK_BYTES = 3;
const MOST_BYTES = 4_000_000; // of a model in a link

// What an address says: { notation, settings, text }; null where it has no link, or a broken one.
export async function unpackedLink(address) {
  const at = address.indexOf(MARK + VERSION), digits = address.slice(at + MARK.length + VERSION.length);
  if (at < 0 || !/^[\w-]+$/.test(digits)) return null;
  try {
    const data = bytesOf(digits.replaceAll("-", "+").replaceAll("_", "/")), stream = data.subarray(0, -CHECK_BYTES);
    if (data.subarray(-CHECK_BYTES).join() !== checkOf(stream).join()) return null;
    const content = await inflated(stream, "deflate-raw", MOST_BYTES), end = content.indexOf("\n");
    const [notation, asked] = content.slice(0, end).split(/\?(.*)/s);
    return { notation, settings: Object.fromEntries(new URLSearchParams(asked ?? "")), text: content.slice(end + 1) };
  } catch {
    return null;
  }
}

// The fragment, with its mark, that says this.
export async function packedLink({ notation, settings, text }) {
  const asked = new URLSearchParams(settings).toString(), content = `${notation}${asked ? `?${asked}` : ""}\n${text}`;
  const stream = new Blob([content]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const data = new Uint8Array(await new Response(stream).arrayBuffer());
  const letters = [...data, ...checkOf(data)].map((byte) => String.fromCharCode(byte)).join("");
  return MARK + VERSION + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

// The bytes of a text in base 64.
export function bytesOf(text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

// The text of a deflated stream, which may have no more than so many bytes.
export async function inflated(data, format, most) {
  const reader = new Blob([data]).stream().pipeThrough(new DecompressionStream(format)).getReader(), parts = [];
  let size = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    size += part.value.length;
    if (size > most) throw new RangeError("a stream that is too long");
  }
  return new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(parts).arrayBuffer());
}

// The last bytes of the CRC-32 (ISO 3309) of some bytes.
function checkOf(data) {
  let rest = -1;
  for (const byte of data) {
    rest ^= byte;
    for (let bit = 0; bit < 8; bit += 1) rest = (rest >>> 1) ^ (rest & 1 ? 0xedb88320 : 0);
  }
  return [16, 8, 0].map((shift) => (~rest >>> shift) & 255);
}
