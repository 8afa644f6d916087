// SPDX-License-Identifier: GPL-3.0-or-later
// Colours, the same as in the report's drawings (postprocess/views/floe_style.cpp).

export const STATES = [
  { name: 'held', rgb: [210, 225, 237] },
  { name: 'moving', rgb: [133, 191, 232] },
  { name: 'behind the ship', rgb: [243, 205, 130] },
];
export const HULL_WET = [186, 84, 62];
export const HULL_DRY = [112, 124, 136];

// Contact force on ice: from untouched ice to dark red. Load on the hull: from grey to dark violet.
// Lightness falls all along, so that both are read without colour, too.
const FORCE = [[226, 237, 245], [255, 214, 120], [240, 128, 40], [178, 24, 24], [90, 6, 36]];
const LOAD = [[214, 219, 224], [250, 212, 120], [238, 120, 60], [176, 42, 90], [66, 10, 104]];
// Speed of the water: from pale to dark blue.
const FLOW = [[176, 214, 240], [66, 146, 198], [8, 69, 148], [8, 24, 88]];

// Pieces of level ice: time since they broke off, the load that broke them off.
export const AGE = [[255, 226, 110], [134, 203, 102], [46, 148, 130], [48, 92, 138], [62, 18, 92]];
export const BREAKING = [[254, 236, 190], [253, 176, 98], [227, 88, 70], [150, 30, 96],
  [60, 12, 84]];

function ramp(stops, x) {
  const at = Math.min(Math.max(x, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  return stops[k].map((c, j) => c + (at - k) * (stops[k + 1][j] - c));
}
export const forceColour = (x) => ramp(FORCE, x);
export const loadColour = (x) => ramp(LOAD, x);
export const ageColour = (x) => ramp(AGE, x);
export const breakingColour = (x) => ramp(BREAKING, x);
export const flowColour = (x) => ramp(FLOW, x);

const REGIONS = [[148, 160, 172], [204, 102, 119], [221, 204, 119], [68, 170, 153],
  [136, 204, 238], [170, 68, 153], [153, 153, 51], [51, 34, 136], [17, 119, 51]];
export const regionColour = (k) => REGIONS[k % REGIONS.length];

export const css = (rgb) => `rgb(${rgb.map(Math.round).join(',')})`;

/** A ramp as GLSL: vec3 NAME(float x) with x in [0, 1]. */
export function glslRamp(name, stops = FORCE) {
  const vec = (rgb) => `vec3(${rgb.map((c) => (c / 255).toFixed(4)).join(',')})`;
  const n = stops.length - 1;
  const mixes = stops.slice(1).map((rgb, k) =>
    `c = mix(c, ${vec(rgb)}, clamp(x * ${n}.0 - ${k}.0, 0.0, 1.0));`).join(' ');
  return `vec3 ${name}(float x) { vec3 c = ${vec(stops[0])}; ${mixes} return c; }`;
}

/** CSS gradient of a ramp, for legends. */
export function cssGradient(colour) {
  const stops = [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1].map((x) => css(colour(x)));
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
