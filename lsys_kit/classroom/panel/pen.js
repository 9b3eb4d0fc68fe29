// What the canvases have in common: the shapes that the kernel has sent, and how they are painted.
//
// A shape says which points it joins, by their numbers; where the points are, each canvas finds out by itself.

const STROKES = [2.4, 1.7, 1.3, 1.0];
const THINNEST = 0.3; // how much thinner strokes become where they stand close
const THINNEST_IN_SPACE = 0.6;
const MARGIN = 14;
const LARGEST = 120; // pixels a unit
const SLIMMEST = 3, BROADEST = 4000; // the least and the greatest width that a turtle sets, in tenths of a pixel
const LEVELS = 2 ** 15; // of depth, over the extent of a drawing in space
const MOST = 2 ** 31; // more shapes there cannot be
const LAYERS = 32; // of a drawing in space, by which it fades
const FADING = 0.45; // how much paler the farthest layer is than the nearest

// All numbers in one buffer of four bytes each: how many there are, strokes, faces, rounds, and what says where points are.
// A look is colour * 16 + order * 4 + marked * 2 + hollow.
function unpacked(model) {
  const view = model.get("shapes");
  const buffer = view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength);
  let at = 0;
  const take = (Kind, length) => {
    at += 4 * length;
    return new Kind(buffer, at - 4 * length, length);
  };
  const [s, f, c, r, n] = buffer.byteLength ? take(Int32Array, 5) : [0, 0, 0, 0, 0];
  const whole = (length) => take(Int32Array, length), real = (length) => take(Float32Array, length);
  return {
    strokes: { n: s, from: whole(s), to: whole(s), looks: whole(s), widths: real(s) },
    faces: { n: f, starts: whole(f && f + 1), looks: whole(f), corners: whole(c) },
    rounds: { n: r, centres: whole(r), looks: whole(r), radii: real(r) },
    // How far shapes reach beyond their points, in the units of the model.
    get bulge() {
      const reach = this.strokes.widths.reduce((most, width) => Math.max(most, width / 2), 0);
      return this.rounds.radii.reduce((most, radius) => Math.max(most, radius), reach);
    },
    n,
    whole: () => whole(n),
    real: () => real(n),
  };
}

// A colour mixed with white: 0 is white, 1 the colour itself.
function tinted(colour, strength) {
  const channel = (at) => Math.round(255 - strength * (255 - parseInt(colour.slice(at, at + 2), 16)));
  return `rgb(${channel(1)},${channel(3)},${channel(5)})`;
}

// The colours of looks in each strength, each mixed once.
function mixer(colours) {
  const known = new Map();
  return (look, strength) => {
    const key = (look >> 4) + strength / 2;
    let mixed = known.get(key);
    if (mixed === undefined) known.set(key, (mixed = tinted(colours[look >> 4], strength)));
    return mixed;
  };
}

// How much a face looks at the viewer, from 0 to 1; half in the plane.
function facing(corners, { x, y, z }) {
  if (!z) return 0.5;
  let across = 0, up = 0, towards = 0;
  corners.forEach((one, i) => {
    const next = corners[(i + 1) % corners.length];
    across += (y[one] - y[next]) * (z[one] + z[next]);
    up += (z[one] - z[next]) * (x[one] + x[next]);
    towards += (x[one] - x[next]) * (y[one] + y[next]);
  });
  return Math.abs(towards) / (Math.hypot(across, up, towards) || 1);
}

// The width of each stroke, in tenths of a pixel: as the turtle has set it, or by its branch order.
function widthsOf({ n, looks, widths }, scale, thin) {
  const found = new Int32Array(n);
  for (let i = 0; i < n; i++)
    found[i] = widths[i] < 0 ? Math.round(10 * STROKES[(looks[i] >> 2) & 3] * thin)
      : Math.max(SLIMMEST, Math.min(BROADEST, Math.round(10 * widths[i] * scale)));
  return found;
}

// How near each shape is, faces first, then strokes, then rounds: its middle, in levels over the extent of the drawing.
function levelsOf({ strokes, faces, rounds }, { z, extent }) {
  const levels = new Int32Array(faces.n + strokes.n + rounds.n), unit = LEVELS / (extent || 1);
  for (let i = 0; i < faces.n; i++) {
    let sum = 0;
    for (let at = faces.starts[i]; at < faces.starts[i + 1]; at++) sum += z[faces.corners[at]];
    levels[i] = Math.round((sum / (faces.starts[i + 1] - faces.starts[i])) * unit);
  }
  for (let i = 0; i < strokes.n; i++) levels[faces.n + i] = Math.round(((z[strokes.from[i]] + z[strokes.to[i]]) / 2) * unit);
  for (let i = 0; i < rounds.n; i++) levels[faces.n + strokes.n + i] = Math.round(z[rounds.centres[i]] * unit);
  return levels;
}

// The numbers of faces, strokes and rounds, counted in this order, as they are painted: in space from far to near; in the plane
// strokes by colours, and of one colour the broad ones first. The pictures that stay are painted in the same order.
function paintingOrder(shapes, points, widths) {
  const { strokes, faces, rounds } = shapes, many = faces.n + strokes.n + rounds.n, last = faces.n + strokes.n;
  const levels = points.z && levelsOf(shapes, points);
  const rank = (i) => {
    if (levels) return levels[i];
    if (i < faces.n) return -1;
    return i < last ? (strokes.looks[i - faces.n] >> 4) * (BROADEST + 1) + BROADEST - widths[i - faces.n] : 2 ** 21;
  };
  const keys = new Float64Array(many);
  for (let i = 0; i < many; i++) keys[i] = rank(i) * MOST + i;
  keys.sort();
  for (let i = 0; i < many; i++) keys[i] -= Math.floor(keys[i] / MOST) * MOST;
  return keys;
}

function paint(pen, model, shapes, points, scale) {
  const thin = Math.min(1, Math.max(points.z ? THINNEST_IN_SPACE : THINNEST, (model.get("typical") * scale) / 12));
  const shade = mixer(model.get("colours")), mark = model.get("mark");
  const { x, y, z, reach } = points, { strokes, faces, rounds } = shapes;
  const widths = widthsOf(strokes, scale, thin);
  pen.lineCap = pen.lineJoin = "round";
  let runs = [], run; // strokes that nothing lies between; those of a run look alike

  // How strong colours are: the farther, the paler.
  function strengthAt(depth) {
    if (!z) return 1;
    const layer = Math.max(0, Math.min(LAYERS - 1, Math.floor((depth / reach + 1) * 0.5 * LAYERS)));
    return 1 - FADING * (1 - layer / (LAYERS - 1));
  }

  function fill(outline, look, strength, inside, edge) {
    pen.fillStyle = shade(look, inside);
    pen.fill(outline);
    pen.strokeStyle = look & 2 ? mark : shade(look, strength);
    pen.lineWidth = look & 2 ? 3 : edge;
    pen.stroke(outline);
  }

  function addStroke(i) {
    const a = strokes.from[i], b = strokes.to[i], look = strokes.looks[i], width = widths[i] / 10;
    const strength = strengthAt(z ? (z[a] + z[b]) / 2 : 0);
    if (!run || run.look !== look || run.width !== width || run.strength !== strength)
      runs.push((run = { look, width, strength, path: new Path2D() }));
    run.path.moveTo(x[a], y[a]);
    run.path.lineTo(x[b], y[b]);
  }

  function paintStrokes() {
    for (const { look, width, path } of runs) {
      if (!(look & 2)) continue;
      pen.strokeStyle = mark;
      pen.globalAlpha = 0.45;
      pen.lineWidth = Math.max(5, 9 * thin, width + 4);
      pen.stroke(path);
      pen.globalAlpha = 1;
    }
    for (const { look, width, strength, path } of runs) {
      pen.strokeStyle = shade(look, strength);
      pen.lineWidth = width;
      pen.stroke(path);
    }
    runs = [];
    run = undefined;
  }

  function paintFace(i) {
    const corners = faces.corners.subarray(faces.starts[i], faces.starts[i + 1]);
    const strength = strengthAt(z ? corners.reduce((sum, one) => sum + z[one], 0) / corners.length : 0);
    const outline = new Path2D();
    for (const corner of corners) outline.lineTo(x[corner], y[corner]);
    outline.closePath();
    fill(outline, faces.looks[i], strength, (0.45 + 0.5 * facing(corners, points)) * strength, 0.6);
  }

  function paintRound(i) {
    const centre = rounds.centres[i], look = rounds.looks[i], strength = strengthAt(z ? z[centre] : 0);
    const circle = new Path2D();
    circle.arc(x[centre], y[centre], Math.max(0.8, rounds.radii[i] * scale), 0, 2 * Math.PI);
    fill(circle, look, strength, look & 1 ? 0 : 0.7 * strength, 1);
  }

  for (const number of paintingOrder(shapes, points, widths)) {
    const stroke = number - faces.n;
    if (stroke >= 0 && stroke < strokes.n) {
      addStroke(stroke);
      continue;
    }
    paintStrokes();
    if (stroke < 0) paintFace(number);
    else paintRound(stroke - strokes.n);
  }
  paintStrokes();
}

const atOnce = (draw) => draw;

function atNextFrame(draw) {
  let waiting = 0;
  return () => {
    waiting = waiting || requestAnimationFrame(() => {
      waiting = 0;
      draw();
    });
  };
}

// A canvas in its element: redrawn when its shapes change, its size, or one of the traits.
function easel(model, el, role, traits, when, load, picture) {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("role", role);
  canvas.style.cssText = "width:100%;height:380px;display:block;background:#fff";
  el.appendChild(canvas);
  const pen = canvas.getContext("2d");

  function draw() {
    const width = canvas.clientWidth, height = canvas.clientHeight, density = window.devicePixelRatio || 1;
    if (!width || !height) return;
    if (canvas.width !== Math.round(width * density) || canvas.height !== Math.round(height * density)) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
    }
    pen.setTransform(density, 0, 0, density, 0, 0);
    pen.clearRect(0, 0, width, height);
    picture(pen, width, height);
    canvas.dataset.drawn = Number(canvas.dataset.drawn || 0) + 1;
    for (const trait of traits) canvas.dataset[trait] = model.get(trait);
  }

  function describe() {
    canvas.setAttribute("aria-label", model.get("description"));
  }

  function reload() {
    load();
    draw();
  }

  const heard = [["change:shapes", reload], ["change:description", describe],
    ...traits.map((trait) => [`change:${trait}`, when(draw)])];
  for (const [events, answer] of heard) model.on(events, answer);
  load();
  describe();
  const resized = new ResizeObserver(draw);
  resized.observe(canvas);
  const leave = () => {
    resized.disconnect();
    for (const [events, answer] of heard) model.off(events, answer);
  };
  return { canvas, draw, leave };
}
