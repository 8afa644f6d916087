// SPDX-License-Identifier: GPL-3.0-or-later
// The water's flow as arrows that go along with the ship: on the water, and along the hull.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial,
  SRGBColorSpace, Vector3 } from 'three';
import { flowColour } from './colours.js';

export const FLOW_END = 0.5; // of the ship's speed: where colours and lengths end
const LONGEST = 0.05; // of the hull's length
const WIDTH = 0.12; // of an arrow's length

/** Three sides of a narrow pyramid from its foot `at` along `w`. */
function addArrow(at, w, longest, position) {
  const speed = w.length();
  const along = w.clone().divideScalar(speed);
  const length = longest * Math.max(0.2, Math.min(1, speed / FLOW_END));
  const across = new Vector3(along.y, -along.x, 0);
  if (across.lengthSq() < 1e-6) across.set(1, 0, 0);
  across.normalize();
  const up = new Vector3().crossVectors(along, across);
  const foot = [0, 1, 2].map((k) => at.clone()
    .addScaledVector(across, WIDTH * length * Math.cos((2 * Math.PI * k) / 3))
    .addScaledVector(up, WIDTH * length * Math.sin((2 * Math.PI * k) / 3)));
  const tip = at.clone().addScaledVector(along, length);
  for (let k = 0; k < 3; ++k)
    for (const p of [foot[k], foot[(k + 1) % 3], tip]) position.push(p.x, p.y, p.z);
}

/** One mesh of all arrows, not shown at first; null where the run has no flow. */
export function makeFlow({ arrays }, hullLength) {
  const { flow_point: points, flow_velocity: velocities } = arrays;
  if (!points || points.length === 0) return null;
  const position = [];
  const colour = new Float32Array(9 * points.length);
  for (let k = 0; k < points.length / 3; ++k) {
    const w = new Vector3().fromArray(velocities, 3 * k);
    addArrow(new Vector3().fromArray(points, 3 * k), w, LONGEST * hullLength, position);
    const rgb = new Color().setRGB(...flowColour(w.length() / FLOW_END).map((c) => c / 255),
      SRGBColorSpace).toArray();
    for (let corner = 0; corner < 9; ++corner) colour.set(rgb, 27 * k + 3 * corner);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(position), 3));
  geometry.setAttribute('color', new BufferAttribute(colour, 3));
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
  mesh.visible = false;
  mesh.renderOrder = 4;
  return mesh;
}
