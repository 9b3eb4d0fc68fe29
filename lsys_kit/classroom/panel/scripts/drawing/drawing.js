// The drawing of a step on a canvas: a filament's rows, or what the turtle draws, turned, moved and brought nearer by the browser alone.

import { clamped } from "../books/numbers.js";
import { eachFrame, made, onKey, onMouse, worded } from "../views/controls.js";
import { remember, remembered } from "../views/folding.js";
import { relaxing } from "../views/relaxing.js";
import { cellAt, paintSequence, sequence } from "./filament.js";
import { grownShapes, mapShapes, paintCells, paintMapScale, paintWallSigns, wallSigns } from "./map.js";
import { cleared } from "./outlines.js";
import { paint, shapeAt } from "./painter.js";
import { boundsOf, frameOf, widthAndHeight } from "./projection.js";
import { LONGEST_ARROW, paintForces } from "./tension.js";
import { cellUnder, litCells, paintTissue, tissueFrame, tissueShapes } from "./tissue.js";
import { placed, traced } from "./turtle.js";

const IN_THE_PLANE = "+, − or, after a click, the wheel zooms; arrows move it, Home puts it back.";
const IN_SPACE = "Drag or arrow keys turn it. +, − or, after a click, the wheel zooms; Shift and arrows move it, Home puts it back.";
const CELL = "Point at a cell or click it to trace it; N and P go to the next and previous one.", TAP_CELL = "Tap a cell to trace it.";
const TRACED = {
  plane: "Point at a part or click it to trace it; N and P go to the next and previous one.",
  map: "Point at a wall or click it to trace it; N and P go to the next and previous one.", filament: CELL, tissue: CELL,
};
const FINGERS = "Two fingers bring it nearer.", FINGER = "A finger turns it.";
const TAPPED = { plane: "Tap a part to trace it.", map: "Tap a wall to trace it.", filament: TAP_CELL, tissue: TAP_CELL };

const TURN = 5, MOVE = 30, ZOOM = 1.25, NEAREST = 40, PULL = 0.5; // of keys and of the pointer
const REACH = { mouse: 6, touch: 14 }; // pixels from a part that is pointed at
const CLICK = 4; // pixels that a pointer may move in a click
const MOST_GLIDING = 20_000; // modules of a step that is reached on the way
const GLIDE = 350; // milliseconds from one step to the next
const BESIDE_ARROWS = 0.27; // how far along a wall its label stands, where in its middle an arrow begins
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const NEARER = { "+": ZOOM, "=": ZOOM, "-": 1 / ZOOM };

// `told` has { view(), front(), turned(around, above), traced(step, position), pointed(step, position) }; position -1 is nothing;
// and perhaps over(pen, shapes, frame, look), which paints shapes, or a sequence without a frame, in a way of its own, or says that it
// does not, and between(now), the shapes of a part of the way to the next step, or null.
export function drawingView(parent, told) {
  const canvas = made("canvas.lsys-canvas", { tabindex: 0, role: "img" });
  const hint = made("div.lsys-hint", { "aria-hidden": "true", hidden: Boolean(remembered("drawn")) });
  parent.append(made("div.lsys-sheet", canvas, hint));
  const touched = matchMedia("(hover: none)").matches, pen = canvas.getContext("2d"), pointers = new Map(), draw = eachFrame(paintNow);
  let book, now, look, fault = "", shapes, frame, sheet, glide = null;
  let near = 1, shift = [0, 0], pull = [0, 0], pressed = null, spread = 0;
  let isFilament, isMap, isTissue, inSpace; // how the book is drawn
  let signs = null, relaxed = null, choice = null; // of walls, of forces, of the cells that are lit, where there are such

  function open(next) {
    book = next;
    [isFilament, isMap, isTissue] = ["filament", "map", "tissue"].map((mode) => mode === book.data.mode);
    inSpace = isTissue || book.data.mode === "space";
    [near, shift, glide] = [1, [0, 0], null];
    canvas.ariaDescription = uses(inSpace ? IN_SPACE : IN_THE_PLANE, TRACED);
    hint.textContent = touched ? uses(inSpace ? FINGER : FINGERS, TAPPED) : canvas.ariaDescription;
    canvas.classList.toggle("lsys-turned", inSpace);
    if (isMap && !signs) {
      [signs, relaxed] = [wallSigns(draw), relaxing(draw)];
      parent.append(signs.element, relaxed.element);
    }
    signs?.offer(book);
    relaxed?.offer(book);
    if (isTissue && !choice) parent.append((choice = litCells(draw)).element);
    choice?.offer(book, 0);
  }

  const uses = (turned, traced) => [turned, traced[book.data.mode] ?? traced.plane].map((text) => worded(text)).join(" ");

  // Show what is asked for: { step, angle, around, above, boxed: the step whose frame is kept, or null, glides }.
  function show(asked, nextLook) {
    const before = now, old = shapes;
    [now, look, fault] = [{ ...asked }, nextLook, ""];
    if (!isFilament) shapes = shapesOf(now.step) ?? shapes;
    if (isMap) relaxed.goTo(now.step);
    choice?.offer(book, now.step);
    if (asked.glides && before && !isTissue && (old || isFilament) && now.step === before.step + 1 && book.length(now.step) < MOST_GLIDING)
      glide = { from: old, started: performance.now(), mothers: mothersOf(now.step) };
    else if (before && before.step !== now.step) glide = null;
    draw.cancel();
    paintNow();
  }

  // The shapes of a step; null where the turtle cannot draw them, and why.
  function shapesOf(step) {
    try {
      return isMap ? mapShapes(book, step) : isTissue ? tissueShapes(book, step) : placed(traced(book, step), now.angle);
    } catch (error) {
      fault = error.message;
      return null;
    }
  }

  function mothersOf(step) {
    const found = new Int32Array(book.length(step));
    for (let i = 0; i < found.length; i++) found[i] = book.mother(step, i);
    return found;
  }

  function paintNow() {
    const place = now && cleared(canvas, look.theme);
    if (!place) return;
    const { width, height } = place;
    if (isFilament) {
      sheet = sequence(book, now.step, { width: width * near, height, boxed: now.boxed });
      pen.translate(leftOf(width), 0);
      const share = shareOfWay();
      if (!told.over?.(pen, sheet, null, look)) paintSequence(pen, share < 1 ? rowBetween(sheet, glide.mothers, share) : sheet, look);
    } else if (fault) sentence(fault, width, height);
    else if (isTissue) {
      frame = tissueFrame(shapes, width, height, { around: now.around, above: now.above, near, shift, box: boxOf(now.boxed) });
      paintTissue(pen, shapes, frame, look, choice.shown(look.alone));
    } else {
      shapes = told.between?.(now) ?? shapes;
      const share = shareOfWay(), visible = share < 1 ? shapesBetween(share) : isMap ? relaxed.shapes() : shapes;
      const box = isMap && relaxed.watched() ? relaxed.room() : boxOf(now.boxed);
      const forces = isMap && share >= 1 ? relaxed.forces() : null, scaled = forces ? near * (1 - (2 * LONGEST_ARROW) / Math.min(width, height)) : near;
      frame = frameOf(shapes, width, height, { around: now.around, above: now.above, near: scaled, shift, box });
      if (isMap) paintMap(visible, height, forces);
      else if (!told.over?.(pen, visible, frame, look)) paint(pen, visible, frame, look);
      if (empty()) sentence(`Nothing is drawn at step ${now.step}: no module of the word is a stroke or a surface.`, width, height);
    }
    canvas.dataset.drawn = Number(canvas.dataset.drawn || 0) + 1;
    for (const name of ["step", "angle", "around", "above"]) canvas.dataset[name] = now[name];
    canvas.dataset.near = near.toFixed(2);
    if (glide) draw();
  }

  function paintMap(visible, height, forces) {
    paintCells(pen, visible, frame, look.theme);
    if (!forces || look.marked.size || look.lit.size) paint(pen, visible, frame, look);
    if (forces) paintForces(pen, visible, frame, look.theme, forces);
    paintWallSigns(pen, book, visible, frame, look, { ...signs.chosen(), ...(forces && { place: BESIDE_ARROWS, pale: true }) });
    paintMapScale(pen, frame, look, height);
  }

  // Where a filament begins that has been brought nearer: it is moved to the sides, and stays in sight.
  function leftOf(width) {
    const most = ((near - 1) * width) / 2;
    shift[0] = clamped(-most, most, shift[0]);
    return shift[0] - most;
  }

  // How far everything is on its way from the step before: 0 there, 1 at its own place.
  function shareOfWay() {
    const share = glide ? Math.min(1, (performance.now() - glide.started) / GLIDE) : 1;
    if (share >= 1) glide = null;
    return share * share * (3 - 2 * share);
  }

  const shapesBetween = (share) => (isMap ? grownShapes(book, now.step, share) : strokesBetween(glide.from, shapes, glide.mothers, share));

  // The room of the step whose frame is kept; null where each step has its own, or where that one cannot be drawn.
  function boxOf(boxed) {
    if (boxed === null) return null;
    const before = fault, last = shapesOf(Math.max(boxed, now.step));
    fault = before;
    return last && boundsOf(last);
  }

  const empty = () => !(shapes.strokes.n || shapes.faces.n || shapes.rounds.n || shapes.labels?.texts.length);

  function sentence(text, width, height) {
    [pen.fillStyle, pen.font, pen.textAlign] = [look.theme.quiet, "14px sans-serif", "center"];
    pen.fillText(text, width / 2, height / 2, width - 20);
  }

  // What a person does.

  function turn(right, up) {
    const [before, height] = told.view(), around = ((((Math.round(before + right) + 180) % 360) + 360) % 360) - 180;
    told.turned(around, clamped(-90, 90, Math.round(height + up)));
  }

  function move(right, down) {
    if (near === 1) return;
    shift = [shift[0] + right, shift[1] + down];
    draw();
  }

  // Come nearer, so that one point of the canvas stays where it is; by default its middle.
  function come(nearer, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) {
    const wanted = Math.min(NEAREST, near * nearer), next = wanted < 1.01 ? 1 : wanted;
    const from = [x - canvas.clientWidth / 2, y - canvas.clientHeight / 2];
    shift = next === 1 ? [0, 0] : shift.map((places, i) => from[i] + ((places - from[i]) * next) / near);
    near = next;
    draw();
  }

  function home() {
    [near, shift] = [1, [0, 0]];
    draw();
  }

  function press(event) {
    const arrow = ARROWS[event.key], nearer = NEARER[event.key], next = { n: 1, N: 1, p: -1, P: -1 }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || !(arrow || nearer || next || event.key === "Home" || event.key === "Escape")) return;
    event.preventDefault();
    used();
    if (next) told.traced(null, next);
    else if (event.key === "Escape") told.traced(now.step, -1);
    else if (nearer) come(nearer);
    else if (!arrow) {
      home();
      told.turned(...told.front());
    }
    else if (event.shiftKey || !inSpace) move(-arrow[0] * MOVE, arrow[1] * MOVE);
    else turn(arrow[0] * TURN, arrow[1] * TURN);
  }

  function moduleAt(event) {
    const { x, y } = placeOf(event), reach = REACH[event.pointerType] ?? REACH.mouse;
    if (isTissue) return [now.step, cellUnder(shapes, frame, x, y, choice.shown(look.alone))];
    if (!isFilament) return [now.step, fault ? -1 : shapeAt(isMap ? relaxed.shapes() : shapes, frame, x, y, reach)];
    const cell = cellAt(sheet, x - leftOf(canvas.clientWidth), y, reach);
    return cell ? [cell.step, cell.position] : [now.step, -1];
  }

  function placeOf(event) {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  // How the drawing is used is told until somebody has used it; its line stays, so that nothing moves.
  function used() {
    if (hint.hidden || hint.style.visibility) return;
    hint.style.visibility = "hidden";
    remember("drawn", "once");
  }

  onKey(canvas, press);
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
    pressed = pointers.size === 1 ? { x: event.clientX, y: event.clientY, still: true } : null;
    spread = 0;
    pull = [0, 0];
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, event);
    if (pointers.size === 2) return pinch();
    if (!pressed) return;
    if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > CLICK) pressed.still = false;
    if (pressed.still) return;
    if (event.shiftKey || !inSpace) move(event.movementX, event.movementY);
    else {
      pull = [pull[0] - event.movementX * PULL, pull[1] + event.movementY * PULL];
      const whole = pull.map(Math.trunc);
      if (whole[0] || whole[1]) turn(...whole);
      pull = pull.map((part, i) => part - whole[i]);
    }
  });

  function pinch() {
    const [one, other] = [...pointers.values()].map(placeOf), now_ = Math.hypot(one.x - other.x, one.y - other.y);
    if (spread) come(now_ / spread, (one.x + other.x) / 2, (one.y + other.y) / 2);
    spread = now_;
  }

  const released = (event) => {
    pointers.delete(event.pointerId);
    if (event.type === "pointerup" && pressed?.still) told.traced(...moduleAt(event));
    used();
    pressed = null;
  };
  onMouse(canvas, (event) => now && !glide && told.pointed(...(event ? moduleAt(event) : [now.step, -1])));
  canvas.addEventListener("pointerup", released);
  canvas.addEventListener("pointercancel", released);
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas) return;
    event.preventDefault();
    const { x, y } = placeOf(event);
    come(ZOOM ** (-event.deltaY / 100), x, y);
  }, { passive: false });
  const resized = new ResizeObserver(draw);
  resized.observe(canvas);
  return {
    open, show, canvas, home,
    describe: (text) => canvas.setAttribute("aria-label", text),
    measured: () => (isFilament || isMap || isTissue || fault ? null : { size: widthAndHeight(shapes), strokes: shapes.strokes.n }),
    light(nextLook) {
      look = nextLook;
      draw();
    },
    close() {
      resized.disconnect();
      relaxed?.stop();
      draw.cancel();
    },
  };
}

// Shapes whose strokes are on their way from those of their mothers: 0 there, 1 at their own place.
function strokesBetween(from, to, mothers, share) {
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
function rowBetween(sheet, mothers, share) {
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
