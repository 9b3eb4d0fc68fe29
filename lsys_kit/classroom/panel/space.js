// A plant in space, turned by mouse and keyboard without asking the kernel; seen from far away, as in the picture that stays.
//
// x grows to the right, z upwards, and y away from a viewer who stands at the front, at 0 degrees around and 0 above.

const DEGREES = Math.PI / 180;
const TURN = 5; // degrees a key press
const PULL = 0.5; // degrees a pixel of the mouse
const ZOOM = 1.2;
const NEAREST = 20;
const MOVE = 30; // pixels a key press

const HINT = "drag or arrow keys: turn \u00b7 + \u2212: nearer, farther \u00b7 Home: back";

const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const NEARER = { "+": ZOOM, "=": ZOOM, "-": 1 / ZOOM, _: 1 / ZOOM };

// The upright cylinder around a plant: its middle, half its width and half its height; no turn leads out of it. And the
// extent of the plant, the greatest of its three.
function cylinder({ x, y, z, n }, bulge) {
  const ends = [x, y, z].map((places) => {
    let least = n ? Infinity : 0, most = n ? -Infinity : 0;
    for (const place of places) {
      if (place < least) least = place;
      if (place > most) most = place;
    }
    return [least, most];
  });
  const middle = ends.map(([least, most]) => (least + most) / 2);
  let across = 1e-9;
  for (let i = 0; i < n; i++) across = Math.max(across, Math.hypot(x[i] - middle[0], y[i] - middle[1]));
  const extent = Math.max(...ends.map(([least, most]) => most - least));
  return { middle, extent, across: across + bulge, up: Math.max(1e-9, (ends[2][1] - ends[2][0]) / 2) + bulge };
}

// The points as they are seen: x to the right and y down in pixels, z towards the viewer.
function projected(solid, around, above, fit, points) {
  const { x, y, z, n, extent, across, up, middle: [cx, cy, cz] } = solid;
  const cos = Math.cos(around * DEGREES), sin = Math.sin(around * DEGREES);
  const level = Math.cos(above * DEGREES), steep = Math.sin(above * DEGREES);
  const { scale, x0, y0 } = fit(across, up * level + across * Math.abs(steep));
  for (let i = 0; i < n; i++) {
    const px = x[i] - cx, py = y[i] - cy, pz = z[i] - cz;
    const towards = px * sin - py * cos;
    points.x[i] = x0 + (px * cos + py * sin) * scale;
    points.y[i] = y0 - (pz * level - towards * steep) * scale;
    points.z[i] = (towards * level + pz * steep) * scale;
  }
  points.extent = extent * scale;
  points.reach = (across * level + up * Math.abs(steep)) * scale;
  return scale;
}

function render({ model, el }) {
  let shapes, solid, points, shift = [0, 0], pull = [0, 0];

  function load() {
    shapes = unpacked(model);
    const { n, real } = shapes;
    solid = { n, x: real(), y: real(), z: real() };
    Object.assign(solid, cylinder(solid, shapes.bulge));
    points = { x: new Float64Array(n), y: new Float64Array(n), z: new Float64Array(n) };
  }

  function picture(pen, width, height) {
    const near = model.get("near");
    if (near === 1) shift = [0, 0];
    const fit = (across, up) => ({
      scale: Math.min((width / 2 - MARGIN) / across, (height / 2 - MARGIN) / up, LARGEST) * near,
      x0: width / 2 + shift[0],
      y0: height / 2 + shift[1],
    });
    const scale = projected(solid, model.get("around"), model.get("above"), fit, points);
    paint(pen, model, shapes, points, scale);
  }

  const { canvas, draw, leave } = easel(model, el, "application", ["around", "above", "near"], atNextFrame, load, picture);
  canvas.tabIndex = 0;
  canvas.setAttribute("aria-roledescription", "drawing to be turned");
  canvas.setAttribute("data-lm-suppress-shortcuts", "true");
  canvas.style.cursor = "grab";
  canvas.style.touchAction = "pan-y";
  const hint = document.createElement("div");
  hint.setAttribute("aria-hidden", "true");
  hint.style.cssText = "font:12px sans-serif;opacity:.75;padding:2px 0";
  hint.textContent = HINT;
  el.appendChild(hint);

  function turn(right, up) {
    model.set("around", ((((Math.round(model.get("around") + right) + 180) % 360) + 360) % 360) - 180);
    model.set("above", Math.max(-90, Math.min(90, Math.round(model.get("above") + up))));
    model.save_changes();
  }

  function move(right, down) {
    if (model.get("near") === 1) return;
    shift = [shift[0] + right, shift[1] + down];
    draw();
  }

  // Come nearer, so that one point of the canvas stays where it is; by default its middle.
  function come(nearer, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) {
    const before = model.get("near"), wanted = Math.min(NEAREST, before * nearer), near = wanted < 1.01 ? 1 : wanted;
    const from = [x - canvas.clientWidth / 2, y - canvas.clientHeight / 2];
    shift = shift.map((places, i) => from[i] + ((places - from[i]) * near) / before);
    model.set("near", near);
    model.save_changes();
  }

  function goBack() {
    for (const [trait, value] of [["around", 0], ["above", 0], ["near", 1]]) model.set(trait, value);
    model.save_changes();
  }

  function press(event) {
    const arrow = ARROWS[event.key], nearer = NEARER[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || !(arrow || nearer || event.key === "Home")) return;
    event.preventDefault();
    event.stopPropagation();
    if (nearer) come(nearer);
    else if (!arrow) goBack();
    else if (event.shiftKey) move(-arrow[0] * MOVE, arrow[1] * MOVE);
    else turn(arrow[0] * TURN, arrow[1] * TURN);
  }

  function drag(event) {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    if (event.shiftKey) move(event.movementX, event.movementY);
    else pull = [pull[0] - event.movementX * PULL, pull[1] + event.movementY * PULL];
    const whole = pull.map(Math.trunc);
    if (whole[0] || whole[1]) turn(...whole);
    pull = pull.map((part, i) => part - whole[i]);
  }

  function wheel(event) {
    if (document.activeElement !== canvas) return;
    event.preventDefault();
    come(ZOOM ** (-event.deltaY / 100), event.offsetX, event.offsetY);
  }

  canvas.addEventListener("keydown", press);
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    pull = [0, 0];
  });
  canvas.addEventListener("pointermove", drag);
  canvas.addEventListener("wheel", wheel, { passive: false });
  model.on("change:returns", goBack);
  return () => {
    model.off("change:returns", goBack);
    leave();
  };
}

export default { render };
