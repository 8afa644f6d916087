// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons, slider and legends of the 3D view.

import { STATES, ageColour, breakingColour, css, cssGradient, flowColour, forceColour, loadColour,
  regionColour } from './colours.js';
import { FLOW_END } from './flow.js';

const KEY_STEP = 1 / 60; // of the run, per arrow key

const element = (tag, text, className) => {
  const e = document.createElement(tag);
  if (text) e.textContent = text;
  if (className) e.className = className;
  return e;
};

function swatches(items) {
  const list = element('div', '', 'swatches');
  for (const [name, rgb] of items) {
    const item = element('span', name);
    const box = element('i');
    box.style.background = css(rgb);
    item.prepend(box);
    list.append(item);
  }
  return list;
}

/** Colours are linear; what is above the end has its colour. */
function scaleBar(title, colour, { half_text: half, scale_text: end, unit }, words) {
  const bar = element('div', '', 'scale');
  const colours = element('i');
  colours.style.background = cssGradient(colour);
  const labels = element('div', '', 'labels');
  for (const text of words ?? ['0', half, `≥ ${end}`]) labels.append(element('span', text));
  const both = element('div');
  both.append(colours, labels);
  bar.append(element('b', title), both);
  if (!words) bar.append(element('span', `${unit}, linear scale`));
  return bar;
}

export class Controls {
  constructor(root, run, view, playback) {
    this.root = root;
    this.run = run;
    this.view = view;
    this.playback = playback;
    this.find = (name) => root.querySelector(`[name="${name}"]`);
    this.setTimeControls();
    this.setViewControls();
    this.setKeys();
    playback.onChange((time) => this.show(time));
    this.show(playback.time);
    this.legend();
  }

  setTimeControls() {
    const { playback, find } = this;
    const slider = find('time');
    slider.min = playback.first;
    slider.max = playback.last;
    slider.step = 'any';
    slider.addEventListener('input', () => playback.seek(Number(slider.value)));
    find('play').addEventListener('click', () => playback.toggle());
    find('speed').addEventListener('change', (e) => { playback.speed = Number(e.target.value); });
  }

  setViewControls() {
    const { view, find, root } = this;
    const redraw = () => view.draw();
    for (const button of root.querySelectorAll('[data-camera]'))
      button.addEventListener('click', () => {
        view.camera.apply(button.dataset.camera);
        redraw();
      });
    const on = (name, act) => find(name).addEventListener('change', (e) => {
      act(e.target.type === 'checkbox' ? e.target.checked : e.target.value);
      this.legend();
      redraw();
    });
    find('picture').addEventListener('click', () => {
      view.draw();
      const link = element('a');
      link.href = root.querySelector('canvas').toDataURL();
      link.download = `${document.title}, ${this.root.querySelector('.clock').textContent}.png`;
      link.click();
    });
    on('follow', (follow) => { view.follow = follow; });
    on('water', (shown) => view.setWater(shown));
    if (view.flow) {
      find('flow').closest('label').hidden = false;
      on('flow', (shown) => { view.flow.visible = shown; });
    }
    if (this.run.meta.pieces) {
      find('ice').append(new Option('time since it broke off', 'age'),
        new Option('load that broke it off', 'breaking'));
      find('ice').value = 'age';
      view.setIceColours('age');
    }
    on('through', (through) => view.hull.setSeeThrough(through));
    on('ice', (mode) => view.setIceColours(mode));
    on('hull', (mode) => view.hull.setColours(mode));
  }

  /** Space plays, arrows step; only while the view or its buttons have the focus. */
  setKeys() {
    const { playback } = this;
    this.root.addEventListener('keydown', (e) => {
      if (['SELECT', 'INPUT', 'BUTTON'].includes(e.target.tagName)) return;
      const step = (playback.last - playback.first) * KEY_STEP;
      if (e.key === ' ') playback.toggle();
      else if (e.key === 'ArrowRight') playback.seek(playback.time + step);
      else if (e.key === 'ArrowLeft') playback.seek(playback.time - step);
      else return;
      e.preventDefault();
    });
  }

  show(time) {
    const { find, playback } = this;
    find('time').value = time;
    const text = `t = ${time.toFixed(2)} s`;
    for (const clock of this.root.querySelectorAll('.clock')) clock.textContent = text;
    find('play').textContent = playback.playing ? '❚❚' : '▶';
    find('play').setAttribute('aria-label', playback.playing ? 'Pause' : 'Play');
  }

  legend() {
    const { meta } = this.run;
    const place = this.root.querySelector('.legend3d');
    const parts = [];
    const states = STATES.map((s) => [s.name, s.rgb]);
    const ice = this.find('ice').value;
    const unbroken = swatches([['unbroken', STATES[0].rgb]]);
    if (ice === 'state') parts.push(swatches(states));
    else if (ice === 'age') {
      const { half_text: half, scale_text: end } = meta.pieces.age;
      parts.push(scaleBar('Time since it broke off', ageColour, meta.pieces.age,
        ['just now', `${half} s ago`, `${end} s ago`]), unbroken);
    }
    else if (ice === 'breaking')
      parts.push(scaleBar('Load that broke it off', breakingColour, meta.pieces.load), unbroken);
    else parts.push(scaleBar('Force of the ship on a floe', forceColour, meta.load));
    const hull = this.find('hull').value;
    if (hull === 'load')
      parts.push(scaleBar('Mean load on the hull', loadColour, meta.hull));
    if (hull === 'regions')
      parts.push(swatches(meta.hull.regions.map(([k, name]) => [name, regionColour(k)])));
    if (this.view.flow?.visible)
      parts.push(scaleBar('Speed of the water', flowColour, { half_text: FLOW_END / 2,
        scale_text: FLOW_END, unit: "of the ship's speed" }));
    place.replaceChildren(...parts);
  }

  /** Sets a control as a user would. */
  set(name, value) {
    const control = this.find(name);
    if (!control) return;
    if (control.type === 'checkbox') control.checked = value === '1' || value === 'true';
    else control.value = value;
    control.dispatchEvent(new Event(name === 'time' ? 'input' : 'change'));
  }
}
