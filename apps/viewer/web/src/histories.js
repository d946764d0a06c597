// SPDX-License-Identifier: GPL-3.0-or-later
// Histories under the scene: columns of the CSV files of the run, or what the picked element had in every frame.
import uPlot from 'uplot';
import { short, shortUnit } from './colour.js';

const kColours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7f7f7f', '#8d6b1f'];

export class Histories {
  /** @param seek  called with a time (s) when a place of the plot is clicked */
  constructor(element, seek) {
    this.element = element;
    this.seek = seek;
    this.time = 0;
    this.timeUnit = [1, 's'];
    this.plot = null;
    new ResizeObserver(() => this.resize()).observe(element);
  }

  size() { return { width: Math.max(this.element.clientWidth, 50), height: Math.max(this.element.clientHeight - 26, 60) }; }
  resize() { this.plot?.setSize(this.size()); }

  /** @param series  [{name, unit, values}] over times (s); each unit gets an axis, the first two of them are shown */
  draw(times, series, logarithmic) {
    this.plot?.destroy();
    this.plot = null;
    if (!times?.length || !series.length) return;
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue('--ink-soft').trim(), grid = style.getPropertyValue('--line').trim();
    const font = '11px ' + style.getPropertyValue('--font').trim();
    const units = [...new Set(series.map((s) => s.unit))];
    const factors = Object.fromEntries(units.map((unit) => {
      let most = 0;
      for (const s of series) if (s.unit === unit) for (const v of s.values) if (Math.abs(v) > most) most = Math.abs(v);
      return [unit, shortUnit(most, unit)];
    }));
    const [second, timeUnit] = this.timeUnit = shortUnit(times[times.length - 1], 's');
    const data = [Float64Array.from(times, (t) => t / second), ...series.map((s) => Array.from(s.values, (v) => {
      const x = v / factors[s.unit][0];
      return Number.isFinite(x) && (!logarithmic || x > 0) ? x : null;
    }))];
    const axis = { stroke: ink, font, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1, size: 4 } };
    const options = {
      ...this.size(),
      scales: { x: { time: false }, ...Object.fromEntries(units.map((u) => ['u' + u, logarithmic ? { distr: 3 } : {}])) },
      axes: [{ ...axis, size: 26, values: (_, v) => v.map((t) => `${short(t, 6)} ${timeUnit}`) },
        ...units.slice(0, 2).map((unit, k) => ({ ...axis, scale: 'u' + unit, side: k ? 1 : 3, size: 62, grid: k ? { show: false } : axis.grid,
          values: (_, v) => v.map((x) => (x === null ? '' : short(x, 6) + (factors[unit][1] ? ' ' + factors[unit][1] : ''))) }))],
      series: [{ label: 'time', value: (_, v) => (v === null ? '–' : `${short(v, 5)} ${timeUnit}`) }, ...series.map((s, i) => ({
        label: s.name, scale: 'u' + s.unit, stroke: kColours[i % kColours.length], width: 1.6, spanGaps: false, points: { show: times.length < 60, size: 4 },
        value: (_, v) => (v === null ? '–' : short(v, 4) + ' ' + factors[s.unit][1]),
      }))],
      legend: { show: true, live: true },
      cursor: { drag: { x: false, y: false } },
      hooks: { draw: [(u) => this.marker(u)], ready: [() => this.setTime(this.time)], setCursor: [(u) => { if (u.cursor.left < 0) u.setLegend({ idx: u.valToIdx(this.time / this.timeUnit[0]) }); }] },
    };
    this.plot = new uPlot(options, data, this.element);
    const go = (event) => {
      if (event.buttons !== 1 && event.type !== 'click') return;
      const left = event.clientX - this.plot.over.getBoundingClientRect().left;
      this.seek(this.plot.posToVal(left, 'x') * this.timeUnit[0]);
    };
    this.plot.over.addEventListener('click', go);
    this.plot.over.addEventListener('pointermove', go);
    this.plot.over.style.touchAction = 'none';
  }

  /** The line at the time of the frame that is shown. */
  marker(u) {
    const x = u.valToPos(this.time / this.timeUnit[0], 'x', true), { ctx, bbox } = u;
    if (!(x >= bbox.left - 1 && x <= bbox.left + bbox.width + 1)) return;
    ctx.save();
    ctx.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue('--accent');
    ctx.lineWidth = 1.5 * (window.devicePixelRatio || 1);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  setTime(time) {
    this.time = time;
    if (!this.plot?.status) return;   // it is drawn a moment after it is made
    this.plot.setLegend({ idx: this.plot.valToIdx(time / this.timeUnit[0]) });
    this.plot.redraw(false);
  }
}
