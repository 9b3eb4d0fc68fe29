// A turtle's path, turned by an angle without asking the kernel.
//
// For each step forward the kernel has sent, once: how often the turtle has turned by the angle, how many degrees it has
// turned besides, how far it goes, and at the end of which earlier step it starts. There is no grammar here.

const DEGREES = Math.PI / 180;
const STROKES = [2.4, 1.7, 1.3, 1.0];
const MARGIN = 14;

function unpacked(model) {
  const view = model.get("path");
  const bytes = view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength);
  const n = bytes.byteLength / 20;
  const floats = new Float32Array(bytes, 0, 3 * n);
  const path = {
    n,
    turns: floats.subarray(0, n),
    offsets: floats.subarray(n, 2 * n),
    lengths: floats.subarray(2 * n, 3 * n),
    parents: new Int32Array(bytes, 12 * n, n),
    looks: new Int32Array(bytes, 16 * n, n), // colour * 16 + order * 4 + marked * 2 + drawn
    x: new Float64Array(n + 1),
    y: new Float64Array(n + 1),
    groups: new Map(),
  };
  for (let i = 0; i < n; i++) {
    const look = path.looks[i];
    if (look & 1) {
      if (!path.groups.has(look)) path.groups.set(look, []);
      path.groups.get(look).push(i);
    }
  }
  return path;
}

function place(path, angle, heading) {
  const { n, turns, offsets, lengths, parents, x, y } = path;
  let left = 0, right = 0, bottom = 0, top = 0;
  for (let i = 0; i < n; i++) {
    const direction = (turns[i] * angle + offsets[i] + heading) * DEGREES;
    const from = parents[i] + 1;
    const px = x[from] + lengths[i] * Math.cos(direction);
    const py = y[from] + lengths[i] * Math.sin(direction);
    x[i + 1] = px;
    y[i + 1] = py;
    if (px < left) left = px; else if (px > right) right = px;
    if (py < bottom) bottom = py; else if (py > top) top = py;
  }
  return { left, bottom, across: Math.max(right - left, 1e-9), up: Math.max(top - bottom, 1e-9) };
}

function strokes(path, indices, box, scale, x0, y0) {
  const { x, y, parents } = path;
  const line = new Path2D();
  for (const i of indices) {
    const from = parents[i] + 1;
    line.moveTo(x0 + (x[from] - box.left) * scale, y0 - (y[from] - box.bottom) * scale);
    line.lineTo(x0 + (x[i + 1] - box.left) * scale, y0 - (y[i + 1] - box.bottom) * scale);
  }
  return line;
}

function render({ model, el }) {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("role", "img");
  canvas.style.cssText = "width:100%;height:380px;display:block;background:#fff";
  el.appendChild(canvas);
  const pen = canvas.getContext("2d");
  let path = unpacked(model);

  function draw() {
    const width = canvas.clientWidth, height = canvas.clientHeight, density = window.devicePixelRatio || 1;
    if (!width || !height) return;
    if (canvas.width !== Math.round(width * density) || canvas.height !== Math.round(height * density)) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
    }
    const box = place(path, model.get("angle"), model.get("heading"));
    const scale = Math.min((width - 2 * MARGIN) / box.across, (height - 2 * MARGIN) / box.up, 120);
    const x0 = (width - box.across * scale) / 2, y0 = (height + box.up * scale) / 2;
    pen.setTransform(density, 0, 0, density, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.lineCap = "round";
    const thin = Math.min(1, Math.max(0.3, (model.get("typical") * scale) / 12));
    const lines = [...path.groups].map(([look, indices]) => [look, strokes(path, indices, box, scale, x0, y0)]);
    for (const [look, line] of lines) {
      if (look & 2) {
        pen.strokeStyle = model.get("mark");
        pen.globalAlpha = 0.45;
        pen.lineWidth = Math.max(5, 9 * thin);
        pen.stroke(line);
        pen.globalAlpha = 1;
      }
    }
    const colours = model.get("colours");
    for (const [look, line] of lines) {
      pen.strokeStyle = colours[look >> 4];
      pen.lineWidth = STROKES[(look >> 2) & 3] * thin;
      pen.stroke(line);
    }
    canvas.dataset.drawn = Number(canvas.dataset.drawn || 0) + 1;
    canvas.dataset.angle = model.get("angle");
  }

  function describe() {
    canvas.setAttribute("aria-label", model.get("description"));
  }

  function load() {
    path = unpacked(model);
    draw();
  }

  model.on("change:path", load);
  model.on("change:angle", draw);
  model.on("change:description", describe);
  describe();
  const resized = new ResizeObserver(draw);
  resized.observe(canvas);
  return () => {
    resized.disconnect();
    model.off("change:path", load);
    model.off("change:angle", draw);
    model.off("change:description", describe);
  };
}

export default { render };
