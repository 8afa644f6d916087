// SPDX-License-Identifier: GPL-3.0-or-later
// All floes as one mesh and one draw call, whatever their shapes. A vertex knows its floe; the
// floes' poses of all frames lie in a texture of 16-bit integers, two texels per floe and frame
// (position and load, quaternion), between which the vertex shader interpolates. So playback costs
// one uniform per picture.

import { BufferAttribute, BufferGeometry, DataTexture, DoubleSide, GLSL3, Mesh, NearestFilter,
  RGBAIntegerFormat, ShaderMaterial, ShortType, Vector3 } from 'three';
import { AGE, BREAKING, STATES, glslRamp } from './colours.js';
import { triangleSoup } from './geometry.js';
import { SHADE } from './shade.js';

const VERTEX = `
precision highp float;
precision highp int;
uniform highp isampler2D poses;
uniform int floes, width, frames;
uniform float frame, time, ageEnd;
uniform vec3 scale, offset;
in float floe;
// when it broke off [s], -1: never, -2: a part of the sheet; by what share of the scale's load
in vec2 piece;
in vec3 edge;
out vec3 vView, vEdge;
out float vLoad;
flat out vec2 vPiece; // age and load as shares of their scales; age < 0: unbroken
flat out int vState, vSheet;

ivec4 texel(int k) { return texelFetch(poses, ivec2(k % width, k / width), 0); }
vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.yzw, cross(q.yzw, v) + q.x * v); }

void main() {
  int k = min(int(frame), frames - 1), next = min(k + 1, frames - 1);
  float part = frame - float(k);
  int here = 2 * (k * floes + int(floe)), there = 2 * (next * floes + int(floe));
  ivec4 p0 = texel(here), p1 = texel(there);
  vec3 p = mix(vec3(p0.xyz), vec3(p1.xyz), part) * scale + offset;
  // q and -q are the same turn: take the shorter way
  vec4 q0 = vec4(texel(here + 1)), q1 = vec4(texel(there + 1));
  vec4 q = normalize(mix(q0, dot(q0, q1) < 0.0 ? -q1 : q1, part));
  vec4 view = viewMatrix * vec4(rotate(q, position) + p, 1.0);
  // the load of frame n is the mean of the time before it
  vLoad = float((part > 0.0 ? p1.w : p0.w) >> 2) / 8191.0;
  vState = (part < 0.5 ? p0.w : p1.w) & 3;
  vPiece = vec2(piece.x < 0.0 ? -1.0 : (time - piece.x) / ageEnd, piece.y);
  vView = view.xyz;
  vEdge = edge;
  vSheet = piece.x < -1.5 ? 1 : 0;
  gl_Position = projectionMatrix * view;
  if (vState == 3) gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // not there: out of sight
}`;

const FRAGMENT = `
precision highp float;
precision highp int;
in vec3 vView, vEdge;
in float vLoad;
flat in int vState, vSheet;
flat in vec2 vPiece;
uniform float loadMax, scaleEnd;
uniform int mode; // row of MODES
uniform vec3 states[3];
out vec4 colour;
${glslRamp('forceColour')}
${glslRamp('ageColour', AGE)}
${glslRamp('breakingColour', BREAKING)}
${SHADE}
void main() {
  // forces are stored as square roots and coloured linearly
  vec3 base = forceColour(vLoad * vLoad * loadMax / scaleEnd);
  if (mode == 1) base = states[clamp(vState, 0, 2)];
  if (mode >= 2) base = vPiece.x < 0.0 ? states[0]
                      : mode == 2 ? ageColour(vPiece.x) : breakingColour(vPiece.y);
  // The sheet is one plate: no line between its parts shows where a crack will open, and walls,
  // which show through where parts meet, are hardly darker than its faces.
  vec3 normal = normalize(cross(dFdx(vView), dFdy(vView)));
  float plate = abs(dot(normal, viewMatrix[2].xyz)) < 0.5 ? 0.9 : 0.97;
  colour = vec4(base * (vSheet == 1 ? plate : shade(vView) * outline(vEdge)), 1.0);
}`;

/** What the ice is coloured by; the last two are for pieces of level ice. */
export const MODES = ['force', 'state', 'age', 'breaking'];

const EDGE = 10; // degrees between faces of a floe

function poseTexture(meta, arrays) {
  const { floes, frames } = meta;
  const { position, orientation, load } = arrays;
  const width = 4096;
  const height = Math.max(1, Math.ceil((2 * floes * frames) / width));
  const texels = new Int16Array(4 * width * height);
  const rows = floes * frames; // of one channel, frames of a floe in a row
  for (let b = 0; b < floes; ++b)
    for (let f = 0; f < frames; ++f) {
      const from = b * frames + f;
      const to = 8 * (f * floes + b);
      for (let d = 0; d < 3; ++d) texels[to + d] = position[d * rows + from];
      texels[to + 3] = load[from];
      for (let d = 0; d < 4; ++d) texels[to + 4 + d] = orientation[d * rows + from];
    }
  const texture = new DataTexture(texels, width, height, RGBAIntegerFormat, ShortType);
  texture.internalFormat = 'RGBA16I';
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return { texture, width };
}

function allFloes(meta, arrays) {
  const soups = meta.shapes.map((shape, k) => (k === 0 ? null : triangleSoup(
    arrays.shape_vertices.subarray(3 * shape.first_vertex),
    arrays.shape_triangles.subarray(3 * shape.first_triangle,
      3 * (shape.first_triangle + shape.triangles)), EDGE)));
  const bodyShape = arrays.body_shape;
  let count = 0;
  for (const s of bodyShape) count += soups[s].position.length / 3;
  const position = new Float32Array(3 * count);
  const edge = new Uint8Array(3 * count);
  const floe = new Float32Array(count);
  const piece = new Float32Array(2 * count).fill(-1);
  let at = 0;
  bodyShape.forEach((s, b) => {
    position.set(soups[s].position, 3 * at);
    edge.set(soups[s].edge, 3 * at);
    const corners = soups[s].position.length / 3;
    floe.fill(b, at, at + corners);
    if (meta.pieces)
      for (let k = at; k < at + corners; ++k)
        piece.set([arrays.piece_born[b], arrays.piece_load[b]], 2 * k);
    at += corners;
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('edge', new BufferAttribute(edge, 3));
  geometry.setAttribute('floe', new BufferAttribute(floe, 1));
  geometry.setAttribute('piece', new BufferAttribute(piece, 2));
  return geometry;
}

/** The mesh; material.uniforms.frame and time move it, mode chooses the colours. */
export function makeFloes({ meta, arrays }) {
  const { texture, width } = poseTexture(meta, arrays);
  const uniforms = {
    poses: { value: texture },
    floes: { value: meta.floes },
    width: { value: width },
    frames: { value: meta.frames },
    frame: { value: 0 },
    scale: { value: new Vector3(...meta.position.scale) },
    offset: { value: new Vector3(...meta.position.offset) },
    loadMax: { value: meta.load.max },
    scaleEnd: { value: meta.load.scale_end },
    time: { value: 0 },
    ageEnd: { value: meta.pieces?.age.scale_end ?? 1 },
    mode: { value: 0 },
    states: { value: STATES.map((s) => new Vector3(...s.rgb.map((c) => c / 255))) },
  };
  const mesh = new Mesh(allFloes(meta, arrays), new ShaderMaterial({ glslVersion: GLSL3,
    vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, side: DoubleSide }));
  mesh.frustumCulled = false; // its box says nothing: the shader moves it
  return mesh;
}
