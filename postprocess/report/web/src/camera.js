// SPDX-License-Identifier: GPL-3.0-or-later
// Where the viewer stands: presets that fit the ship into the picture, and following the ship.

import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

// Directions from the ship to the viewer, as in the report's drawings. The tiny parts keep "up" on
// the page defined at the poles: y up from above, starboard up from below.
const TOWARD = {
  quarter: [0.55, -0.68, 0.48],
  top: [0, -1e-3, 1],
  side: [0, -1, 0.03],
  front: [1, -1e-3, 0.22],
  below: [0, -1e-3, -1],
  keel: [0.45, -0.72, -0.53],
};
const FIELD_OF_VIEW = 28; // degrees, of the picture's shorter side: nearly parallel

export class Camera {
  constructor(canvas, box, flat) {
    this.eye = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.1, 1000);
    this.eye.up.set(0, 0, 1);
    this.box = box;
    this.flat = flat;
    this.length = box.max.x - box.min.x;
    this.controls = new OrbitControls(this.eye, canvas);
    this.controls.minDistance = 0.05 * this.length;
    this.controls.maxDistance = 12 * this.length;
    this.ship = new Vector3();
    this.preset = flat ? 'side' : 'quarter';
  }

  setSize(width, height) {
    this.eye.aspect = width / height;
    // on a narrow window the width decides
    const half = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    this.eye.fov = (360 / Math.PI) * Math.atan(half / Math.min(1, this.eye.aspect));
    this.eye.near = 0.01 * this.length;
    this.eye.far = 60 * this.length;
    this.eye.updateProjectionMatrix();
  }

  /** Points at the ship from one of TOWARD's directions, so far away that it fits. */
  apply(preset) {
    if (!TOWARD[preset]) return;
    this.preset = preset;
    const { min, max } = this.box;
    const middle = new Vector3(0.5 * (min.x + max.x), 0.5 * (min.y + max.y), 0).add(this.ship);
    const end = preset === 'front';
    const across = end ? 3 * (max.y - min.y) : 1.5 * this.length;
    const half = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const wide = Math.max(1, this.eye.aspect);
    const tall = end ? 1.6 * (max.z - min.z) : this.flat ? 0.3 * this.length : 0.55 * this.length;
    const distance = Math.max((0.5 * across) / (half * wide), (0.5 * tall) / half)
      + 0.5 * (end ? this.length : max.y - min.y);
    this.eye.position.copy(new Vector3(...TOWARD[preset]).normalize().multiplyScalar(distance))
      .add(middle);
    this.controls.target.copy(middle);
    this.controls.update();
  }

  /** Tells where the ship is; the camera goes with it when asked to. */
  moveShip(position, follow) {
    const step = new Vector3().subVectors(position, this.ship);
    this.ship.copy(position);
    if (!follow) return;
    this.eye.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
  }
}
