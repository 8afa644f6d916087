// SPDX-License-Identifier: GPL-3.0-or-later
// Hull, floes and water drawn at one instant.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, PlaneGeometry, Quaternion, Scene, Vector3, WebGLRenderer } from 'three';
import { Camera } from './camera.js';
import { findPlace } from './data.js';
import { MODES, makeFloes } from './floes.js';
import { makeFlow } from './flow.js';
import { Hull } from './hull.js';

const ABOVE = new Color(0xeef4f8);
const BELOW = new Color(0x9fc4d8);

/** 1, 2 or 5 times a power of ten at or below x. */
function roundDown(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1);
}

/** Lines on the water, fixed to the world: they show that the ship moves, and how far. */
function makeGrid(step, count) {
  const points = [];
  const end = step * count;
  for (let k = -count; k <= count; ++k)
    points.push(-end, k * step, 0, end, k * step, 0, k * step, -end, 0, k * step, end, 0);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: 0x2b7bb9, transparent: true,
    opacity: 0.3 }));
}

export class View {
  /** @pre the browser has WebGL 2 */
  constructor(canvas, run) {
    this.run = run;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.hull = new Hull(run);
    this.floes = run.meta.floes > 0 ? makeFloes(run) : null;
    this.camera = new Camera(canvas, this.hull.box, run.meta.dimension === 2);
    const { length } = this.camera;
    this.water = new Mesh(new PlaneGeometry(40 * length, 40 * length), new MeshBasicMaterial({
      color: 0x3d8fbf, transparent: true, opacity: 0.22, side: DoubleSide, depthWrite: false }));
    this.water.renderOrder = 2;
    this.gridStep = roundDown(length / 5);
    this.grid = makeGrid(this.gridStep, 30);
    this.grid.renderOrder = 3;
    this.scene.add(this.hull.mesh, this.water, this.grid);
    if (this.floes) this.scene.add(this.floes);
    this.flow = makeFlow(run, length);
    if (this.flow) this.scene.add(this.flow);
    this.follow = true;
    this.canvas = canvas;
    this.resize();
    this.seek(run.arrays.frame_time[0]);
    this.camera.apply(this.camera.preset);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.setSize(width, height);
  }

  shipAt({ row, part }) {
    const { ship } = this.run.arrays;
    const next = Math.min(row + 1, ship.length / 3 - 1);
    return new Vector3(...[0, 1, 2].map((d) =>
      ship[3 * row + d] + part * (ship[3 * next + d] - ship[3 * row + d])));
  }

  /** Turns the hull of a free ship; others keep their heading. */
  turnShip({ row, part }) {
    const turn = this.run.arrays.ship_turn;
    if (!turn || turn.length === 0) return;
    const at = (k) => new Quaternion().fromArray(turn, 4 * Math.min(k, turn.length / 4 - 1));
    this.hull.mesh.quaternion.copy(at(row).slerp(at(row + 1), part));
  }

  seek(time) {
    const place = findPlace(this.run.arrays.frame_time, time);
    if (this.floes) {
      const { uniforms } = this.floes.material;
      uniforms.frame.value = place.row + place.part;
      uniforms.time.value = time;
    }
    const ship = this.shipAt(place);
    this.hull.mesh.position.copy(ship);
    this.turnShip(place);
    this.water.position.set(ship.x, ship.y, 0);
    this.flow?.position.set(ship.x, ship.y, 0);
    const snap = (x) => Math.round(x / this.gridStep) * this.gridStep;
    this.grid.position.set(snap(ship.x), snap(ship.y), 0);
    this.camera.moveShip(ship, this.follow);
  }

  setIceColours(mode) {
    if (this.floes) this.floes.material.uniforms.mode.value = Math.max(0, MODES.indexOf(mode));
  }

  setWater(on) {
    this.water.visible = on;
    this.grid.visible = on;
  }

  draw() {
    this.renderer.setClearColor(this.camera.eye.position.z < 0 ? BELOW : ABOVE);
    this.renderer.render(this.scene, this.camera.eye);
  }
}
