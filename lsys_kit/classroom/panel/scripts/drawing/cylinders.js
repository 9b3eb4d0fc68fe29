// Strokes in space: tapered cylinders with round ends, with a light stripe along them and a dark one, as in the pictures that stay.

import { DARK, LIT, RIM, TO_LIGHT } from "./constants.js";

// How broad each stroke begins: as broad as the last stroke of its branch that ends there, where the turtle has set the widths.
export function startWidths({ n, from, to, orders, widths }, single) {
  if (widths.some((width) => width <= 0)) return single;
  const ending = new Map(), branch = (point, i) => point * (1 << 20) + orders[i];
  for (let i = 0; i < n; i++) ending.set(branch(to[i], i), single[i]);
  return single.map((width, i) => ending.get(branch(from[i], i)) ?? width);
}

// A stroke between two points on the canvas with its radii there: its outline, its light and its dark stripe.
export function cylinder([ax, ay], [bx, by], [ra, rb]) {
  const length = Math.hypot(bx - ax, by - ay), along = length > 0 ? [(bx - ax) / length, (by - ay) / length] : [0, -1];
  const left = [along[1], -along[0]], brightest = Math.atan2(left[0] * TO_LIGHT[0] - left[1] * TO_LIGHT[1], TO_LIGHT[2]);
  const away = brightest < 0 ? 1 : -1;
  const at = (end, angle) => {
    const [x, y, radius, way] = end ? [bx, by, rb, 1] : [ax, ay, ra, -1], aside = radius * Math.sin(angle), ahead = way * radius * Math.cos(angle);
    return [x + aside * left[0] + ahead * along[0], y + aside * left[1] + ahead * along[1]];
  };
  const stripe = (first, last) => {
    const middle = (first + last) / 2;
    return polygon([at(0, middle), at(0, first), at(1, first), at(1, middle), at(1, last), at(0, last)]);
  };
  return { body: capsule(ax, ay, bx, by, ra, rb, Math.atan2(left[1], left[0])),
    light: stripe(Math.max(brightest - LIT, -RIM), Math.min(brightest + LIT, RIM)),
    dark: stripe(brightest + away * DARK, (away * Math.PI) / 2) };
}

function capsule(ax, ay, bx, by, ra, rb, left) {
  const path = new Path2D();
  path.arc(bx, by, rb, left, left + Math.PI);
  path.arc(ax, ay, ra, left + Math.PI, left + 2 * Math.PI);
  path.closePath();
  return path;
}

function polygon(corners) {
  const path = new Path2D();
  for (const corner of corners) path.lineTo(...corner);
  path.closePath();
  return path;
}
