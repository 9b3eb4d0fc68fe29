// Colours of the panel: the theme of the page around it, shades that can be seen on its paper, and light and shade (Lambert's cosine
// law), as in the pictures that stay; far things are paler, as in hazy air.

import { AMBIENT, CONTRAST, DARKEST, EDGE_ON, FINER, HAZE, HIGHLIGHT, LIGHTEST, OWN, REACH, SPHERE, STEPS, TO_LIGHT } from "./constants.js";

const known = new Map();

// A colour as three numbers from 0 to 255.
export function channels(colour) {
  const digits = colour.length === 4 ? [...colour.slice(1)].map((digit) => digit + digit) : colour.slice(1).match(/../g);
  return digits.map((pair) => parseInt(pair, 16));
}

function hexadecimal(numbers) {
  return "#" + numbers.map((number) => Math.round(number).toString(16).padStart(2, "0")).join("");
}

// A colour mixed with another: 0 is the other, 1 the colour itself.
export function mixed(colour, other, strength) {
  const [a, b] = [channels(colour), channels(other)];
  return hexadecimal(a.map((channel, i) => b[i] + strength * (channel - b[i])));
}

function luminance(colour) {
  const [red, green, blue] = channels(colour).map((channel) => {
    const part = channel / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

export function contrast(one, other) {
  const [less, more] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (more + 0.05) / (less + 0.05);
}

// The colour of a line of a colour on the theme's paper: the one that the theme has for it, no lighter or darker than needed.
export function lineColour(colour, theme) {
  const key = colour + theme.paper;
  if (!known.has(key)) {
    const own = theme.lines?.[colour.toLowerCase()] ?? colour;
    let strength = 1, shade = own;
    while (contrast(shade, theme.paper) < CONTRAST && strength > 0) shade = mixed(own, theme.ink, (strength -= FINER));
    known.set(key, shade);
  }
  return known.get(key);
}

export function fillColour(colour, theme, strength) {
  return mixed(colour, theme.paper, strength);
}

const LIGHT = { ink: "#22303c", quiet: "#5b6875", paper: "#ffffff", mark: "#fff2c2", "mark-edge": "#8f6400", lit: "#b03a00" };

// The theme of an element, from the variables of its style; the light one while it is not in the page yet.
export function themeOf(element) {
  const styles = getComputedStyle(element), read = (name) => styles.getPropertyValue(`--lsys-${name}`).trim() || LIGHT[name] || "";
  return {
    ink: read("ink"), quiet: read("quiet"), paper: read("paper"), mark: read("mark"), markEdge: read("mark-edge"),
    lit: read("lit"), lines: Object.fromEntries(read("lines").match(/#\w{6} #\w{6}/g)?.map((pair) => pair.split(" ")) ?? []), dark: luminance(read("paper")) < 0.2,
  };
}

// Call `changed` whenever the colours around an element may be others, until the returned function is called.
export function whenRecoloured(element, changed) {
  const watcher = new MutationObserver(changed), placed = new ResizeObserver(changed); // it may enter the page later
  watcher.observe(document.body, { attributes: true });
  placed.observe(element);
  const scheme = matchMedia("(prefers-color-scheme: dark)");
  scheme.addEventListener("change", changed);
  return () => {
    watcher.disconnect();
    placed.disconnect();
    scheme.removeEventListener("change", changed);
  };
}

// The shades of a palette on the paper, each mixed once: of a colour, as near as from 0 to 1 and as bright as some steps.
export function shades(palette, theme) {
  const known = new Map(), lines = palette.map((colour) => lineColour(colour, theme));
  return (colour, near = 1, bright = OWN) => {
    const haze = Math.round(near * STEPS), key = (colour * (STEPS + 1) + haze) * (STEPS + 1) + bright;
    if (!known.has(key)) known.set(key, mixed(lit(lines[colour], bright), theme.paper, 1 - HAZE * (1 - haze / STEPS)));
    return known.get(key);
  };
}

function lit(colour, bright) {
  return bright > OWN ? mixed(colour, "#ffffff", 1 - (LIGHTEST * (bright - OWN)) / (STEPS - OWN))
    : mixed(colour, "#000000", 1 - (DARKEST * (OWN - bright)) / OWN);
}

// How bright a surface is, in steps, given its normal: to the right, up, towards the viewer; from behind it is as from the front.
export function brightness(normal) {
  const length = Math.hypot(...normal) || 1, way = (normal[2] < -EDGE_ON * length ? -1 : 1) / length;
  const facing = normal.reduce((sum, part, i) => sum + part * way * TO_LIGHT[i], 0);
  return Math.round(STEPS * (AMBIENT + (1 - AMBIENT) * Math.max(0, facing)));
}

// The colour of a sphere on the canvas: lighter towards the light, darker away from it.
export function sphereFill(pen, x, y, radius, shade) {
  const [left, top] = [x + radius * HIGHLIGHT[0], y - radius * HIGHLIGHT[1]], fill = pen.createRadialGradient(left, top, 0, left, top, radius * REACH);
  for (const [share, bright] of SPHERE) fill.addColorStop(share, shade(bright));
  return fill;
}
