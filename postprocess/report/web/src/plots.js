// SPDX-License-Identifier: GPL-3.0-or-later
// Histories as uPlot charts in place of the page's drawn ones. Click seeks, dragging zooms, a
// double click shows the whole run again.

import uPlot from 'uplot';
import { csvText } from './csv.js';
import { findPlace } from './data.js';
import { Legend } from './legend.js';
import { chooseUnit, tickText } from './numbers.js';

const HEIGHT = 230;
const CLICK = 4; // px: a press that moves less is a click, not a zoom

const values = (array, factor) => Float64Array.from(array, (v) => v * factor);

/** A history begins one step after 0, where its axis begins; a zoomed one begins where asked. */
const fromZero = (low, high) => [low > 0 && low < 0.02 * high ? 0 : low, high];

/** Limits of an axis around [low, high] with some room; zero is always inside. */
function roomy(low, high) {
  const [from, to] = [Math.min(low, 0), Math.max(high, 0)];
  const room = 0.08 * (to - from || 1);
  return [from < 0 ? from - room : 0, to > 0 ? to + room : 0];
}

/** An axis as wide as its labels are: a title never lies on them. */
function axisSize(u, texts, index, cycle) {
  const axis = u.axes[index];
  if (cycle > 1) return axis._size;
  u.ctx.font = axis.font[0];
  const widths = (texts ?? []).map((text) => u.ctx.measureText(text ?? '').width);
  return Math.ceil(axis.ticks.size + axis.gap + Math.max(0, ...widths) / devicePixelRatio);
}

function axis(label) {
  const line = { stroke: '#dde3e8', width: 1 };
  const font = '12px system-ui, sans-serif';
  return { label, labelSize: 20, labelFont: font, size: axisSize, grid: line,
    ticks: { ...line, size: 6 }, stroke: '#1d2730', font,
    values: (u, splits, k, space, step) => splits.map((v) => tickText(v, step)) };
}

function series(s) {
  return { label: s.label, stroke: s.color, width: s.width, dash: s.dash, alpha: s.alpha ?? 1,
    points: { show: false } };
}

class Chart {
  constructor(holder, spec, arrays) {
    this.spec = spec;
    this.peaks = false;
    this.unit = chooseUnit(spec.unit, 0);
    this.data = [Float64Array.from(arrays[spec.time]),
      ...spec.series.map((s) => values(arrays[s.array], s.scale))];
    this.holder = document.createElement('div');
    this.holder.className = 'live';
    holder.append(this.holder);
    this.legend = new Legend(spec, (k, show) => this.plot.setSeries(k + 1, { show }));
    this.plot = new uPlot(this.options(), this.data, this.holder);
    this.holder.append(this.legend.element);
    this.now = document.createElement('div');
    this.now.className = 'now';
    this.plot.over.append(this.now);
    new ResizeObserver(() => this.plot.setSize({ width: this.holder.clientWidth,
      height: HEIGHT })).observe(this.holder);
    // the page's buttons (tools.js) offer the numbers, too
    holder.csv = () => this.csv();
    holder.dispatchEvent(new Event('live'));
  }

  options() {
    const { spec } = this;
    const upright = axis(() => this.unit.title);
    upright.values = (u, splits, k, space, step) => {
      const { factor } = this.unit;
      return splits.map((v) => tickText(v * factor, step * factor));
    };
    return { title: spec.title, width: this.holder.clientWidth || 320, height: HEIGHT,
      legend: { show: false },
      cursor: { sync: { key: 'run', setSeries: false }, drag: { x: true, y: false } },
      scales: { x: { time: false, range: (u, low, high) => fromZero(low, high) },
        y: { range: (u, low, high) => this.range(low, high) } },
      axes: [{ ...axis('time [s]'), size: 32 }, upright],
      series: [{ label: 't [s]' }, ...spec.series.map(series)],
      hooks: { drawClear: [(u) => this.shade(u)], draw: [(u) => this.drawMean(u)],
        setCursor: [() => this.tell()],
        setSize: [() => this.show(this.time)], setScale: [() => this.show(this.time)] } };
  }

  /** Values in the legend: at the pointer, else now. */
  tell() {
    const pointed = this.plot?.cursor.idx;
    const time = pointed != null ? this.data[0][pointed] : this.time;
    if (time === undefined || this.data[0].length === 0) return;
    const { row, part } = findPlace(this.data[0], time);
    const k = pointed ?? (part < 0.5 ? row : row + 1);
    this.legend.show(time, this.data.slice(1).map((v) => v[k]));
  }

  /** All samples as CSV, in the unit of the chart. */
  csv() {
    const unit = /\[.*\]/.exec(this.spec.unit)?.[0] ?? '';
    const rows = [['time [s]', ...this.spec.series.map((s) => `${s.label} ${unit}`.trim())]];
    for (let k = 0; k < this.data[0].length; ++k)
      rows.push(this.data.map((v) => (Number.isFinite(v[k]) ? Number(v[k].toPrecision(6)) : '')));
    return csvText(rows);
  }

  /** Averages decide what is shown, unless peaks are asked for: single hits are far higher. */
  range(low, high) {
    if (low === null) return [0, 1];
    const shown = this.peaks || !this.spec.range ? roomy(low, high) : roomy(...this.spec.range);
    this.unit = chooseUnit(this.spec.unit, Math.max(-shown[0], shown[1]));
    return shown;
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
    this.now.hidden = !(x >= -0.5 && x <= this.plot.over.clientWidth + 0.5);
    this.now.style.transform = `translateX(${x}px)`;
    this.tell();
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
