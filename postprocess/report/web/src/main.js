// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the page live: 3D playback above the drawings, plots that can be zoomed in their place.
// Without it, without WebGL or in print the page keeps its drawings and tables.

import { Controls } from './controls.js';
import { readRun } from './data.js';
import { Playback } from './playback.js';
import { makeCharts } from './plots.js';
import { View } from './scene.js';

function say(section, text) {
  const note = document.createElement('p');
  note.className = 'note';
  note.textContent = text;
  section.querySelector('.stage').replaceWith(note);
  for (const part of section.querySelectorAll('.controls, .legend3d, .help')) part.remove();
}

/** The 3D view with its controls, or null and a note that says why there is none. */
function makeView(section, run, playback) {
  // asked first on a canvas of its own: three.js would fill the console with errors
  if (!document.createElement('canvas').getContext('webgl2')) {
    say(section, 'No 3D playback here: the browser gives no WebGL 2. The drawings below show the '
      + 'same run.');
    return null;
  }
  const canvas = section.querySelector('canvas');
  const view = new View(canvas, run);
  playback.onChange((time) => {
    view.seek(time);
    view.draw();
  });
  view.camera.controls.addEventListener('change', () => view.draw());
  new ResizeObserver(() => {
    view.resize();
    view.draw();
  }).observe(canvas);
  return view;
}

/** #t=12.5&camera=below&ice=state&hull=load opens the page there. */
function followAddress(playback, view, controls) {
  const wanted = new URLSearchParams(window.location.hash.slice(1));
  for (const name of ['ice', 'hull', 'follow', 'water', 'through', 'flow'])
    if (wanted.has(name)) controls?.set(name, wanted.get(name));
  if (wanted.has('t')) playback.seek(Number(wanted.get('t')) || 0);
  if (view && wanted.has('camera')) view.camera.apply(wanted.get('camera'));
  view?.draw();
}

function setUpCharts(run, playback) {
  const charts = makeCharts(run, (time) => playback.seek(time));
  playback.onChange((time) => charts.forEach((chart) => chart.show(time)));
  const peaks = document.querySelector('[name="peaks"]');
  if (peaks) {
    peaks.closest('label').hidden = false;
    peaks.addEventListener('change', () => charts.forEach((c) => c.setPeaks(peaks.checked)));
  }
  return charts;
}

async function start() {
  const section = document.getElementById('playback');
  if (typeof DecompressionStream === 'undefined') {
    document.documentElement.dataset.viewer = 'old-browser';
    return;
  }
  const run = await readRun();
  const times = run.arrays.frame_time;
  const history = run.arrays.history_time;
  const last = Math.max(times.at(-1) ?? 0, history.at(-1) ?? 0);
  const playback = new Playback(times[0] ?? 0, last);
  let view = null;
  let controls = null;
  if (section && times.length > 0) {
    section.hidden = false;
    view = makeView(section, run, playback);
    if (view) {
      controls = new Controls(section, run, view, playback);
      document.getElementById('views')?.removeAttribute('open');
    }
  }
  const charts = setUpCharts(run, playback);
  // level ice is whole at first: its channel is seen at the end
  playback.seek(run.meta.pieces ? playback.last : playback.first);
  followAddress(playback, view, controls);
  window.icepost = { run, playback, view, controls, charts };
  document.documentElement.dataset.viewer = view ? 'ready' : 'no-webgl';
}

start();
