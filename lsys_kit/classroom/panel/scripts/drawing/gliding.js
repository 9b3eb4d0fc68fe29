// What is on its way from one step to the next: everything begins where its mother was, and ends at its own place.

// Shapes whose strokes are on their way from those of their mothers: 0 there, 1 at their own place.
export function strokesBetween(from, to, mothers, share) {
  const first = new Map();
  for (let i = 0; i < from.strokes.n; i++) if (!first.has(from.strokes.positions[i])) first.set(from.strokes.positions[i], i);
  const many = 2 * to.strokes.n, x = new Float64Array(to.n + many), y = new Float64Array(to.n + many);
  const z = to.z && new Float64Array(to.n + many), starts = new Int32Array(to.strokes.n), stops = new Int32Array(to.strokes.n);
  x.set(to.x);
  y.set(to.y);
  if (z) z.set(to.z);
  for (let i = 0; i < to.strokes.n; i++) {
    const mother = first.get(mothers[to.strokes.positions[i]]), ends = [to.strokes.from[i], to.strokes.to[i]];
    [starts[i], stops[i]] = [to.n + 2 * i, to.n + 2 * i + 1];
    ends.forEach((end, k) => {
      const start = mother === undefined ? ends[0] : [from.strokes.from[mother], from.strokes.to[mother]][k];
      const there = mother === undefined ? to : from, at = to.n + 2 * i + k;
      x[at] = there.x[start] + share * (to.x[end] - there.x[start]);
      y[at] = there.y[start] + share * (to.y[end] - there.y[start]);
      if (z) z[at] = there.z[start] + share * (to.z[end] - there.z[start]);
    });
  }
  return { ...to, n: to.n + many, x, y, z, strokes: { ...to.strokes, from: starts, to: stops } };
}

// A sequence whose last row is on its way from the row above; `mothers` are the positions of the mothers in the word before.
export function rowBetween(sheet, mothers, share) {
  const { cells } = sheet, last = sheet.rows.length - 1, above = new Map();
  if (last < 1) return sheet;
  const [x, y, length] = [cells.x, cells.y, cells.length].map((column) => column.slice());
  for (let i = cells.starts[last - 1]; i < cells.starts[last]; i++) above.set(cells.position[i], i);
  for (let i = cells.starts[last]; i < cells.starts[last + 1]; i++) {
    const mother = above.get(mothers[cells.position[i]]);
    if (mother === undefined) continue;
    for (const [column, own] of [[x, cells.x], [y, cells.y], [length, cells.length]]) column[i] = own[mother] + share * (own[i] - own[mother]);
  }
  return { ...sheet, cells: { ...cells, x, y, length } };
}
