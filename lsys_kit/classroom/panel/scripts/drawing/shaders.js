// What the graphics processor computes for plants in sun and sky, in GLSL ES 3.00: where vertices are seen, and what light reaches
// them. Each is a step of pictures/rendering/light.py, and has its numbers.

import { BLURS, BOUNCED, BROAD_EDGE, DARKEST_SKY, GLOSS, GLOSSY, HIDDEN_WITHIN, LEAF, PICTURE_EDGE, POOL, RING_PARTS, SHADOW, SKYLIGHT, SOFT, SPOKES, SUNLIGHT, SUN_RADIUS, THROUGH, TINT } from "./constants.js";

export const SUN_MAP = 1152; // points of the sun's map
const TILE = 3, MARGIN = 70; // so many of them are one of that of the ground, which has others around it
export const GROUND_MAP = SUN_MAP / TILE + 2 * MARGIN;
export const LEAST_MAGNIFIED = 0.5; // so many times magnified is the farthest that is seen
export const MOST_MAGNIFIED = 2;
const BROADER = 5; // at the sides shadows fade so much farther from the edge: a frame fits plants, and not their shadows
const TAPS = 16, GOLDEN_ANGLE = 2.399963;

const GLSL = `#version 300 es
precision highp float;
precision highp sampler2DShadow;
`;
const real = (number) => `float(${number})`, BLUR_RATIOS = BLURS.slice(1).map((radius, i) => Math.log(radius / BLURS[i]));

const THINGS = `uniform mat4 view;
out vec3 place, normal;
flat out vec3 hue;
flat out float thin;
`;

// A stroke: from a to b, with its widths there, in units or by branch order; the strokes before and behind it, or nothing; a
// direction across it. Where it bends, its ring lies in the plane that HALF_WIDTHS the angle.
export const TUBE_GLSL = `${GLSL}layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 2) in vec2 wide;
layout(location = 3) in vec3 before;
layout(location = 4) in vec3 behind;
layout(location = 5) in vec3 across;
layout(location = 6) in vec3 colour;
uniform vec4 own, sizes;
uniform float sides;
${THINGS}float radius(float width) {
  return max(sizes.w, width < 0. ? own[int(-width) - 1] : clamp(width * sizes.x, sizes.y, sizes.z));
}
void main() {
  int many = int(sides), id = gl_VertexID, corner = id % 6, turn = id / 6, end;
  bool cap = id >= 6 * many;
  if (cap) {
    id -= 6 * many;
    int each = 3 * (many - 2);
    end = id / each;
    turn = id % 3 == 0 ? 0 : id % each / 3 + id % 3;
  } else {
    end = corner == 2 || corner > 3 ? 1 : 0;
    turn += corner == 1 || corner == 2 || corner == 4 ? 1 : 0;
  }
  float angle = 6.2831853 * float(turn) / sides, r = radius(end == 1 ? wide.y : wide.x);
  vec3 along = b - a, way = normalize(along), next = end == 1 ? behind : before;
  vec3 aside = across * cos(angle) + cross(way, across) * sin(angle);
  float length2 = dot(next, next), cosine = length2 > 0. ? dot(way, next) * inversesqrt(length2) : 1.;
  normal = aside;
  if (cosine < .999999 && r * sqrt((1. - cosine) / 2.) <= min(length(along), sqrt(length2)) / 2.) {
    next = normalize(next);
    vec3 middle = normalize(way + next), axis = cross(way, middle), inward = normalize(next - way);
    normal += cross(axis, aside) + cross(axis, cross(axis, aside)) / (1. + dot(way, middle));
    aside = normal + (cosine > 0. ? inversesqrt((1. + cosine) / 2.) - 1. : 0.) * dot(normal, inward) * inward;
  }
  if (cap) normal = end == 1 ? way : -way;
  place = (end == 1 ? b : a) + r * aside;
  hue = colour;
  thin = 0.;
  gl_Position = view * vec4(place, 1);
}`;

export const MESH_GLSL = `${GLSL}layout(location = 0) in vec3 a;
layout(location = 1) in vec4 b;
layout(location = 2) in vec3 colour;
${THINGS}void main() {
  place = a;
  normal = b.xyz;
  thin = b.w;
  hue = colour;
  gl_Position = view * vec4(a, 1);
}`;

export const SHEET_GLSL = `${GLSL}void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
}`;

export const NO_GLSL = `${GLSL}void main() {}`;

// How dark the ground is below each point of a map, by how far the shadow falls: the shares of the levels between which its
// edges are blurred.
export const COVERED_GLSL = `${GLSL}uniform sampler2D near;
uniform vec4 sunlight;
uniform vec3 rays_up, rays_towards;
uniform vec2 depths;
uniform float base;
layout(location = 0) out vec4 blurs;
layout(location = 1) out vec4 sharp;
void main() {
  ivec2 at = (ivec2(gl_FragCoord.xy) - ${MARGIN}) * ${TILE};
  float many = 0., sum = 0.;
  if (all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(${SUN_MAP}))))
    for (int k = 0; k < ${TILE * TILE}; k++) {
      float depth = texelFetch(near, at + ivec2(k % ${TILE}, k / ${TILE}), 0).r;
      if (depth < 1.) {
        many++;
        sum += mix(depths.y, depths.x, depth);
      }
    }
  float up = sunlight.y + (float(at.y) + ${real(TILE / 2)}) * sunlight.z / ${real(SUN_MAP)};
  float fall = max(sum / max(many, 1.) - (base - up * rays_up.z) / rays_towards.z, 0.);
  float radius = max(${real(SUN_RADIUS)} * fall / sunlight.z, ${real(BLURS[0])});
  float level = dot(clamp((log(radius) - log(vec4(${BLURS.slice(0, 4)}))) / vec4(${BLUR_RATIOS}), 0., 1.), vec4(1));
  blurs = clamp(1. - abs(level - vec4(1, 2, 3, 4)), 0., 1.) * many / ${real(TILE * TILE)};
  sharp = vec4(max(1. - level, 0.) * many / ${real(TILE * TILE)});
}`;

// Each level is spread as three times by a square.
const HALF_WIDTHS = BLURS.slice(1).map((radius) => Math.round((radius * SUN_MAP) / TILE / 2));
export const BLURRED_GLSL = `${GLSL}uniform sampler2D shares;
uniform vec2 way;
out vec4 found;
void main() {
  vec4 sum = vec4(0), whole = vec4(0), spread = -.5 / vec4(${HALF_WIDTHS.map((half) => half * (half + 1))});
  for (int i = ${-3 * HALF_WIDTHS[3]}; i <= ${3 * HALF_WIDTHS[3]}; i++) {
    vec4 weight = exp(float(i * i) * spread);
    ivec2 at = ivec2(gl_FragCoord.xy) + i * ivec2(way);
    if (all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(${GROUND_MAP})))) sum += weight * texelFetch(shares, at, 0);
    whole += weight;
  }
  found = sum / whole;
}`;

// The point of the ground that is seen at a pixel, and how near it is.
const ON_GROUND = `uniform vec3 right, up, towards;
uniform vec4 camera;
uniform float high;
bool onGround(vec2 pixel, out vec2 at, out float near) {
  vec2 seen = (pixel - camera.xy) / camera.z;
  float falling = camera.w * towards.z - seen.y * up.z, eye = camera.w * towards.z + high, part = eye / falling;
  at = part * (seen.x * right.xy + seen.y * up.xy - camera.w * towards.xy) + camera.w * towards.xy;
  near = camera.w * (1. - part);
  return falling > 1e-6 * camera.w && eye > 0.;
}
`;

export const PAPER_GLSL = `${GLSL}${ON_GROUND}uniform sampler2D shares, sharp, dimness;
uniform vec4 sunlight;
uniform vec3 rays_right, rays_up, paper;
uniform vec2 moved, centre, size;
uniform float base, reach, side, pool;
out vec4 colour;
float inside(vec2 edges) {
  vec2 way = clamp(min(gl_FragCoord.xy, size - gl_FragCoord.xy) / (edges * max(size.x, size.y)), 0., 1.);
  way *= way * (3. - 2. * way);
  return way.x * way.y;
}
void main() {
  vec2 at;
  float near;
  if (!onGround(gl_FragCoord.xy, at, near)) {
    colour = vec4(paper, 1);
    return;
  }
  at += moved;
  vec3 ground = vec3(at, base);
  at -= centre;
  vec2 map = (vec2(dot(ground, rays_right), dot(ground, rays_up)) - sunlight.xy) / sunlight.z * ${real(SUN_MAP / TILE)} + ${real(MARGIN)};
  map /= ${real(GROUND_MAP)};
  float shade = clamp(dot(texture(shares, map), vec4(1)) + texture(sharp, map).r, 0., 1.);
  if (any(lessThan(map, vec2(0))) || any(greaterThan(map, vec2(1)))) shade = 0.;
  vec2 below = at / (2. * side) + .5;
  float dim = any(lessThan(below, vec2(0))) || any(greaterThan(below, vec2(1))) ? 0. : texture(dimness, below).r;
  float far = clamp(length(at) / reach, 0., 1.), fading = (1. - far * far * far) * inside(vec2(${PICTURE_EDGE * BROADER}, ${PICTURE_EDGE}));
  float dark = 1. - (1. - ${SHADOW} * shade * fading) * (1. - ${SHADOW} * dim * fading);
  vec3 lit = mix(paper, vec3(1), pool * ${POOL} * fading * (1. - far * far) * inside(vec2(${BROAD_EDGE})));
  colour = vec4(lit * (1. - dark * vec3(${TINT})), 1);
}`;

// How much of the sky reaches each pixel, seen in how near its neighbours are.
export const OPEN_GLSL = `${GLSL}${ON_GROUND}uniform sampler2D near;
uniform vec2 size;
uniform float extent;
out vec4 open;
float nearness(ivec2 pixel) {
  pixel = clamp(pixel, ivec2(0), ivec2(size) - 1);
  float depth = texelFetch(near, pixel, 0).r, ground;
  vec2 at;
  if (depth < 1.) return camera.w - camera.w / (${real(LEAST_MAGNIFIED)} + (1. - depth) * ${real(MOST_MAGNIFIED - LEAST_MAGNIFIED)});
  return onGround(vec2(pixel) + .5, at, ground) ? ground : -16. * camera.w;
}
void main() {
  float here = nearness(ivec2(gl_FragCoord.xy)), hidden = 0., rings[] = float[](${RING_PARTS.map(real)});
  for (int k = 0; k < ${RING_PARTS.length * SPOKES}; k++) {
    float ring = rings[k / ${SPOKES}] * ${real(HIDDEN_WITHIN)} * extent;
    float angle = 3.14159265 * (float(k % ${SPOKES}) + float(k / ${SPOKES}) / ${real(RING_PARTS.length)}) / ${real(SPOKES)};
    ivec2 aside = ivec2(round(ring * camera.z * vec2(cos(angle), -sin(angle))));
    if (aside == ivec2(0)) continue;
    float both = 0.;
    for (int way = -1; way < 2; way += 2) {
      float rise = clamp((nearness(ivec2(gl_FragCoord.xy) + way * aside) - here) / ring, -1., 4.);
      both += min(rise, max(1.5 - rise / 2., 0.));
    }
    hidden += clamp(both, 0., 1.);
  }
  open = vec4(clamp(1. - hidden / ${real(RING_PARTS.length * SPOKES)}, ${1 - DARKEST_SKY}, 1.));
}`;

export const LIGHT_GLSL = `${GLSL}in vec3 place, normal;
flat in vec3 hue;
flat in float thin;
uniform sampler2DShadow shadows;
uniform sampler2D open;
uniform mat4 rays;
uniform vec4 sunlight;
uniform vec3 eye, rays_towards;
out vec4 colour;
void main() {
  vec3 facet = normalize(normal), sight = normalize(eye - place);
  if (thin > .5 && dot(sight, facet) < 0.) facet = -facet;
  float facing = dot(facet, rays_towards), reached = 0.;
  float aside = sqrt(max(1. - facing * facing, 0.)) * ${SOFT} * sunlight.z + 1.5 * sunlight.z / ${real(SUN_MAP)};
  vec3 there = (rays * vec4(place + facet * (facing < 0. ? -aside : aside), 1)).xyz * .5 + .5;
  for (int tap = 0; tap < ${TAPS}; tap++) {
    float angle = float(tap) * ${GOLDEN_ANGLE}, away = sqrt((float(tap) + .5) / ${real(TAPS)}) * ${SOFT};
    reached += texture(shadows, vec3(there.xy + away * vec2(cos(angle), sin(angle)), there.z)) / ${real(TAPS)};
  }
  float front = max(facing, 0.) * reached, through = max(-facing, 0.) * reached * thin, above = .5 + .5 * facet.z;
  float gloss = pow(clamp(dot(facet, normalize(sight + rays_towards)), 0., 1.), ${real(GLOSSY)}) * front * ${GLOSS};
  float sky = (above + (1. - above) * ${BOUNCED}) * texelFetch(open, ivec2(gl_FragCoord.xy), 0).r;
  vec3 sun = vec3(${SUNLIGHT}), light = front * sun + through * sun * vec3(${LEAF}) * ${THROUGH} + sky * vec3(${SKYLIGHT});
  light = hue * light + gloss * sun;
  light *= inversesqrt(sqrt(1. + light * light * light * light));
  colour = vec4(mix(1.055 * pow(max(light, 1e-6), vec3(1. / 2.4)) - .055, light * 12.92, lessThanEqual(light, vec3(.0031308))), 1);
}`;
