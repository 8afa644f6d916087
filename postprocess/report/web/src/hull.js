// SPDX-License-Identifier: GPL-3.0-or-later
// The hull: plain (red under water), coloured by its load map or by its regions.

import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, LineBasicMaterial, LineSegments, Mesh,
  ShaderMaterial, Vector3 } from 'three';
import { HULL_DRY, HULL_WET, loadColour, regionColour } from './colours.js';
import { creaseLines, triangleSoup } from './geometry.js';
import { SHADE } from './shade.js';

const VERTEX = `
precision highp float;
in vec3 tint;
out vec3 vView, vTint;
out float vHeight;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0), view = viewMatrix * world;
  vView = view.xyz;
  vTint = tint;
  vHeight = world.z;
  gl_Position = projectionMatrix * view;
}`;

const FRAGMENT = `
precision highp float;
in vec3 vView, vTint;
in float vHeight;
uniform bool plain;
uniform float opacity;
uniform vec3 wet, dry;
out vec4 colour;
${SHADE}
void main() {
  vec3 base = plain ? (vHeight < 0.0 ? wet : dry) : vTint;
  colour = vec4(base * shade(vView), opacity);
}`;

const KNUCKLE = 20; // degrees: the facets of a curved side are no edges

const unit = (rgb) => new Vector3(...rgb.map((c) => c / 255));

/** One colour per triangle, the same at its three corners. */
function tints(triangles, colourOf) {
  const out = new Uint8Array(9 * triangles);
  for (let t = 0; t < triangles; ++t) {
    const rgb = colourOf(t);
    for (let k = 0; k < 3; ++k) out.set(rgb, 9 * t + 3 * k);
  }
  return out;
}

export class Hull {
  constructor({ meta, arrays }) {
    const { scale, offset } = meta.hull;
    const packed = arrays.hull_vertices;
    const vertices = new Float32Array(packed.length);
    for (let k = 0; k < packed.length; ++k)
      vertices[k] = packed[k] * scale[k % 3] + offset[k % 3];
    const soup = triangleSoup(vertices, arrays.hull_triangles, KNUCKLE);
    const triangles = arrays.hull_triangles.length / 3;
    this.tints = {
      load: tints(triangles, (t) => loadColour(arrays.hull_load[t] / 65535)),
      regions: tints(triangles, (t) => regionColour(arrays.hull_region[t])),
    };
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(soup.position, 3));
    geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(9 * triangles), 3, true));
    geometry.computeBoundingBox();
    this.box = geometry.boundingBox;
    this.mesh = new Mesh(geometry, new ShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX,
      fragmentShader: FRAGMENT, side: DoubleSide,
      // a little farther than it is, so that its edges, drawn as lines, are not hidden in places
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      uniforms: { plain: { value: true }, opacity: { value: 1 }, wet: { value: unit(HULL_WET) },
        dry: { value: unit(HULL_DRY) } } }));
    this.mesh.renderOrder = 1;
    const edges = new BufferGeometry();
    edges.setAttribute('position', new BufferAttribute(
      creaseLines(vertices, arrays.hull_triangles, KNUCKLE), 3));
    const lines = new LineSegments(edges, new LineBasicMaterial({ color: 0x3d2a24,
      transparent: true, opacity: 0.7 }));
    lines.renderOrder = 1;
    this.mesh.add(lines);
  }

  /** @param mode plain | load | regions */
  setColours(mode) {
    this.mesh.material.uniforms.plain.value = mode === 'plain';
    if (mode === 'plain') return;
    const tint = this.mesh.geometry.getAttribute('tint');
    tint.array.set(this.tints[mode]);
    tint.needsUpdate = true;
  }

  setSeeThrough(on) {
    const { material } = this.mesh;
    material.uniforms.opacity.value = on ? 0.35 : 1;
    material.transparent = on;
    material.depthWrite = !on;
    material.needsUpdate = true;
  }
}
