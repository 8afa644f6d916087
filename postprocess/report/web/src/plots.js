// SPDX-License-Identifier: GPL-3.0-or-later
// Histories as uPlot charts in place of the page's drawn ones. Click seeks, dragging zooms, a
// double click shows the whole run again.

import uPlot from 'uplot';

const HEIGHT = 230;
const CLICK = 4; // px: a press that moves less is a click, not a zoom

const values = (array, factor) => Float64Array.from(array, (v) => v * factor);

/** Limits of an axis around [low, high] with some room; zero is always inside. */
function roomy(low, high) {
  const [from, to] = [Math.min(low, 0), Math.max(high, 0)];
  const room = 0.08 * (to - from || 1);
  return [from < 0 ? from - room : 0, to > 0 ? to + room : 0];
}

/** Five significant digits at most, no exponents: "-1250.4", "0.012". */
const digits = (v) => (v === null || v === undefined ? '–' : `${Number(v.toPrecision(5))}`);

function axis(label) {
  const line = { stroke: '#dde3e8', width: 1 };
  return { label, labelSize: 20, labelFont: '12px system-ui, sans-serif', size: 56, grid: line,
    ticks: line, stroke: '#1d2730', font: '12px system-ui, sans-serif' };
}

function series(s) {
  return { label: s.label, stroke: s.color, width: s.width, dash: s.dash, alpha: s.alpha ?? 1,
    points: { show: false }, value: (u, v) => digits(v) };
}

class Chart {
  constructor(holder, spec, arrays) {
    this.spec = spec;
    this.peaks = false;
    this.data = [Float64Array.from(arrays[spec.time]),
      ...spec.series.map((s) => values(arrays[s.array], s.scale))];
    this.holder = document.createElement('div');
    this.holder.className = 'live';
    holder.append(this.holder);
    this.plot = new uPlot(this.options(), this.data, this.holder);
    this.now = document.createElement('div');
    this.now.className = 'now';
    this.plot.over.append(this.now);
    new ResizeObserver(() => this.plot.setSize({ width: this.holder.clientWidth,
      height: HEIGHT })).observe(this.holder);
  }

  options() {
    const { spec } = this;
    return { title: spec.title, width: this.holder.clientWidth || 320, height: HEIGHT,
      cursor: { sync: { key: 'run', setSeries: false }, drag: { x: true, y: false } },
      scales: { x: { time: false }, y: { range: (u, low, high) => this.range(low, high) } },
      axes: [{ ...axis('time [s]'), size: 36 }, axis(spec.unit)],
      series: [{ label: 't [s]', value: (u, v) => digits(v) }, ...spec.series.map(series)],
      hooks: { drawClear: [(u) => this.shade(u)], draw: [(u) => this.drawMean(u)],
        setSize: [() => this.show(this.time)], setScale: [() => this.show(this.time)] } };
  }

  /** Averages decide what is shown, unless peaks are asked for: single hits are far higher. */
  range(low, high) {
    if (low === null) return [0, 1];
    return this.peaks || !this.spec.range ? roomy(low, high) : roomy(...this.spec.range);
  }

  shade(u) {
    const { from, to } = this.spec.averaged ?? {};
    if (from === undefined) return;
    const [left, right] = [from, to].map((t) => u.valToPos(t, 'x', true));
    const edge = Math.max(left, u.bbox.left);
    u.ctx.fillStyle = '#f1f5f8';
    u.ctx.fillRect(edge, u.bbox.top,
      Math.max(0, Math.min(right, u.bbox.left + u.bbox.width) - edge), u.bbox.height);
  }

  drawMean(u) {
    if (this.spec.mean === undefined) return;
    const y = u.valToPos(this.spec.mean, 'y', true);
    u.ctx.save();
    u.ctx.strokeStyle = '#222222';
    u.ctx.setLineDash([6, 4]);
    u.ctx.beginPath();
    u.ctx.moveTo(u.bbox.left, y);
    u.ctx.lineTo(u.bbox.left + u.bbox.width, y);
    u.ctx.stroke();
    u.ctx.restore();
  }

  setPeaks(on) {
    this.peaks = on;
    this.plot.setData(this.data, false);
    this.plot.setScale('x', { min: this.plot.scales.x.min, max: this.plot.scales.x.max });
  }

  /** The line of the instant that the 3D view shows. */
  show(time) {
    this.time = time;
    if (!this.now || time === undefined) return;
    const x = this.plot.valToPos(time, 'x');
    this.now.hidden = !(x >= 0 && x <= this.plot.over.clientWidth);
    this.now.style.transform = `translateX(${x}px)`;
  }

  onClick(seek) {
    let pressed = 0;
    const { over } = this.plot;
    over.addEventListener('mousedown', (e) => { pressed = e.clientX; });
    over.addEventListener('click', (e) => {
      if (Math.abs(e.clientX - pressed) > CLICK) return;
      seek(this.plot.posToVal(e.clientX - over.getBoundingClientRect().left, 'x'));
    });
  }
}

/** Charts of meta.charts in the page's elements with the same data-chart; the drawings go. */
export function makeCharts({ meta, arrays }, seek) {
  const charts = [];
  for (const spec of meta.charts) {
    const holder = document.querySelector(`[data-chart="${spec.id}"]`);
    if (!holder) continue;
    for (const drawing of holder.querySelectorAll('svg')) drawing.classList.add('replaced');
    const chart = new Chart(holder, spec, arrays);
    chart.onClick(seek);
    charts.push(chart);
  }
  return charts;
}
