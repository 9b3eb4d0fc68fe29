// A turtle's path in the plane, turned by an angle without asking the kernel.
//
// For each step forward the kernel has sent, once: how often the turtle has turned by the angle, how many degrees it has
// turned besides, how far it goes, and at the end of which earlier step it starts. Point 0 is the origin, point i + 1 the
// end of step i.

const DEGREES = Math.PI / 180;

function place(path, angle, heading, points) {
  const { n, turns, offsets, lengths, parents } = path, { x, y } = points;
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

function render({ model, el }) {
  let shapes, path, points;

  function load() {
    shapes = unpacked(model);
    const { n, real, whole } = shapes;
    path = { n, turns: real(), offsets: real(), lengths: real(), parents: whole() };
    points = { x: new Float64Array(n + 1), y: new Float64Array(n + 1) };
  }

  function picture(pen, width, height) {
    points.x[0] = points.y[0] = 0;
    const box = place(path, model.get("angle"), model.get("heading"), points), { x, y } = points, more = 2 * shapes.bulge;
    const scale = Math.min((width - 2 * MARGIN) / (box.across + more), (height - 2 * MARGIN) / (box.up + more), LARGEST);
    const x0 = (width - box.across * scale) / 2, y0 = (height + box.up * scale) / 2;
    for (let i = 0; i <= path.n; i++) {
      x[i] = x0 + (x[i] - box.left) * scale;
      y[i] = y0 - (y[i] - box.bottom) * scale;
    }
    paint(pen, model, shapes, points, scale);
  }

  const { leave } = easel(model, el, "img", ["angle"], atOnce, load, picture);
  return leave;
}

export default { render };
