// Outlines on a canvas: how they are stroked and filled, surrounded where a cell is traced, and whether a point lies in one; and letters.

const LINES = { self: [4, []], mother: [3, [7, 5]], daughter: [5, []] }; // around what is traced: width and dashes

// Around a part of what is traced; told apart without colours.
export function surround(pen, path, kind, theme) {
  const [width, dashes] = LINES[kind];
  line(pen, path, theme.lit, width, dashes);
  if (kind === "daughter") line(pen, path, theme.paper, 2);
}

// A canvas as large as it is shown, empty; nothing, if it is not shown.
export function cleared(canvas, theme) {
  const width = canvas.clientWidth, height = canvas.clientHeight, density = window.devicePixelRatio || 1, pen = canvas.getContext("2d");
  if (!width || !height) return null;
  const sizes = [width, height].map((size) => Math.round(size * density));
  if (canvas.width !== sizes[0] || canvas.height !== sizes[1]) [canvas.width, canvas.height] = sizes;
  pen.setTransform(density, 0, 0, density, 0, 0);
  pen.fillStyle = theme.paper;
  pen.fillRect(0, 0, width, height);
  return { pen, width, height };
}

export function line(pen, path, colour, width, dashes = []) {
  [pen.strokeStyle, pen.lineWidth] = [colour, width];
  pen.setLineDash(dashes);
  pen.stroke(path);
  pen.setLineDash([]);
}

export function fill(pen, path, colour) {
  pen.fillStyle = colour;
  pen.fill(path);
}

export function write(pen, text, x, y, colour, font, align = "left") {
  [pen.fillStyle, pen.font, pen.textAlign] = [colour, font, align];
  pen.fillText(text, x, y);
}

export function outline(points, place, closed = true) {
  const path = new Path2D();
  for (const point of points) {
    const [x, y] = place(point);
    path.lineTo(x, y);
  }
  if (closed) path.closePath();
  return path;
}

export function isInside(row, x, y) {
  let inside = false;
  row.forEach(([xa, ya], k) => {
    const [xb, yb] = row[(k + 1) % row.length];
    if ((ya > y) !== (yb > y) && x < xa + ((y - ya) / (yb - ya)) * (xb - xa)) inside = !inside;
  });
  return inside;
}

export function cornersOf({ starts, corners }, i) {
  return corners.subarray(starts[i], starts[i + 1]);
}

export function meanOf(places, numbers) {
  let sum = 0;
  for (const number of numbers) sum += places[number];
  return sum / numbers.length;
}
