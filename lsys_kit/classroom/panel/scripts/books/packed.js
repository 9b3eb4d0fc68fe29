// Texts as pages have them, as document.py packs them: deflated, in digits to the base 85.

const DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;.=>?@^_`{|}~";
const LAST = "~"; // stands for the digits that a group lacks

// Five digits are a number of four bytes.
function bytesIn(text) {
  const whole = text.padEnd(Math.ceil(text.length / 5) * 5, LAST), bytes = new DataView(new ArrayBuffer((whole.length / 5) * 4));
  const values = new Map([...DIGITS].map((digit, value) => [digit, value]));
  for (let i = 0, group = 0; i < whole.length; i += 1) {
    group = group * 85 + values.get(whole[i]);
    if (i % 5 < 4) continue;
    bytes.setUint32(((i - 4) / 5) * 4, group);
    group = 0;
  }
  return bytes.buffer.slice(0, Math.floor((text.length * 4) / 5));
}

export const unpacked = (text) => new Response(new Blob([bytesIn(text)]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
