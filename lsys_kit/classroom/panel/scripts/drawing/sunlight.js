// Plants in space in sun and sky, painted by the graphics processor (WebGL 2): the camera of the painter, and the light of the
// kit's own pictures, as pictures/rendering/light.py explains it step by step. Where there is no such processor, nothing is
// painted here, and the painter does it all.
//
// A page has one context, whose picture is copied to the canvas of whoever asks; what is marked, traced or written is painted
// over it. Points are in units of the model, from where the turtle starts.

import { clamped, times } from "../books/numbers.js";
import { channels } from "./colours.js";
import { BALL, BROADEST, DIM_BLUR, DIM_MAP, FAR_SHADOW, HIDING, LEAST_WIDTHS, NEAR_GROUND, ORDER_WIDTHS, SHARPEST, SLIMMEST, SUN, SUNLIT, THINNEST_TUBE, VARIED } from "./constants.js";
import { cornersOf } from "./outlines.js";
import { boundsOf, seenIn } from "./projection.js";
import { BLURRED_GLSL, COVERED_GLSL, LEAST_MAGNIFIED, GROUND_MAP, LIGHT_GLSL, MESH_GLSL, MOST_MAGNIFIED, NO_GLSL, OPEN_GLSL, PAPER_GLSL, SHEET_GLSL, SUN_MAP, TUBE_GLSL } from "./shaders.js";
import { MOST_POINTS } from "./turtle_actions.js";

const SIDES = 8, FEWER_SIDES = 6, MOST_ROUND = 5_000; // of strokes; where they are more, they have fewer
const COMPUTED = /swiftshader|llvmpipe|software|basic render/i; // what is no processor of its own
const KEPT = 12; // scenes that the processor keeps
const IN_TUBE = [3, 3, 2, 3, 3, 3, 3], IN_MESH = [3, 4, 3]; // the numbers of each attribute
const IN_RADIANS = Math.PI / 180, SAME = 1e-6, CREASE = 0.3;
const FEW_BALLS = 100, DISC_CORNERS = 24; // so many spheres are finer; the corners of discs

let /** @type {any} */ screen = null; // false where there is no processor

// Paint shapes, and say what is to be painted over them, as `seenIn` does; nothing where this cannot be done.
export function sunlit(pen, shapes, frame, theme, marked, lit) {
  if (!screen || screen.gl.isContextLost()) screen = screen === false ? false : opened();
  if (!screen || frame.distance === Infinity) return null;
  const { width, height } = pen.canvas;
  paintScene(sceneOf(shapes), frame, width, height, theme);
  pen.save();
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.drawImage(screen.canvas, 0, screen.canvas.height - height, width, height, 0, 0, width, height);
  pen.restore();
  if (!marked.size && !lit.size && !shapes.labels?.texts.length) return { painted: [], order: [] };
  const seen = seenIn(frame, shapes), { faces, strokes, rounds } = shapes, states = [...faces.states, ...strokes.states, ...rounds.states];
  return { ...seen, painted: seen.order.filter((number) => marked.has(states[number])) };
}

// The processor, and what it can do; false if there is none, or it would be slower than the painter.
function opened() {
  const canvas = document.createElement("canvas"), gl = canvas.getContext("webgl2", { antialias: true, alpha: false, failIfMajorPerformanceCaveat: true });
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  if (!gl || (names && COMPUTED.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)))) return false;
  const program = (texts) => {
    const made = gl.createProgram(), places = new Map();
    texts.forEach((text, i) => {
      const shader = gl.createShader(i ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    });
    gl.linkProgram(made);
    times(gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS), (i) => {
      const { name } = gl.getActiveUniform(made, i);
      places.set(name, gl.getUniformLocation(made, name));
    });
    return { made, places };
  };
  const texture = (format, width, height, smooth) => {
    const found = gl.createTexture(), filter = smooth ? gl.LINEAR : gl.NEAREST;
    gl.bindTexture(gl.TEXTURE_2D, found);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, filter);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return found;
  };
  const target = (width, height, depth, ...colours) => {
    const frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    if (depth) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
    colours.forEach((each, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, each, 0));
    gl.drawBuffers(colours.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    return { frame, width, height };
  };
  const compared = gl.createSampler(), near = texture(gl.DEPTH_COMPONENT24, SUN_MAP, SUN_MAP, false);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.samplerParameteri(compared, name, gl.LINEAR);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.samplerParameteri(compared, name, gl.CLAMP_TO_EDGE);
  gl.samplerParameteri(compared, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
  const [shares, spread, sharp] = times(3, () => texture(gl.RGBA8, GROUND_MAP, GROUND_MAP, true));
  return {
    canvas, gl, texture, target, compared, near, shares, spread, sharp, scenes: new Map(), size: [0, 0],
    programs: Object.fromEntries(Object.entries({ tubeDepth: [TUBE_GLSL, NO_GLSL], meshDepth: [MESH_GLSL, NO_GLSL], tube: [TUBE_GLSL, LIGHT_GLSL], mesh: [MESH_GLSL, LIGHT_GLSL],
      covered: [SHEET_GLSL, COVERED_GLSL], blurred: [SHEET_GLSL, BLURRED_GLSL], open: [SHEET_GLSL, OPEN_GLSL], paper: [SHEET_GLSL, PAPER_GLSL] }).map(([name, texts]) => [name, program(texts)])),
    shadow: target(SUN_MAP, SUN_MAP, near), covering: target(GROUND_MAP, GROUND_MAP, null, shares, sharp),
    blurring: [target(GROUND_MAP, GROUND_MAP, null, spread), target(GROUND_MAP, GROUND_MAP, null, shares)], dimness: texture(gl.R8, DIM_MAP, DIM_MAP, true),
  };
}

// Room for pictures of a size; what is there stays as large as it ever was.
function makeRoom(width, height) {
  const { gl, canvas, size, texture, target } = screen;
  if (width <= size[0] && height <= size[1]) return;
  const [wide, high] = (screen.size = [Math.max(width, size[0]), Math.max(height, size[1])]);
  for (const each of [screen.depth, screen.sky]) if (each) gl.deleteTexture(each);
  [canvas.width, canvas.height] = [wide, high];
  [screen.depth, screen.sky] = [texture(gl.DEPTH_COMPONENT24, wide, high, false), texture(gl.R8, wide, high, false)];
  [screen.deep, screen.skies] = [target(wide, high, screen.depth), target(wide, high, null, screen.sky)];
}

function paintScene(scene, frame, width, height, theme) {
  makeRoom(width, height);
  const { gl, shadow, covering, blurring, deep, skies, near, shares, spread, sharp, depth, sky, programs, compared } = screen;
  const known = uniformsOf(scene, frame, width, height, theme), sheet = (program, to, textures, more = {}, size = [to.width, to.height]) => {
    begin(to, size, gl.ALWAYS);
    use(program, { ...known, ...more }, textures);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  };
  const things = (suffix, more, textures = {}) => {
    for (const [kind, part] of Object.entries(scene.parts)) {
      use(programs[kind + suffix], { ...known, ...more }, textures);
      gl.bindVertexArray(part.array);
      if (kind === "tube") gl.drawArraysInstanced(gl.TRIANGLES, 0, known.sides * 6 + 6 * (known.sides - 2), part.n);
      else gl.drawArrays(gl.TRIANGLES, 0, part.n);
      gl.bindVertexArray(null);
    }
  };
  begin(shadow, [SUN_MAP, SUN_MAP], gl.LESS);
  things("Depth", { view: known.rays });
  sheet(programs.covered, covering, { near });
  sheet(programs.blurred, blurring[0], { shares }, { way: [1, 0] });
  sheet(programs.blurred, blurring[1], { shares: spread }, { way: [0, 1] });
  begin(deep, [width, height], gl.LESS);
  things("Depth", {});
  sheet(programs.open, skies, { near: depth }, {}, [width, height]);
  sheet(programs.paper, { frame: null }, { shares, sharp, dimness: scene.dimness }, {}, [width, height]);
  gl.depthFunc(gl.LESS);
  gl.depthMask(true);
  things("", {}, { shadows: near, open: sky });
}

function begin({ frame }, /** @type {any} */ [width, height], order) {
  const { gl } = screen;
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  gl.viewport(0, 0, width, height);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(order);
  gl.depthMask(true);
  gl.clear(gl.DEPTH_BUFFER_BIT);
  gl.depthMask(order === gl.LESS);
}

function use({ made, places }, values, textures) {
  const { gl, compared } = screen;
  let unit = 0;
  gl.useProgram(made);
  for (const [name, at] of places) {
    const value = values[name];
    if (textures?.[name]) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, textures[name]);
      gl.bindSampler(unit, name === "shadows" ? compared : null);
      gl.uniform1i(at, unit++);
    }
    else if (typeof value === "number") gl.uniform1f(at, value);
    else if (value.length === 16) gl.uniformMatrix4fv(at, false, value);
    else gl[`uniform${value.length}fv`](at, value);
  }
}

// What the programs are told of a scene, the side from which it is seen, and the sun, which stands at the viewer's left.
function uniformsOf(scene, frame, width, height, theme) {
  const { scale, distance, x0, y0, thin, pixel } = frame, density = width / frame.width;
  const [right, up, towards] = axes(Math.atan2(frame.sin, frame.cos), Math.atan2(frame.steep, frame.level));
  const [rays_right, rays_up, rays_towards] = axes(Math.atan2(frame.sin, frame.cos) + SUN[0] * IN_RADIANS, SUN[1] * IN_RADIANS);
  const moved = frame.middle.map((part, axis) => part - scene.origin[axis]), unit = pixel / scene.pixel / 2;
  const own = ORDER_WIDTHS.map((many, order) => Math.max(LEAST_WIDTHS[order], 10 * many * thin) / (20 * scale));
  const pad = Math.max(own[0], scene.broadest * unit);
  const [[left, most], [bottom, top], depths] = [rays_right, rays_up, rays_towards].map((axis) => spanAlong(scene.points, axis, pad));
  const extent = Math.max(most - left, top - bottom, 1e-12), { base, across, high } = scene;
  const away = [...towards.map((part) => -part / distance), 1 + dot(towards, moved) / distance];
  const seen = (axis, factor, centre) => [...axis, -dot(axis, moved)].map((part, k) => factor * part + centre * away[k]);
  const length = high * Math.tan((90 - SUN[1]) * IN_RADIANS), side = across * 1.2 + extent * 3 * DIM_BLUR;
  scene.dimness ??= dimnessOf(scene, side, extent, { unit, own });
  return {
    right, up, towards, rays_right, rays_up, rays_towards, depths, base, own, extent,
    view: columns(seen(right, (2 * scale * density) / width, (2 * x0 * density) / width - 1),
      seen(up, (2 * scale * density) / height, 1 - (2 * y0 * density) / height),
      away.map((part, k) => (part * (MOST_MAGNIFIED + LEAST_MAGNIFIED) - (k === 3 ? 2 * MOST_MAGNIFIED * LEAST_MAGNIFIED : 0)) / (MOST_MAGNIFIED - LEAST_MAGNIFIED)), away),
    rays: columns([...rays_right.map((part) => (2 * part) / extent), (-2 * left) / extent - 1], [...rays_up.map((part) => (2 * part) / extent), (-2 * bottom) / extent - 1],
      [...rays_towards.map((part) => (-2 * part) / (depths[1] - depths[0])), 1 + (2 * depths[0]) / (depths[1] - depths[0])], [0, 0, 0, 1]),
    sizes: [unit, SLIMMEST / (20 * scale), BROADEST / (20 * scale), THINNEST_TUBE / (2 * scale * density)], sides: scene.parts.tube.n > MOST_ROUND ? FEWER_SIDES : SIDES,
    sunlight: [left, bottom, extent, 0], camera: [x0 * density, height - y0 * density, scale * density, distance],
    high: moved[2] - base, moved: moved.slice(0, 2), eye: towards.map((part, axis) => part * distance + moved[axis]), size: [width, height],
    paper: channels(theme.paper).map((channel) => channel / 255), pool: theme.dark ? 1 : 0, side: scene.side, centre: scene.centre,
    reach: across + Math.min(length, FAR_SHADOW * Math.max(high, 2 * across)),
  };
}

// The directions that appear as right and up, and that towards a viewer who stands so far around and above.
const axes = (around, above) => {
  const [cos, sin, level, steep] = [Math.cos(around), Math.sin(around), Math.cos(above), Math.sin(above)];
  return [[cos, sin, 0], [-sin * steep, cos * steep, level], [sin * level, -cos * level, steep]];
};
const dot = (one, other) => one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
const normalTo = /** @type {(a: any, b: any) => number[]} */ ([ax, ay, az], [bx, by, bz]) => [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
const unitVector = (vector) => {
  const length = Math.hypot(...vector) || 1;
  return vector.map((part) => part / length);
};
const columns = (...rows) => times(16, (k) => rows[k % 4][k >> 2]);

function spanAlong(points, axis, pad) {
  let [least, most] = [Infinity, -Infinity];
  const [ax, ay, az] = axis;
  for (let i = 0; i < points.length; i += 4) {
    const at = points[i] * ax + points[i + 1] * ay + points[i + 2] * az, radius = points[i + 3];
    if (at - radius < least) least = at - radius;
    if (at + radius > most) most = at + radius;
  }
  return least < most ? [least - pad, most + pad] : [-1, 1];
}

// What the processor is given of shapes, once.
function sceneOf(shapes) {
  const { gl, scenes } = screen;
  if (scenes.has(shapes)) return scenes.get(shapes);
  const { middle, across, up } = boundsOf(shapes), { strokes, faces, rounds, x, y, z } = shapes, points = [];
  const origin = [x[0], y[0], z[0]], at = (i) => [x[i] - origin[0], y[i] - origin[1], z[i] - origin[2]], add = (i, radius) => points.push(...at(i), radius);
  for (const point of new Set([...strokes.from, ...strokes.to, ...faces.corners])) add(point, 0);
  for (let i = 0; i < rounds.n; i++) add(rounds.centres[i], rounds.radii[i]);
  const hues = shapes.palette.map((colour) => channels(sunny.get(colour.toUpperCase()) ?? colour).map((channel) => linear(channel / 255)));
  const tubes = tubesOf(shapes, at, hues), mesh = knownMesh(shapes, at, hues);
  const scene = {
    origin, centre: [middle[0] - origin[0], middle[1] - origin[1]], across, high: 2 * up, pixel: shapes.pixel, points: Float32Array.from(points), tubes, mesh, dimness: null, side: 1,
    base: -spanAlong(points, [0, 0, -1], 0)[1], broadest: strokes.widths.reduce((most, width) => Math.max(most, width), 0),
    parts: { tube: sent(gl, tubes, IN_TUBE, 1), mesh: sent(gl, mesh, IN_MESH, 0) },
  };
  scenes.set(shapes, scene);
  for (const [oldest, { parts, dimness }] of scenes.size > KEPT ? scenes : []) {
    Object.values(parts).forEach(({ array, buffer }) => { gl.deleteVertexArray(array); gl.deleteBuffer(buffer); });
    gl.deleteTexture(dimness);
    scenes.delete(oldest);
    break;
  }
  return scene;
}

const sunny = new Map(/** @type {any} */ (SUNLIT));
const linear = (part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);

function sent(gl, rows, sizes, divisor) {
  const array = gl.createVertexArray(), buffer = gl.createBuffer(), row = sizes.reduce((sum, size) => sum + size, 0);
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, rows, gl.STATIC_DRAW);
  sizes.reduce((first, size, i) => {
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, size, gl.FLOAT, false, 4 * row, 4 * first);
    gl.vertexAttribDivisor(i, divisor);
    return first + size;
  }, 0);
  gl.bindVertexArray(null);
  return { array, buffer, n: rows.length / row };
}

// Strokes as the rows of TUBE_GLSL. A stroke continues the last one of its branch order that ends where it starts, if it does not
// turn back, and what lies across is carried along without a twist.
function tubesOf({ strokes: { n, from, to, orders, widths, colours } }, at, hues) {
  const row = IN_TUBE.reduce((sum, size) => sum + size), rows = new Float32Array(row * n), open = new Map(), ended = new Map(), same = widths.some((width) => width <= 0);
  const look = (i) => (widths[i] < 0 ? -1 - Math.min(orders[i], ORDER_WIDTHS.length - 1) : widths[i]);
  let many = 0;
  for (let i = 0; i < n; i++) {
    const [a, b] = [at(from[i]), at(to[i])], along = b.map((part, k) => part - a[k]), length = Math.hypot(...along);
    if (!length) continue;
    const start = from[i] + MOST_POINTS * orders[i], before = open.get(start), way = along.map((part) => part / length);
    const goesOn = before && dot(before.way, way) > SHARPEST ? before : null, across = goesOn ? carried(goesOn, way) : aside(way);
    rows.set([...a, ...b, goesOn?.width ?? (same ? look(i) : ended.get(start) ?? look(i)), look(i), ...(goesOn?.along ?? [0, 0, 0]), 0, 0, 0, ...across, ...hues[colours[i]]], row * many);
    if (goesOn) rows.set(along, row * goesOn.place + 11);
    open.delete(start);
    const end = to[i] + MOST_POINTS * orders[i];
    open.set(end, { way, along, across, width: look(i), place: many++ });
    ended.set(end, look(i));
  }
  return rows.subarray(0, row * many);
}

const aside = (way) => {
  const sizes = way.map(Math.abs), least = sizes.indexOf(Math.min(...sizes));
  return unitVector(normalTo(way, [0, 1, 2].map((axis) => (axis === least ? 1 : 0))));
};

function carried({ way, across }, next) {
  const axis = normalTo(way, next), one = normalTo(axis, across), two = normalTo(axis, one), share = 1 / (1 + dot(way, next));
  const turned = across.map((part, k) => part + one[k] + two[k] * share), along = dot(turned, next);
  return unitVector(turned.map((part, k) => part - along * next[k]));
}

// The same surfaces are kept while strokes are on their way to the next step.
function knownMesh(shapes, at, hues) {
  const { faces, rounds } = shapes;
  let sum = 0;
  for (const points of [faces.corners, rounds.centres]) points.forEach((point, i) => at(point).forEach((part, axis) => { sum += part * (3 * i + axis + 1); }));
  if (meshes.get(faces)?.sum !== sum) meshes.set(faces, { sum, rows: meshOf(shapes, at, hues) });
  return meshes.get(faces).rows;
}

const meshes = new WeakMap();

// Surfaces as the rows of MESH_GLSL: polygons, discs and spheres.
function meshOf({ faces, rounds, x, y, z }, at, hues) {
  const rows = [], corners = faceCorners(faces, { x, y, z }), curved = new Map(), seen = new Map(), varied = leavesOf(faces, corners);
  const facing = times(faces.n, (i) => newell(cornersOf(faces, i), at));
  const key = (i, corner) => corner * MOST_POINTS + faces.positions[i];
  for (let i = 0; i < faces.n; i++) if (faces.smooth[i]) for (let k = faces.starts[i]; k < faces.starts[i + 1]; k++) {
    const sum = curved.get(key(i, corners[k])) ?? [0, 0, 0];
    curved.set(key(i, corners[k]), sum.map((part, axis) => part + facing[i][axis]));
  }
  const vertex = (place, normal, thin, hue) => rows.push(...place, ...normal, thin, ...hue);
  for (let i = 0; i < faces.n; i++) {
    const points = Array.from(cornersOf(faces, i), at), flat = unitVector(facing[i]), factors = varied[i], hue = hues[faces.colours[i]].map((part, k) => Math.min(0.95, part * factors[k]));
    const normals = points.map((_, k) => {
      const found = unitVector(curved.get(key(i, corners[faces.starts[i] + k])) ?? flat);
      return dot(found, flat) > CREASE ? found : flat;
    });
    for (const triangle of triangulated(points, flat)) for (const k of triangle) vertex(points[k], normals[k], 1, hue);
  }
  const fine = rounds.n > FEW_BALLS ? 6 : 12;
  for (let i = 0; i < rounds.n; i++) {
    const centre = at(rounds.centres[i]), radius = rounds.radii[i], hue = hues[rounds.colours[i]].map((part) => Math.min(0.95, part)), isBall = rounds.kinds[i] === BALL;
    if (!seen.has(isBall)) seen.set(isBall, isBall ? ball(fine) : disc());
    for (const [point, normal] of seen.get(isBall)) vertex(point.map((part, k) => centre[k] + radius * part), normal, isBall ? 0 : 1, hue);
  }
  return Float32Array.from(rows);
}

// The normal of a polygon, as long as twice its area, by Newell's method.
function newell(corners, at) {
  const sum = [0, 0, 0], first = at(corners[0]), away = (corner) => at(corner).map((part, axis) => part - first[axis]);
  for (let k = 2; k < corners.length; k++) normalTo(away(corners[k - 1]), away(corners[k])).forEach((part, axis) => { sum[axis] += part; });
  return sum;
}

// For each corner of faces a number, the same where they meet.
function faceCorners({ corners }, { x, y, z }) {
  const known = new Map(), axes_ = [x, y, z], spans = axes_.map((axis) => {
    let [least, most] = [Infinity, -Infinity];
    for (const corner of corners) [least, most] = [Math.min(least, axis[corner]), Math.max(most, axis[corner])];
    return most - least;
  });
  const unit = SAME * (Math.max(...spans) || 1);
  return Array.from(corners, (corner) => {
    const text = axes_.map((axis) => Math.round(axis[corner] / unit)).join();
    if (!known.has(text)) known.set(text, known.size);
    return known.get(text);
  });
}

// By what the colours of faces differ from leaf to leaf; faces that have an edge in common are of one.
function leavesOf({ n, starts }, corners) {
  const leaf = times(n, (i) => i), edges = new Map(), root = (i) => {
    while (leaf[i] !== i) i = leaf[i] = leaf[leaf[i]];
    return i;
  };
  for (let i = 0; i < n; i++) for (let k = starts[i]; k < starts[i + 1]; k++) {
    const ends = [corners[k], corners[k + 1 < starts[i + 1] ? k + 1 : starts[i]]], edge = Math.min(...ends) * MOST_POINTS + Math.max(...ends);
    if (!edges.has(edge)) edges.set(edge, i);
    const [one, other] = [root(i), root(edges.get(edge))];
    leaf[Math.max(one, other)] = Math.min(one, other);
  }
  const found = new Map();
  return leaf.map((_, i) => {
    const first = root(i);
    if (!found.has(first)) {
      const [bright, warm] = STEMS.map((stem, k) => VARIED[k] * (2 * (Number(mixedBits(mixedBits(stem ^ BigInt(found.size))) >> 11n) / 2 ** 53) - 1));
      found.set(first, [1 + warm, 1, 1 - warm].map((part) => part * (1 + bright)));
    }
    return found.get(first);
  });
}

// Random numbers as the kit has them, of seed 0 and steps 0 and 1 (splitmix64).
const STEMS = [0xa706dd2f4d197e6fn, 0x8b4fda8c892b50en], WHOLE = (1n << 64n) - 1n;
function mixedBits(number) {
  number = (number + 0x9e3779b97f4a7c15n) & WHOLE;
  number = ((number ^ (number >> 30n)) * 0xbf58476d1ce4e5b9n) & WHOLE;
  number = ((number ^ (number >> 27n)) * 0x94d049bb133111ebn) & WHOLE;
  return number ^ (number >> 31n);
}

// The triangles of a polygon, by ear clipping.
function triangulated(points, facing) {
  const sizes = facing.map(Math.abs), axis = sizes.indexOf(Math.max(...sizes)), [one, other] = facing[axis] > 0 ? [1, 2] : [2, 1];
  const left = points.map((_, k) => k), found = [];
  const bend = (a, b, c) => [0, 1].reduce((sum, way) => {
    const [u, v] = [(axis + (way ? other : one)) % 3, (axis + (way ? one : other)) % 3];
    return sum + (way ? -1 : 1) * (points[b][u] - points[a][u]) * (points[c][v] - points[b][v]);
  }, 0);
  const around = (i) => [left.at(i - 1), left[i], left[(i + 1) % left.length]];
  const within = (a, b, c, p) => bend(a, b, p) > 0 && bend(b, c, p) > 0 && bend(c, a, p) > 0;
  while (left.length > 3) {
    const ear = Math.max(0, left.findIndex((_, i) => bend(...around(i)) > 0 && !left.some((p) => within(.../** @type {[any, any, any]} */ (around(i)), p))));
    found.push(around(ear));
    left.splice(ear, 1);
  }
  return points.length > 2 ? [...found, left] : [];
}

// Points of a sphere and of a disc that looks to the front, of size 1, as triangles, each with its normal.
function ball(fine) {
  const at = (row, column) => {
    const [up, around] = [(Math.PI * row) / fine, (Math.PI * column) / fine];
    return [Math.sin(up) * Math.cos(around), Math.sin(up) * Math.sin(around), Math.cos(up)];
  };
  return times(2 * fine * fine, (k) => [(k / 2 / fine) | 0, k % (2 * fine)]).flatMap(([row, column]) => [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]
    .map(([down, along]) => at(row + down, column + along))).map((point) => [point, point]);
}

const disc = () => times(DISC_CORNERS, (k) => k).flatMap((k) => [null, k, k + 1].map((each) => {
  const angle = (2 * Math.PI * (each ?? 0)) / DISC_CORNERS;
  return [each === null ? [0, 0, 0] : [Math.cos(angle), 0, Math.sin(angle)], [0, -1, 0]];
}));

// How much of the sky things near the ground hide from it, in a map of a square around the middle.
function dimnessOf(scene, side, extent, { unit, own }) {
  const { gl, texture } = screen, cell = (2 * side) / DIM_MAP, dense = new Float32Array(DIM_MAP ** 2), { tubes, mesh, base, centre } = scene;
  const place = (part, axis) => clamped(0, DIM_MAP - 1, Math.floor((part - centre[axis] + side) / cell));
  const add = (x, y, z, area) => { dense[place(y, 1) * DIM_MAP + place(x, 0)] += (area / cell ** 2) * Math.exp((base - z) / (NEAR_GROUND * extent)); };
  for (let i = 0; i < tubes.length; i += 20) {
    const [ax, ay, az, bx, by, bz, , width] = tubes.subarray(i, i + 8), length = Math.hypot(bx - ax, by - ay, bz - az);
    if (Math.min(az, bz) - base > extent) continue;
    const many = Math.ceil(length / cell), radius = width < 0 ? own[-1 - width] : width * unit;
    for (let k = 0; k < many; k++) {
      const share = (k + 0.5) / many;
      add(ax + share * (bx - ax), ay + share * (by - ay), az + share * (bz - az), (2 * Math.PI * radius * length) / many);
    }
  }
  for (let i = 0; i < mesh.length; i += 30) {
    const [a, b, c] = [0, 10, 20].map((more) => mesh.subarray(i + more, i + more + 3)), [one, other] = [b, c].map((each) => [0, 1, 2].map((k) => each[k] - a[k]));
    const area = Math.hypot(...normalTo(one, other)) / 2, many = Math.min(DIM_MAP, Math.ceil(area / cell ** 2));
    if (a[2] - base > extent) continue;
    for (let k = 0; k < many; k++) {
      let [u, v] = [(0.5 + k * 0.7548777) % 1, (0.5 + k * 0.5698403) % 1]; // evenly spread (Roberts 2018)
      if (u + v > 1) [u, v] = [1 - u, 1 - v];
      add(...[0, 1, 2].map((axis) => a[axis] + u * one[axis] + v * other[axis]), area / many);
    }
  }
  const spread = blurred(dense, Math.round((DIM_BLUR * extent) / cell / 2)), found = texture(gl.R8, DIM_MAP, DIM_MAP, true);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, DIM_MAP, DIM_MAP, gl.RED, gl.UNSIGNED_BYTE, Uint8Array.from(spread, (part) => Math.round(255 * (1 - Math.exp(-HIDING * part)))));
  scene.side = side;
  return found;
}

// A map in which each number is spread, three times by a square.
function blurred(numbers, half) {
  for (let turn = 0; half && turn < 6; turn++) {
    const found = new Float32Array(numbers.length), [step, line] = turn % 2 ? [1, DIM_MAP] : [DIM_MAP, 1];
    for (let i = 0; i < DIM_MAP; i++) {
      let sum = 0;
      const at = (k) => (k < 0 || k >= DIM_MAP ? 0 : numbers[i * line + k * step]);
      for (let k = -half; k < DIM_MAP; k++) {
        sum += at(k + half) - at(k - half - 1);
        if (k >= 0) found[i * line + k * step] = sum / (2 * half + 1);
      }
    }
    numbers = found;
  }
  return numbers;
}
