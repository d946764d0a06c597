// SPDX-License-Identifier: GPL-3.0-or-later
// The page: settings, time, legends, histories, keys.
import * as THREE from 'three';
import { Run } from './data.js';
import { Stage } from './stage.js';
import { View, choicesOf, scalars } from './view.js';
import { Histories } from './histories.js';
import { selfCheck, verdictOf } from './self_check.js';
import { colourAt, kCategories, kMaps, short, shortUnit, ticks, withUnit } from './colour.js';

const $ = (id) => document.getElementById(id);
/** An element with properties and children. */
function el(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (key in element && key !== 'style') element[key] = value;
    else element.setAttribute(key, value);
  }
  element.append(...children.filter((c) => c !== null && c !== undefined));
  return element;
}
const row = (label, ...controls) => el('div', { className: 'row' }, el('span', {}, label), ...controls);

const kParts = ['grains', 'membranes', 'contacts'];
const kTitles = { grains: 'Grains', membranes: 'Membranes', contacts: 'Contacts' };
// What is shown at first, where there is such a field.
const kFirst = { grains: ['velocity', 'radius'], membranes: ['tension', 'axial_stress', 'velocity'], contacts: ['normal_force_magnitude'] };

class Page {
  constructor(run, stage) {
    this.run = run;
    this.stage = stage;
    this.view = new View(run, stage);
    this.choices = Object.fromEntries(kParts.map((part) => [part, choicesOf(run.header, part)]));
    this.colours = { grains: { map: 'viridis' }, membranes: { map: run.frames.some((f) => f.facets) ? 'sand' : 'cividis' }, contacts: { map: 'inferno' } };
    for (const part of kParts)
      Object.assign(this.colours[part], { key: this.firstKey(part), mode: 'linear', range: part === 'contacts' ? 'frame' : 'run', lo: null, hi: null });
    this.frame = 0;
    this.notes = [];   // of the page itself, beside those of the run
    this.playing = null;
    this.chosen = { file: null, columns: new Set(), logarithmic: false, element: null };
    this.histories = new Histories($('plot'), (time) => this.goTo(this.frameAt(time)));
    stage.onDraw.push(() => this.overlay());
    stage.beforeDraw.push(() => this.view.look());
  }

  firstKey(part) {
    const keys = this.choices[part].map((c) => c.key);
    for (const key of kFirst[part]) {
      const choice = this.choices[part].find((c) => c.key === key);
      if (choice && choice.range[1] > choice.range[0]) return key;
    }
    return keys[0] ?? '';
  }

  choice(part) { return this.choices[part].find((c) => c.key === this.colours[part].key) ?? null; }

  names(field) {
    const names = this.run.header.names ?? this.run.header.run?.names ?? {};
    return field === 'material' ? names.materials : field === 'grains' ? names.grains : field === 'membrane' ? names.membranes : null;
  }

  isCategory(choice) { return choice !== null && choice.whole; }

  /** Range (SI) of the colours of a part; the middle of signed quantities is zero. */
  rangeOf(part) {
    const choice = this.choice(part), c = this.colours[part];
    if (!choice) return [0, 1];
    if (c.lo !== null && c.hi !== null && c.hi > c.lo && (c.mode !== 'log' || c.hi > 0)) return [c.mode === 'log' && !(c.lo > 0) ? c.hi * 1e-4 : c.lo, c.hi];
    let [lo, hi] = c.range === 'extremes' ? choice.range : c.range === 'frame' ? this.frameRange(part) ?? choice.usual : usualRange(choice);
    if (!(hi > lo)) [lo, hi] = choice.range;
    if (lo < 0 && -lo < 0.4 * hi && choice.axis < 0) lo = 0;
    else if (lo < 0 && hi > 0) { const most = Math.max(-lo, hi); [lo, hi] = [-most, most]; }
    else if (lo > 0 && lo < 0.5 * hi) lo = 0;
    else if (hi < 0 && hi > 0.5 * lo) hi = 0;
    if (!(hi > lo)) { const pad = Math.abs(lo) * 0.01 || 1; lo -= pad; hi += pad; }
    if (c.mode === 'log') { hi = Math.max(hi, 1e-30); lo = Math.max(choice.range[0], hi * 1e-4); }
    return [lo, hi];
  }

  frameRange(part) {
    const data = this.view.data;
    const sets = part === 'grains' ? [data.grainValues] : part === 'contacts' ? [data.contactValues]
      : [data.membraneValues?.nodes, data.membraneValues?.edges, data.membraneValues?.facets];
    let lo = Infinity, hi = -Infinity;
    for (const values of sets) if (values) for (const v of values) { if (v < lo) lo = v; if (v > hi) hi = v; }
    return hi > lo ? [lo, hi] : null;
  }

  /** The map of a part: one with a neutral middle for what has both signs. */
  mapOf(part) {
    const [lo, hi] = this.rangeOf(part);
    const c = this.colours[part];
    return !c.byHand && lo < 0 && hi > 0 ? 'blue-orange' : c.map;
  }

  applyColours() {
    for (const part of kParts) {
      if (this.sections?.[part]?.map) this.sections[part].map.value = this.mapOf(part);
      const choice = this.choice(part), c = this.colours[part];
      this.view.settings[part].field = choice;
      const mode = !choice ? 0 : this.isCategory(choice) ? 3 : c.mode === 'log' ? 2 : 1;
      this.view.paint[part].set({ map: this.mapOf(part), range: this.rangeOf(part), mode });
    }
    const forces = this.choice('contacts');
    this.view.forceRange = forces?.field === 'normal_force_magnitude' ? this.rangeOf('contacts') : null;
  }

  async reload() {
    this.applyColours();
    if (!await this.view.show(this.frame)) return;
    this.applyColours();
    this.view.build();
    this.legends();
  }

  async goTo(k) {
    k = Math.min(Math.max(Math.round(k), 0), this.run.frames.length - 1);
    this.frame = k;
    $('slider').value = k;
    const { time } = this.run.frames[k];
    const end = this.run.frames.at(-1).time, [factor, unit] = shortUnit(end, 's');
    // As many digits in every frame, so that they stand still while it plays.
    const decimals = Math.min(Math.max(3 - Math.floor(Math.log10(end / factor || 1) - 1e-9), 0), 9);
    const moment = `${(time / factor).toFixed(decimals)} ${unit}`;
    $('moment').textContent = `${moment} · ${k + 1} / ${this.run.frames.length}`;
    $('clock').textContent = moment;
    this.histories.setTime(time);
    const shown = await this.view.show(k);
    if (!shown) return;
    if (kParts.some((part) => this.colours[part].range === 'frame')) { this.applyColours(); this.view.build(); this.legends(); }
    this.counts();
    await this.followSelected();
  }

  frameAt(time) {
    const frames = this.run.frames;
    let best = 0;
    for (let k = 1; k < frames.length; k++) if (Math.abs(frames[k].time - time) < Math.abs(frames[best].time - time)) best = k;
    return best;
  }

  // --- play ---
  play(on = !this.playing) {
    if (this.playing) cancelAnimationFrame(this.playing.id);
    this.playing = null;
    $('play').textContent = on ? '❚❚' : '▶';
    if (!on) return;
    if (this.frame >= this.run.frames.length - 1) this.goTo(0);
    const perSecond = Math.max(this.run.frames.length / 10, Math.min(12, this.run.frames.length / 3));
    const state = { at: this.frame, before: performance.now(), busy: false };
    const step = async (now) => {
      state.id = requestAnimationFrame(step);
      const passed = Math.min(now - state.before, 250);
      state.before = now;
      if (state.busy) return;
      state.at += passed / 1000 * perSecond * Number($('speed').value);
      const k = Math.min(Math.floor(state.at), this.run.frames.length - 1);
      if (k !== this.frame) {
        state.busy = true;
        try { await this.goTo(k); } finally { state.busy = false; }
      }
      if (k >= this.run.frames.length - 1 && !this.run.live) this.play(false);
    };
    this.playing = state;
    state.id = requestAnimationFrame(step);
  }

  // --- legends, scale bar, axes ---
  legends() {
    const box = $('legends');
    box.replaceChildren();
    const frame = this.run.frames[this.frame];
    const present = { grains: frame.grains, membranes: frame.nodes, contacts: frame.contacts };
    for (const part of kParts) {
      const choice = this.choice(part);
      if (!choice || !present[part] || !this.view.settings[part].shown || this.view.settings[part].opacity === 0) continue;
      box.append(this.isCategory(choice) ? this.categoryLegend(part, choice) : this.barLegend(part, choice));
    }
  }

  categoryLegend(part, choice) {
    const names = this.names(choice.field);
    const lines = [];
    const last = Math.min(choice.range[1], choice.range[0] + 11);
    for (let i = choice.range[0]; i <= last; i++) {
      const c = kCategories[((i % 8) + 8) % 8];
      const name = names?.[i] ?? (choice.field.startsWith('is_') ? ['no', 'yes'][i] : String(i));
      lines.push(el('div', {}, el('i', { style: `background: rgb(${c})` }), name || String(i)));
    }
    if (last < choice.range[1]) lines.push(el('div', {}, '…'));
    return el('div', { className: 'legend' }, el('h2', {}, kTitles[part], el('span', {}, choice.label)), el('div', { className: 'names' }, ...lines));
  }

  barLegend(part, choice) {
    const [lo, hi] = this.rangeOf(part), log = this.colours[part].mode === 'log';
    const [factor, unit] = shortUnit(Math.max(Math.abs(lo), Math.abs(hi)), choice.unit);
    const bar = el('canvas', { width: 1, height: 150 });
    const ctx = bar.getContext('2d'), map = this.mapOf(part);
    for (let y = 0; y < 150; y++) {
      ctx.fillStyle = `rgb(${colourAt(map, 1 - y / 149).map(Math.round)})`;
      ctx.fillRect(0, y, 1, 1);
    }
    const at = (v) => (log ? Math.log(v / lo) / Math.log(hi / lo) : (v - lo) / (hi - lo));
    const marks = [];
    if (log) for (let p = Math.ceil(Math.log10(lo / factor) - 1e-9); 10 ** p * factor <= hi * 1.0001; p++) marks.push(10 ** p * factor);
    else for (const t of ticks(lo / factor, hi / factor, 5)) marks.push(t * factor);
    const beyond = choice.range[1] > hi * 1.0001 + 1e-30;
    const labels = marks.map((v) => el('span', { style: `bottom: ${100 * at(v)}%` }, short(v / factor, 4)));
    return el('div', { className: 'legend' },
      el('h2', {}, kTitles[part] + (unit ? `, ${unit}` : ''), el('span', { title: choice.what }, choice.label)),
      bar, el('div', { className: 'ticks', title: beyond ? `up to ${withUnit(choice.range[1], choice.unit)}` : '' }, ...labels));
  }

  overlay() {
    const { stage } = this;
    const want = 120 * stage.pixelLength;
    const power = 10 ** Math.floor(Math.log10(want));
    const length = power * [1, 2, 5, 10].filter((m) => m * power <= want).at(-1);
    $('scale-bar').style.width = `${length / stage.pixelLength}px`;
    $('scale-text').textContent = withUnit(length, 'm') + (isParallel(stage) ? '' : ' at the middle');
    const inverse = stage.camera.matrixWorldInverse;
    const ends = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((a, k) => ({ v: new THREE.Vector3(...a).transformDirection(inverse), k }));
    ends.sort((a, b) => a.v.z - b.v.z);
    const ink = ['#d55e00', '#009e73', '#0072b2'];
    $('axes').innerHTML = ends.map(({ v, k }) => {
      const x = 26 * v.x, y = -26 * v.y, bold = 0.55 + 0.45 * (v.z + 1) / 2;
      return `<g opacity="${bold}"><line x2="${x}" y2="${y}" stroke="${ink[k]}" stroke-width="2.5" stroke-linecap="round"/>` +
        `<text x="${1.38 * x}" y="${1.38 * y}" fill="${ink[k]}" text-anchor="middle" dominant-baseline="central">${'xyz'[k]}</text></g>`;
    }).join('');
  }

  // --- settings ---
  /** What there is to set: it grows while a run goes on. */
  shape() { return JSON.stringify([kParts.map((part) => this.choices[part].map((c) => c.key)), this.run.frames.at(-1)?.planes?.length ?? 0]); }

  panel() {
    const panel = $('panel');
    this.panelShape = this.shape();
    panel.replaceChildren(el('button', { id: 'close-panel', title: 'Hide settings (h)', ariaLabel: 'Hide settings', onclick: () => this.togglePanel(true) }, '✕'));
    this.sections = {};
    const last = this.run.frames.at(-1);
    const present = { grains: this.run.frames.some((f) => f.grains), membranes: this.run.frames.some((f) => f.nodes), contacts: this.run.frames.some((f) => f.contacts) };
    for (const part of kParts) if (present[part]) panel.append(this.partSection(part));
    if (last.planes?.length) panel.append(this.section('planes', 'Planes', String(last.planes.length), []));
    panel.append(this.sliceSection(), this.pickSection(), this.toolSection());
  }

  section(key, title, count, content) {
    const settings = this.view.settings[key];
    const box = el('input', { type: 'checkbox', checked: settings.shown ?? settings.on, onchange: () => {
      if (key === 'slice') { settings.on = box.checked; this.startSlice(); } else settings.shown = box.checked;
      section.classList.toggle('off', !box.checked);
      if (key === 'contacts' && box.checked && this.view.settings.grains.opacity === 1 && !this.seenContacts) {
        // Contacts are inside of solid grains.
        this.seenContacts = true;
        this.view.settings.grains.opacity = 0.06;
        if (this.sections.opacity) this.sections.opacity.value = 0.06;
      }
      this.reload();
    } });
    const small = el('small', {}, count);
    const section = el('section', { className: box.checked ? '' : 'off' }, el('h3', {}, el('label', { style: 'display:flex;gap:7px;align-items:center' }, box, title), small), ...content);
    this.sections[key] = { section, box, small };
    return section;
  }

  partSection(part) {
    const c = this.colours[part], settings = this.view.settings[part];
    const field = el('select', { ariaLabel: 'Colour by', onchange: () => { c.key = field.value; c.lo = c.hi = null; lo.value = hi.value = ''; showUnit(); this.reload(); } },
      el('option', { value: '', selected: c.key === '' }, 'one colour'),
      ...this.choices[part].map((choice) => el('option', { value: choice.key, title: choice.what, selected: c.key === choice.key }, choice.label)));
    const map = el('select', { ariaLabel: 'Colour map', onchange: () => { c.map = map.value; c.byHand = true; this.reload(); } },
      ...Object.keys(kMaps).map((name) => el('option', { selected: name === c.map }, name)));
    const mode = el('select', { ariaLabel: 'Scale', onchange: () => { c.mode = mode.value; this.reload(); } }, el('option', {}, 'linear'), el('option', {}, 'log'));
    const range = el('select', { ariaLabel: 'Range', onchange: () => { c.range = range.value; c.lo = c.hi = null; lo.value = hi.value = ''; this.reload(); } },
      el('option', { value: 'run', title: 'Without the outermost 1 % of each frame; of forces without short peaks' }, 'most of the run'), el('option', { value: 'extremes' }, 'all of the run'), el('option', { value: 'frame', selected: c.range === 'frame' }, 'this frame'));
    const typed = () => {
      const parse = (input) => (input.value.trim() === '' ? null : Number(input.value.replace(',', '.')));
      c.lo = parse(lo); c.hi = parse(hi);
      if (Number.isNaN(c.lo) || Number.isNaN(c.hi)) { c.lo = c.hi = null; }
      else if (c.lo === null && c.hi !== null) c.lo = 0;
      this.reload();
    };
    const lo = el('input', { type: 'text', inputMode: 'decimal', onchange: typed }), hi = el('input', { type: 'text', inputMode: 'decimal', onchange: typed });
    const showUnit = () => { const u = this.choice(part)?.unit; lo.placeholder = 'from' + (u ? `, ${u}` : ''); hi.placeholder = 'to' + (u ? `, ${u}` : ''); };
    showUnit();
    const content = [row('colour', field), row('map', el('div', { className: 'pair' }, map, mode)), row('range', range), row('', el('div', { className: 'pair' }, lo, hi))];
    if (part !== 'contacts') {
      const opacity = el('input', { type: 'range', min: 0, max: 1, step: 0.01, value: settings.opacity, ariaLabel: 'Opacity', oninput: () => {
        settings.opacity = Number(opacity.value) > 0.97 ? 1 : Number(opacity.value); this.view.build(); this.legends();
      } });
      if (part === 'grains') this.sections.opacity = opacity;
      content.push(row('opacity', opacity));
    } else {
      const thick = el('input', { type: 'range', min: -1, max: 1, step: 0.02, value: Math.log10(settings.thickness), ariaLabel: 'Thickness of lines', oninput: () => {
        settings.thickness = 10 ** Number(thick.value); this.view.build();
      } });
      content.push(row('thickness', thick), el('div', { className: 'hint' }, 'Lines join the centres of grains. They are as thick as the normal force is large.'));
    }
    if (part === 'membranes') content.push(row('mesh lines', el('input', { type: 'checkbox', checked: settings.mesh, style: 'justify-self:start', onchange: (e) => { settings.mesh = e.target.checked; this.view.build(); } })));
    const section = this.section(part, kTitles[part], '', content);
    this.sections[part].map = map;
    map.value = this.mapOf(part);
    return section;
  }

  counts() {
    const frame = this.run.frames[this.frame];
    const number = (n) => n.toLocaleString('en').replaceAll(',', ' ');
    const set = (part, text) => { if (this.sections?.[part]) this.sections[part].small.textContent = text; };
    if (frame.grains !== undefined) set('grains', number(frame.grains));
    if (frame.nodes !== undefined) set('membranes', frame.facets ? `${number(frame.facets)} facets` : `${number(frame.edges)} wires`);
    if (frame.contacts !== undefined) set('contacts', number(frame.contacts));
  }

  sliceSection() {
    const s = this.view.settings.slice;
    const apply = () => { this.stage.change(); this.showSlice(); };
    const axis = el('select', { ariaLabel: 'Axis of the slice', onchange: () => { s.axis = Number(axis.value); this.startSlice(true); apply(); } },
      ...['x', 'y', 'z'].map((a, k) => el('option', { value: k, selected: k === s.axis }, 'across ' + a)));
    const side = el('button', { onclick: () => { s.turned = !s.turned; apply(); } }, 'flip');
    this.sliceInput = el('input', { type: 'range', min: 0, max: 1, step: 0.001, value: 0.5, ariaLabel: 'Place of the slice', oninput: () => {
      const box = this.view.homeBox, k = s.axis;
      s.at = box.min.getComponent(k) + Number(this.sliceInput.value) * (box.max.getComponent(k) - box.min.getComponent(k));
      apply();
    } });
    return this.section('slice', 'Slice', '', [row('plane', el('div', { className: 'pair' }, axis, side)), row('at', this.sliceInput)]);
  }

  startSlice(anew) {
    const s = this.view.settings.slice, box = this.view.homeBox;
    if (anew || !this.sliced) s.at = (box.min.getComponent(s.axis) + box.max.getComponent(s.axis)) / 2;
    this.sliced = true;
    // The side that is kept is the one behind, so that the cut is seen.
    if (anew || this.sideChosen === undefined) s.turned = this.stage.camera.position.getComponent(s.axis) < this.stage.controls.target.getComponent(s.axis);
    this.sideChosen = true;
    if (this.sliceInput) this.sliceInput.value = (s.at - box.min.getComponent(s.axis)) / (box.max.getComponent(s.axis) - box.min.getComponent(s.axis) || 1);
    this.showSlice();
  }

  showSlice() {
    const s = this.view.settings.slice;
    this.sections.slice.small.textContent = s.on ? `${'xyz'[s.axis]} = ${withUnit(Math.abs(s.at) < 1e-4 * this.stage.reach ? 0 : s.at, 'm')}` : '';
  }

  toolSection() {
    const button = (text, title, act) => el('button', { title, onclick: act }, text);
    return el('section', {}, el('div', { className: 'tools' },
      button('Whole scene', 'Key 0', () => this.home()), button('Parallel', 'Key p', () => this.parallel()),
      button('Dark', 'Key d', () => this.dark()), button('Picture', 'Key s: save as PNG', () => this.save()), button('Keys', 'Key ?', () => this.help())));
  }

  // --- picked element ---
  pickSection() {
    this.picked = el('section', {}, el('h3', {}, 'Picked element'), el('div', { className: 'hint' }, 'Click an element of the scene.'));
    return this.picked;
  }

  async pickAt(x, y) {
    const ray = this.stage.rayAt(x, y);
    // Who misses a thin wire by some pixels meant it all the same.
    const hit = this.view.pick(ray) ?? this.view.pick(ray, 6 * this.stage.pixelLength);
    await this.view.select(hit);
    this.chosen.element = null;
    await this.showPicked();
    if (!hit && this.chosen.wasElement) this.choosePlot();
    // On a narrow screen the numbers would be beside it.
    if (hit && isNarrow()) { this.togglePanel(false); this.picked.scrollIntoView(); }
  }

  async followSelected() {
    const { selected } = this.view;
    if (!selected) return;
    selected.here = await this.view.find(this.frame);
    this.view.fillPicked();
    this.stage.change();
    await this.showPicked();
  }

  describe(selected) {
    const n = selected.numbers;
    const kinds = ['grain', 'node of structure', 'edge of structure', 'facet of structure', 'plane'];
    if (selected.on === 'grains') return `Grain ${n[0]}`;
    if (selected.on === 'edges') return `Edge between nodes ${n[0]} and ${n[1]}`;
    if (selected.on === 'facets') return `Facet of nodes ${n.join(', ')}`;
    return `Contact of ${kinds[n[0]]} ${n[1]} and ${kinds[n[2]]} ${n[3]}`;
  }

  async showPicked() {
    const { selected } = this.view;
    const content = [el('h3', {}, 'Picked element')];
    if (!selected) {
      this.picked.replaceChildren(...content, el('div', { className: 'hint' }, 'Click an element of the scene.'));
      return;
    }
    const here = selected.here ?? selected.index;
    content.push(el('div', { style: 'margin-bottom:5px' }, this.describe(selected)));
    if (here < 0) content.push(el('div', { className: 'hint' }, 'It is not there at this time.'));
    else content.push(await this.numbersOf(selected, here), el('div', { className: 'hint' }, 'Click a row for its history.'));
    this.picked.replaceChildren(...content);
  }

  async numbersOf(selected, index) {
    const table = el('table', { className: 'numbers' });
    const add = (name, text, can, key) => table.append(el('tr', { className: (can ? 'can' : '') + (key && this.chosen.element === key ? ' is' : ''), onclick: can ? () => this.elementHistory(key) : () => {} },
      el('td', {}, name), el('td', {}, text)));
    for (const record of await this.run.records(this.frame, selected.part)) {
      const isPosition = record.name === 'position';
      if (record.on !== selected.on || record.name === 'nodes' || /^(kind|body)_/.test(record.name)) continue;
      const values = await this.run.values(record), c = record.components;
      const own = values.slice(c * index, c * index + c);
      const field = this.run.field(selected.part, record.name, record.on);
      const unit = isPosition ? 'm' : field?.unit ?? '';
      const label = record.name.replaceAll('_', ' ').replace(' magnitude', '');
      if (record.name === 'id') continue;
      if (field?.whole) {
        add(label, this.names(record.name)?.[own[0]] || (record.name.startsWith('is_') ? ['no', 'yes'][own[0]] : String(own[0])), false);
      } else if (c === 3) {
        const most = Math.max(...own.map(Math.abs)), [factor, u] = shortUnit(most, unit);
        if (!isPosition) add(label, withUnit(Math.hypot(...own), unit), true, record.name);
        add(isPosition ? label : '', own.length ? [...own].map((v) => short(v / factor, isPosition ? 4 : 3)).join('  ') + ' ' + u : '', isPosition, isPosition ? 'position' : undefined);
      } else add(label, withUnit(own[0], unit), true, record.name);
    }
    return table;
  }

  /** What the picked element had in every frame, in the plot. */
  async elementHistory(key) {
    const { selected } = this.view;
    this.chosen.element = key;
    this.chosen.wasElement = true;
    const times = [], rows = [];
    const field = this.run.field(selected.part, key, selected.on);
    for (let k = 0; k < this.run.frames.length; k++) {
      const index = await this.view.find(k, selected);
      const values = index < 0 ? null : await this.run.array(k, selected.part, selected.on, key);
      times.push(this.run.frames[k].time);
      if (!values) { rows.push(null); continue; }
      const c = key === 'position' ? 3 : field?.components ?? 1;
      rows.push([...values.slice(c * index, c * index + c)]);
    }
    if (this.view.selected !== selected) return;
    const unit = key === 'position' ? 'm' : field?.unit ?? '', label = key.replaceAll('_', ' ').replace(' magnitude', '');
    const size = rows.find((r) => r)?.length ?? 1;
    const series = size === 3 ? ['x', 'y', 'z'].map((a, c) => ({ name: `${label} ${a}`, unit, values: rows.map((r) => r?.[c] ?? NaN) })) : [{ name: label, unit, values: rows.map((r) => r?.[0] ?? NaN) }];
    if (size === 3 && key !== 'position') series.unshift({ name: label, unit, values: rows.map((r) => (r ? Math.hypot(...r) : NaN)) });
    this.plotBar([el('div', { style: 'font-weight:600' }, this.describe(selected)), el('div', { className: 'hint' }, `${label}, one value for each frame`)]);
    this.histories.draw(times, series, this.chosen.logarithmic);
    this.histories.setTime(this.run.frames[this.frame].time);
    await this.showPicked();
  }

  // --- histories ---
  async loadHistories() {
    this.files = await this.run.histories();
    if (!this.files.length) {
      $('plot-bar').replaceChildren(el('div', { className: 'hint' }, 'The run has no histories. Pick an element and click one of its numbers.'));
      return;
    }
    if (!this.chosen.file) this.chooseFile(this.files[0].file);
    this.choosePlot();
  }

  chooseFile(file) {
    this.chosen.file = file;
    const { columns } = this.files.find((f) => f.file === file);
    const names = columns.slice(1).map((c) => c.name);
    const wanted = file === 'energy.csv' ? ['kinetic', 'bond_elastic', 'sheet_elastic', 'contact_elastic'] : names.filter((n) => /force_z|force$|pressure/.test(n)).slice(0, 3);
    const has = (name) => columns.find((c) => c.name === name)?.values.some((v) => v !== 0);
    this.chosen.columns = new Set(wanted.filter(has));
    if (!this.chosen.columns.size && names.length) this.chosen.columns.add(names[0]);
  }

  plotBar(content) {
    const file = el('select', { ariaLabel: 'File of histories', onchange: () => { if (!file.value) return; this.chooseFile(file.value); this.choosePlot(); } },
      ...(this.chosen.element ? [el('option', { value: '', selected: true }, 'picked element')] : []),
      ...(this.files ?? []).map((f) => el('option', { value: f.file, selected: !this.chosen.element && f.file === this.chosen.file }, f.file)));
    const log = el('label', {}, el('input', { type: 'checkbox', checked: this.chosen.logarithmic, onchange: (e) => {
      this.chosen.logarithmic = e.target.checked;
      if (this.chosen.element) this.elementHistory(this.chosen.element); else this.choosePlot();
    } }), 'logarithmic');
    const at = $('plot-bar').scrollTop;
    $('plot-bar').replaceChildren(file, ...content, log);
    $('plot-bar').scrollTop = at;
  }

  choosePlot() {
    this.chosen.element = null;
    this.chosen.wasElement = false;
    const found = this.files?.find((f) => f.file === this.chosen.file);
    if (!found) return;
    const [time, ...columns] = found.columns;
    this.plotBar(columns.map((c) => el('label', {}, el('input', { type: 'checkbox', checked: this.chosen.columns.has(c.name), onchange: (e) => {
      if (e.target.checked) this.chosen.columns.add(c.name); else this.chosen.columns.delete(c.name);
      this.choosePlot();
    } }), c.name.replaceAll('_', ' '), el('small', {}, c.unit))));
    this.histories.draw(time.values, columns.filter((c) => this.chosen.columns.has(c.name)).map((c) => ({ ...c, name: c.name.replaceAll('_', ' ') })), this.chosen.logarithmic);
    this.histories.setTime(this.run.frames[this.frame]?.time ?? 0);
  }

  // --- tools ---
  async home() { await this.view.home(); this.view.fillPlanes(); this.stage.change(); }
  parallel() { this.stage.setParallel(this.stage.camera === this.stage.perspective); this.stage.change(); }
  dark(on = !document.documentElement.classList.contains('dark')) {
    document.documentElement.classList.toggle('dark', on);
    this.view.dark = on;
    if (on) this.stage.setSky([0.17, 0.185, 0.205], [0.075, 0.082, 0.092]);
    else this.stage.setSky();
    this.view.fillPlanes();
    if (this.chosen.element) this.elementHistory(this.chosen.element); else this.choosePlot();
  }
  save() {
    this.stage.finish();
    const link = el('a', { download: `${this.run.header.title}-${String(this.frame).padStart(5, '0')}.png`, href: $('canvas').toDataURL('image/png') });
    link.click();
  }
  help() {
    const keys = [['space', 'play and pause'], ['← →', 'frame before, next frame; with shift ten'], ['Home End', 'first and last frame'], ['0', 'whole scene'],
      ['1 2 3', 'along x, y, z; with shift from the other side'], ['+ −', 'nearer, farther'], ['w a s d', ''], ['p', 'parallel view or perspective'], ['c', 'contacts'], ['x', 'slice'],
      ['d', 'dark or light'], ['s', 'save the picture'], ['g', 'histories'], ['h', 'settings'], ['Esc', 'pick nothing']].filter(([, what]) => what);
    $('help').replaceChildren(el('h2', {}, 'Keys, mouse and touch'), el('table', {}, ...keys.map(([key, what]) => el('tr', {}, el('td', {}, el('kbd', {}, key)), el('td', {}, what)))),
      el('p', {}, 'Drag turns, the wheel zooms to the pointer, the right button shifts; click picks an element. One finger turns, two zoom and shift, a tap picks.'),
      el('p', { className: 'hint' }, this.precision()), el('button', { onclick: () => $('help').close() }, 'Close'));
    $('help').showModal();
  }

  precision() { return 'Positions are kept to 1/65536 of the box around a frame, or of an earlier one at most twice as wide, values to 1/500, radii and histories to 7 digits. Vectors other than velocities of grains are kept as magnitudes.'; }

  look(direction) {
    this.stage.frame(this.view.homeBox, direction, this.view.places);
  }

  keys(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const tag = event.target.tagName;
    if ((tag === 'SELECT' || (tag === 'INPUT' && event.target.type !== 'checkbox' && event.target !== $('slider'))) && event.key !== 'Escape') return;
    const s = event.shiftKey, axis = (k) => { const v = new THREE.Vector3(k === 2 ? 0 : 0, 0, 0); v.setComponent(k, s ? -1 : 1); if (k === 2) v.y = -1e-3; this.look(v); };
    const zoom = (f) => {
      if (this.stage.camera === this.stage.orthographic) this.stage.orthographic.zoom /= f;
      else this.stage.camera.position.sub(this.stage.controls.target).multiplyScalar(f).add(this.stage.controls.target);
      this.stage.controls.update(); this.stage.change();
    };
    const acts = {
      ' ': () => { if (tag !== 'BUTTON') this.play(); }, ArrowRight: () => this.goTo(this.frame + (s ? 10 : 1)), ArrowLeft: () => this.goTo(this.frame - (s ? 10 : 1)),
      Home: () => this.goTo(0), End: () => this.goTo(Infinity), 0: () => this.home(), p: () => this.parallel(), d: () => this.dark(), s: () => this.save(),
      g: () => this.togglePlot(), h: () => this.togglePanel(), c: () => this.sections.contacts?.box.click(), x: () => this.sections.slice?.box.click(),
      '?': () => this.help(), '+': () => zoom(0.85), '=': () => zoom(0.85), '-': () => zoom(1 / 0.85), Escape: () => this.view.select(null).then(() => this.showPicked()),
    };
    const act = event.code === 'Digit1' ? () => axis(0) : event.code === 'Digit2' ? () => axis(1) : event.code === 'Digit3' ? () => axis(2) : acts[event.key] ?? acts[event.key.toLowerCase()];
    if (!act) return;
    if (event.key !== ' ' || tag !== 'BUTTON') event.preventDefault();
    act();
  }

  togglePanel(hidden) { document.querySelector('main').classList.toggle('no-panel', hidden); }
  togglePlot() { document.querySelector('footer').classList.toggle('no-plot'); $('toggle-plot').textContent = document.querySelector('footer').classList.contains('no-plot') ? '⌃' : '⌄'; }

  describeRun() {
    const { header } = this.run, { run } = header;
    document.title = `${header.title} – Plekton`;
    $('title').textContent = header.title;
    const states = { finished: 'finished', at_rest: 'came to rest', interrupted: 'interrupted', failed: 'failed' };
    const parts = run ? [states[run.status] ?? run.status, `${short(run.timing?.simulated_time_s ?? 0)} s in ${Number(run.timing?.steps ?? 0).toLocaleString('en').replaceAll(',', ' ')} steps`, `Plekton ${run.plekton}`, String(run.date ?? '').replace('T', ' ').replace(/:\d\dZ$/, ' UTC')].filter(Boolean)
      : [this.run.live ? 'running' : 'not ended'];
    $('subtitle').textContent = parts.join(' · ');
    $('notes').replaceChildren(...[...(header.notes ?? []), ...this.notes].map((note) => el('div', {}, note)));
    $('slider').max = this.run.frames.length - 1;
  }

  wire() {
    $('slider').addEventListener('input', () => { this.play(false); this.goTo(Number($('slider').value)); });
    $('play').addEventListener('click', () => this.play());
    $('back').addEventListener('click', () => this.goTo(this.frame - 1));
    $('next').addEventListener('click', () => this.goTo(this.frame + 1));
    $('toggle-plot').addEventListener('click', () => this.togglePlot());
    $('open-panel').addEventListener('click', () => this.togglePanel());
    window.addEventListener('keydown', (event) => this.keys(event));
    const canvas = $('canvas');
    let down = null;
    canvas.addEventListener('pointerdown', (e) => { down = { x: e.clientX, y: e.clientY, at: e.timeStamp, many: !e.isPrimary }; canvas.focus({ preventScroll: true }); });
    canvas.addEventListener('pointerup', (e) => {
      if (down && !down.many && e.button === 0 && Math.hypot(e.clientX - down.x, e.clientY - down.y) < 5 && e.timeStamp - down.at < 500) this.pickAt(e.clientX, e.clientY);
      down = null;
    });
    canvas.addEventListener('webglcontextlost', () => { $('message').textContent = 'The graphics card was lost; open the page again.'; });
  }

  /** In another list of frames, where some were left out or the run was begun anew, what is shown is what is nearest to a time. */
  changeList(time) {
    this.view.asked++;   // what is still being read was asked for of the list before
    this.frame = this.view.frame = this.frameAt(time);
  }

  /** Follows a running simulation. */
  async follow() {
    try {
      const atEnd = this.frame >= this.run.frames.length - 1, { time } = this.run.frames[this.frame], { generation } = this.run.header;
      if (await this.run.refresh()) {
        const isOther = this.run.header.generation !== generation;
        if (isOther) this.changeList(time);
        this.choices = Object.fromEntries(kParts.map((part) => [part, choicesOf(this.run.header, part)]));
        this.describeRun();
        for (const part of kParts) if (!this.colours[part].key) this.colours[part].key = this.firstKey(part);
        if (this.shape() !== this.panelShape) this.panel();
        this.applyColours();
        this.legends();
        if (atEnd || isOther) await this.goTo(atEnd ? Infinity : this.frame);
        if (!this.chosen.element) await this.loadHistories();
      }
      $('message').textContent = '';
    } catch (error) {
      $('message').textContent = 'plekton view --serve does not answer; waiting for it';
    }
    setTimeout(() => this.follow(), 2000);
  }
}

/**
 * A range in which most of a run is told apart. Forces have peaks at impacts, beside which all that comes to rest
 * would have one colour; velocities are looked at where they are large.
 */
function usualRange({ field, usual, typical }) {
  if (/velocity/.test(field)) return usual;
  return [Math.max(usual[0], 2.5 * Math.min(typical[0], 0)), Math.min(usual[1], 2.5 * Math.max(typical[1], 0) || usual[1])];
}

/** Whether the settings lie on the scene instead of beside it. */
const isNarrow = () => window.matchMedia('(max-width: 760px)').matches;
const isParallel = (stage) => stage.camera === stage.orthographic;

/** What settings in the address are to be, and whether a text is that. */
function kindsOfSettings(page) {
  const isNumber = (text) => text.trim() !== '' && Number.isFinite(Number(text));
  const areNumbers = (text, count) => text.split(',').length === count && text.split(',').every(isNumber);
  const share = ['a number from 0 to 1', (text) => isNumber(text) && Number(text) >= 0 && Number(text) <= 1];
  const fields = (part) => page.choices[part].map((c) => c.key);
  return {
    frame: ['a number or last', (text) => text === 'last' || isNumber(text)],
    slice: ['x, y or z', (text) => ['', 'x', 'y', 'z'].includes(text)],
    look: ['a direction, three numbers', (text) => areNumbers(text, 3) && text.split(',').some(Number)],
    zoom: ['a number above 0', (text) => isNumber(text) && Number(text) > 0],
    pick: ['two numbers', (text) => areNumbers(text, 2)],
    log: [`some of ${kParts.join(', ')}`, (text) => text.split(',').every((part) => kParts.includes(part))],
    grains: share,
    membranes: share,
    ...Object.fromEntries(kParts.map((part) => [part + '-by', [`one of ${fields(part).join(', ')}`, (text) => fields(part).includes(text)]])),
  };
}

/** Settings of the address without those that are not what they are to be; these are told in the notes. */
function settingsOfAddress(page) {
  const options = new URLSearchParams(location.hash.slice(1));
  for (const [key, [expected, isRight]] of Object.entries(kindsOfSettings(page))) {
    const text = options.get(key);
    if (text === null || isRight(text)) continue;
    page.notes.push(`The address says ${key}=${text}, expected ${expected}; left out.`);
    options.delete(key);
  }
  return options;
}

/** Settings after # in the address, as in #frame=12&contacts&slice=x: a picture can be told by its address. */
async function applyAddress(page) {
  const options = settingsOfAddress(page);
  if (page.notes.length) page.describeRun();
  const flag = (key) => options.has(key) && options.get(key) !== '0';
  if (flag('dark')) page.dark(true);
  if (flag('parallel')) page.parallel();
  for (const part of kParts) if (options.has(part + '-by')) page.colours[part].key = options.get(part + '-by');
  if (options.has('grains')) page.view.settings.grains.opacity = Number(options.get('grains'));
  if (options.has('membranes')) page.view.settings.membranes.opacity = Number(options.get('membranes'));
  if (flag('contacts')) { page.view.settings.contacts.shown = true; if (!options.has('grains')) page.view.settings.grains.opacity = 0.06; }
  if (options.has('log')) for (const part of options.get('log').split(',')) page.colours[part].mode = 'log';
  if (options.has('slice')) { const s = page.view.settings.slice; s.on = true; s.axis = Math.max('xyz'.indexOf(options.get('slice')), 0); }
  if (options.has('look')) page.look(new THREE.Vector3(...options.get('look').split(',').map(Number)));
  if (options.has('zoom')) {
    page.stage.camera.position.sub(page.stage.controls.target).divideScalar(Number(options.get('zoom'))).add(page.stage.controls.target);
    page.stage.controls.update();
    page.stage.framed = null;
  }
  if (flag('no-panel')) page.togglePanel(true);
  page.panel();
  if (options.has('slice')) page.startSlice();
  await page.reload();
  const frame = options.get('frame');
  await page.goTo(frame === null ? (page.run.live ? Infinity : 0) : frame === 'last' ? Infinity : Number(frame));
  page.legends();
  const pick = options.get('pick');
  // A window without a screen gets its size late.
  if (pick) await new Promise((done) => setTimeout(done, 300));
  if (pick) { const [x, y] = pick.split(',').map(Number); page.stage.fitCamera(); await page.pickAt(x, y); if (options.has('history') && page.view.selected) await page.elementHistory(options.get('history')); }
  return options;
}

async function main() {
  const say = (text) => { $('message').textContent = text; };
  let run, stage;
  window.plektonSelfCheck = async () => {
    const result = await selfCheck(run, stage);
    $('self-check').textContent = JSON.stringify(result);
    return result;
  };
  try {
    run = await Run.open();
    while (run.live && !run.frames.length) { say('no frame yet; waiting for the first'); await new Promise((done) => setTimeout(done, 1000)); await run.refresh(); }
    try {
      stage = new Stage($('canvas'));
    } catch (error) {
      throw new Error('this browser has no WebGL 2, which draws the scene; switch on hardware acceleration or use another browser');
    }
    if (isNarrow()) document.querySelector('main').classList.add('no-panel');
    const page = new Page(run, stage);
    window.plekton = page;
    page.describeRun();
    page.wire();
    page.applyColours();
    page.panel();
    stage.resize();   // now that there is what is beside the scene
    await page.view.show(0);
    await page.home();
    await page.loadHistories();
    const options = await applyAddress(page);
    say('');
    if (options.has('self-check')) say(verdictOf(await window.plektonSelfCheck()));
    if (run.live) page.follow();
    document.documentElement.dataset.ready = 'yes';
  } catch (error) {
    console.error(error);
    say('The run cannot be shown: ' + error.message);
    $('self-check').textContent = JSON.stringify({ ok: false, problems: [String(error)] });
  }
}
main();
