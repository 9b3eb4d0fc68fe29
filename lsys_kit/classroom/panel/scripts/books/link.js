// Links: a model and its settings in the fragment of an address, as lsys_kit/notation/fragments.py writes and reads them.

import { CHECK_BYTES, LINK_MARK, LINK_VERSION } from "../drawing/constants.js";
import { bytesOf, inflated } from "./numbers.js";

const MOST_BYTES = 4_000_000; // of a model in a link

export const hasLink = (address) => address.includes(LINK_MARK);

// What an address says: { notation, settings, text }; null where it has no link, or a broken one.
export async function unpackedLink(address) {
  const at = address.indexOf(LINK_MARK + LINK_VERSION), digits = address.slice(at + LINK_MARK.length + LINK_VERSION.length);
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

export async function packedLink({ notation, settings, text }) {
  const asked = new URLSearchParams(settings).toString(), content = `${notation}${asked ? `?${asked}` : ""}\n${text}`;
  const stream = new Blob([content]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const data = new Uint8Array(await new Response(stream).arrayBuffer());
  const letters = [...data, ...checkOf(data)].map((byte) => String.fromCharCode(byte)).join("");
  return LINK_MARK + LINK_VERSION + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
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
