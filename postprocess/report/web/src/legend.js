// SPDX-License-Identifier: GPL-3.0-or-later
// A chart's legend: each curve's line as it is drawn, its name and its value at the pointer, else
// at the instant that the 3D view shows. A click on a curve hides or shows it.

import { readable } from './numbers.js';

function mark({ color, width = 1, alpha = 1, dash }) {
  const name = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(name, 'svg');
  const line = document.createElementNS(name, 'line');
  const set = (e, values) => Object.entries(values).forEach(([k, v]) => e.setAttribute(k, v));
  set(svg, { width: 24, height: 10, 'aria-hidden': 'true' });
  set(line, { x1: 1, x2: 23, y1: 5, y2: 5, stroke: color, opacity: alpha,
    'stroke-width': width > 1 ? 3 : 1.5, 'stroke-dasharray': dash ? dash.join(' ') : 'none' });
  svg.append(line);
  return svg;
}

export class Legend {
  /** @param onToggle called with the number of a series and whether it is shown */
  constructor(spec, onToggle) {
    this.element = document.createElement('div');
    this.element.className = 'keys';
    this.time = document.createElement('span');
    this.time.className = 'at';
    this.values = spec.series.map((s, k) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.title = 'hide or show this curve';
      button.setAttribute('aria-pressed', 'true');
      const value = document.createElement('output');
      button.append(mark(s), s.label, value);
      button.addEventListener('click', () => {
        const shown = button.getAttribute('aria-pressed') !== 'true';
        button.setAttribute('aria-pressed', String(shown));
        onToggle(k, shown);
      });
      this.element.append(button);
      return value;
    });
    if (spec.mean !== undefined) {
      const level = document.createElement('span');
      level.append(mark({ color: '#222222', dash: [6, 4] }), `mean ${readable(spec.mean)}`);
      this.element.append(level);
    }
    this.element.append(this.time);
  }

  /** @param values of the series, in the chart's unit */
  show(time, values) {
    this.time.textContent = `at t = ${time.toFixed(2)} s`;
    values.forEach((v, k) => { this.values[k].textContent = readable(v); });
  }
}
