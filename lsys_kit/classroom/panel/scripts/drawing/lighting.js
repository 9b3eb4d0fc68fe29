// Light and shade (Lambert's cosine law), as in the pictures that stay: the light comes from the left, from above and from behind the
// viewer; far things are paler, as in hazy air.

import { lineColour, mixed } from "./colours.js";
import { AMBIENT, DARKEST, EDGE_ON, HAZE, HIGHLIGHT, LIGHTEST, OWN, REACH, SPHERE, STEPS, TO_LIGHT } from "./constants.js";

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
