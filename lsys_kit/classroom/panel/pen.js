// What the canvases have in common: the shapes that the kernel has sent, and how they are painted.
//
// A shape says which points it joins, by their numbers; where the points are, each canvas finds out by itself.

const STROKES = [2.4, 1.7, 1.3, 1.0];
const THINNEST = 0.3; // how much thinner strokes become where they stand close
const THINNEST_IN_SPACE = 0.6;
const MARGIN = 14;
const LARGEST = 120; // pixels a unit
const LAYERS = 32; // of a drawing in space, from far to near
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
    get bulge() {
      return this.rounds.radii.reduce((most, radius) => Math.max(most, radius), 0);
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

// Shapes by their layers; strokes that look alike in one line.
function sorted({ strokes, faces, rounds }, points, scale, thin) {
  const { x, y, z, reach } = points;
  const count = z ? LAYERS : 1;
  const layers = Array.from({ length: count }, () => ({ faces: [], lines: new Map(), rounds: [] }));
  const layer = (depth) => layers[z ? Math.max(0, Math.min(count - 1, Math.floor((depth / reach + 1) * 0.5 * count))) : 0];
  for (let i = 0; i < strokes.n; i++) {
    const a = strokes.from[i], b = strokes.to[i], look = strokes.looks[i], given = strokes.widths[i];
    const width = given < 0 ? STROKES[(look >> 2) & 3] * thin : Math.max(0.3, Math.round(given * scale * 10) / 10);
    const { lines } = layer(z ? (z[a] + z[b]) / 2 : 0);
    const key = look * 65536 + Math.min(65535, Math.round(width * 100));
    let line = lines.get(key);
    if (!line) lines.set(key, (line = { look, width, path: new Path2D() }));
    line.path.moveTo(x[a], y[a]);
    line.path.lineTo(x[b], y[b]);
  }
  for (let i = 0; i < faces.n; i++) {
    const corners = faces.corners.subarray(faces.starts[i], faces.starts[i + 1]);
    if (!corners.length) continue;
    const depth = z ? corners.reduce((sum, one) => sum + z[one], 0) / corners.length : 0;
    layer(depth).faces.push({ look: faces.looks[i], corners, depth });
  }
  for (let i = 0; i < rounds.n; i++) {
    const centre = rounds.centres[i];
    layer(z ? z[centre] : 0).rounds.push({ look: rounds.looks[i], centre, radius: rounds.radii[i] });
  }
  return layers;
}

function paint(pen, model, shapes, points, scale) {
  const thin = Math.min(1, Math.max(points.z ? THINNEST_IN_SPACE : THINNEST, (model.get("typical") * scale) / 12));
  const colours = model.get("colours"), mark = model.get("mark");
  const layers = sorted(shapes, points, scale, thin);
  pen.lineCap = pen.lineJoin = "round";
  layers.forEach(({ faces, lines, rounds }, number) => {
    const strength = layers.length === 1 ? 1 : 1 - FADING * (1 - number / (layers.length - 1));
    faces.sort((one, other) => one.depth - other.depth);
    for (const { look, corners } of faces) {
      const outline = new Path2D();
      for (const corner of corners) outline.lineTo(points.x[corner], points.y[corner]);
      outline.closePath();
      fill(outline, look, strength, (0.45 + 0.5 * facing(corners, points)) * strength, 0.6);
    }
    for (const { look, width, path } of lines.values()) {
      if (!(look & 2)) continue;
      pen.strokeStyle = mark;
      pen.globalAlpha = 0.45;
      pen.lineWidth = Math.max(5, 9 * thin, width + 4);
      pen.stroke(path);
      pen.globalAlpha = 1;
    }
    for (const { look, width, path } of lines.values()) {
      pen.strokeStyle = tinted(colours[look >> 4], strength);
      pen.lineWidth = width;
      pen.stroke(path);
    }
    for (const { look, centre, radius } of rounds) {
      const circle = new Path2D();
      circle.arc(points.x[centre], points.y[centre], Math.max(0.8, radius * scale), 0, 2 * Math.PI);
      fill(circle, look, strength, look & 1 ? 0 : 0.7 * strength, 1);
    }
  });

  function fill(outline, look, strength, inside, edge) {
    pen.fillStyle = tinted(colours[look >> 4], inside);
    pen.fill(outline);
    pen.strokeStyle = look & 2 ? mark : tinted(colours[look >> 4], strength);
    pen.lineWidth = look & 2 ? 3 : edge;
    pen.stroke(outline);
  }
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
