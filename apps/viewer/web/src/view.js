// SPDX-License-Identifier: GPL-3.0-or-later
// A frame of a run as shapes: which values colour what, where contacts are drawn, what is picked.
import * as THREE from 'three';
import { Paint, Plane, capsules, facets, shared, spheres } from './layers.js';
import { ticks } from './colour.js';
import { throughBall, throughCapsule, throughTriangle } from './pick.js';

const kAxes = ['x', 'y', 'z'];

/** What a layer can be coloured by: [{key, name, unit, ...}]; of a vector its magnitude and its components. */
export function choicesOf(header, part) {
  const kHidden = new Set(['id', 'node', 'kind_a', 'kind_b', 'body_a', 'body_b']);
  const choices = [];
  const seen = new Set();
  for (const f of header.fields[part] ?? []) {
    if (kHidden.has(f.name) || seen.has(f.name)) continue;
    seen.add(f.name);
    const label = f.name.replaceAll('_', ' ').replace(' magnitude', '');
    const base = { field: f.name, unit: f.unit, what: f.what, whole: f.whole };
    choices.push({ ...base, key: f.name, label, axis: -1, range: f.range, usual: f.usual, typical: f.typical });
    if (f.components === 3)
      kAxes.forEach((a, axis) => choices.push({ ...base, key: f.name + '.' + a, label: label + ' ' + a, axis,
        range: [-f.range[1], f.range[1]], usual: [-f.usual[1], f.usual[1]], typical: [-f.typical[1], f.typical[1]] }));
  }
  return choices;
}

/** Numbers of an array: themselves, the magnitude of vectors, or one of their components. */
export function scalars(values, components, axis) {
  if (components === 1) return values;
  const out = new Float32Array(values.length / components);
  for (let i = 0; i < out.length; i++)
    out[i] = axis >= 0 ? values[components * i + axis] : Math.hypot(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return out;
}

/** Pairs of nodes, the lower one first, as one number. */
const sideKey = (a, b) => (a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);

/** Sides of facets that are no edge of the structure, and the sides of every facet. */
function sidesOf(edges, triangles) {
  const numbers = new Map();
  for (let i = 0; i < edges.length; i += 2) numbers.set(sideKey(edges[i], edges[i + 1]), i / 2);
  const extra = [];
  const ofFacet = new Int32Array(triangles.length);
  for (let i = 0; i < triangles.length; i++) {
    const a = triangles[i], b = triangles[i % 3 === 2 ? i - 2 : i + 1], key = sideKey(a, b);
    let side = numbers.get(key);
    if (side === undefined) {
      side = edges.length / 2 + extra.length / 2;
      numbers.set(key, side);
      extra.push(a, b);
    }
    ofFacet[i] = side;
  }
  return { extra: Int32Array.from(extra), ofFacet };
}

function triangleNormals(x, triangles) {
  const normals = new Float32Array(triangles.length);
  for (let i = 0; i < triangles.length; i += 3) {
    const a = 3 * triangles[i], b = 3 * triangles[i + 1], c = 3 * triangles[i + 2];
    const u = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]], v = [x[c] - x[a], x[c + 1] - x[a + 1], x[c + 2] - x[a + 2]];
    normals[i] = u[1] * v[2] - u[2] * v[1];
    normals[i + 1] = u[2] * v[0] - u[0] * v[2];
    normals[i + 2] = u[0] * v[1] - u[1] * v[0];
  }
  return normals;
}

/** Of each corner of each triangle: of the surface around it, or of the triangle where that is folded more than 35 degrees. */
function cornerNormals(x, triangles) {
  const flat = triangleNormals(x, triangles);   // twice the area long
  const around = new Float32Array(x.length);
  for (let i = 0; i < triangles.length; i++)
    for (let k = 0; k < 3; k++) around[3 * triangles[i] + k] += flat[3 * Math.floor(i / 3) + k];
  const normals = new Float32Array(3 * triangles.length);
  for (let i = 0; i < triangles.length; i++) {
    const f = 3 * Math.floor(i / 3), n = 3 * triangles[i];
    const fl = Math.hypot(flat[f], flat[f + 1], flat[f + 2]) || 1, al = Math.hypot(around[n], around[n + 1], around[n + 2]) || 1;
    const agree = (flat[f] * around[n] + flat[f + 1] * around[n + 1] + flat[f + 2] * around[n + 2]) / (fl * al);
    for (let k = 0; k < 3; k++) normals[3 * i + k] = agree > 0.82 ? around[n + k] / al : flat[f + k] / fl;
  }
  return normals;
}

/** Some thousand of the places of a frame that are in a box, with their radii, for a camera to see. */
function placesIn(box, { x, r, nodes }) {
  const places = [];
  const add = (of, radius) => {
    const step = 3 * Math.ceil(of.length / 3 / 3000);
    for (let i = 0; i < of.length; i += step)
      if (box.containsPoint(new THREE.Vector3(of[i], of[i + 1], of[i + 2]))) places.push([of[i], of[i + 1], of[i + 2], radius(i / 3)]);
  };
  if (nodes) add(nodes, () => 0);
  if (x) add(x, (i) => r[i]);
  return places;
}

export class View {
  constructor(run, stage) {
    this.run = run;
    this.stage = stage;
    this.paint = { grains: new Paint([0.70, 0.66, 0.60]), membranes: new Paint([0.45, 0.58, 0.68]), contacts: new Paint([0.15, 0.15, 0.17]), picked: new Paint([1, 0.45, 0]) };
    this.shapes = {
      grains: spheres(this.paint.grains), edges: capsules(this.paint.membranes), facets: facets(this.paint.membranes),
      contacts: capsules(this.paint.contacts), ball: spheres(this.paint.picked), bar: capsules(this.paint.picked),
    };
    for (const [order, shape] of Object.values(this.shapes).entries()) {
      shape.mesh.renderOrder = shape === this.shapes.grains ? 10 : order;
      stage.scene.add(shape.mesh);
    }
    this.planes = [];
    this.settings = {
      grains: { shown: true, opacity: 1, field: null }, membranes: { shown: true, field: null, mesh: true, opacity: 1 },
      contacts: { shown: false, field: null, thickness: 1 }, planes: { shown: true },
      slice: { on: false, axis: 0, at: 0, turned: false },
    };
    this.frame = 0;
    this.data = {};
    this.selected = null;
    this.asked = 0;
  }

  async load(k) {
    const get = (part, on, name) => this.run.array(k, part, on, name);
    const [x, r, nodes, edges, triangles, edgeRadius, facetRadius] = await Promise.all([
      get('grains', 'grains', 'position'), get('grains', 'grains', 'radius'), get('membranes', 'nodes', 'position'),
      get('membranes', 'edges', 'nodes'), get('membranes', 'facets', 'nodes'), get('membranes', 'edges', 'radius'), get('membranes', 'facets', 'radius')]);
    const data = { k, x, r, nodes, edges: edges ?? new Int32Array(0), triangles: triangles ?? new Int32Array(0), edgeRadius, facetRadius };
    const { grains, membranes, contacts } = this.settings;
    if (x && grains.field) data.grainValues = await this.valuesOf(k, 'grains', 'grains', grains.field);
    if (nodes && membranes.field) data.membraneValues = await this.membraneValues(k, data, membranes.field);
    if (contacts.shown && this.run.frames[k].contacts) {
      const [kindA, kindB, bodyA, bodyB, places, force, gap] = await Promise.all(['kind_a', 'kind_b', 'body_a', 'body_b', 'point', 'normal_force_magnitude', 'gap']
        .map((name) => get('contacts', name === 'point' ? 'places' : 'contacts', name)));
      data.contacts = { kindA, kindB, bodyA, bodyB, places, force, gap };
      data.grainNumbers = await get('grains', 'grains', 'id');
      if (contacts.field) data.contactValues = await this.valuesOf(k, 'contacts', 'contacts', contacts.field);
    }
    return data;
  }

  async valuesOf(k, part, on, choice) {
    const field = this.run.field(part, choice.field, on);
    const values = field && await this.run.array(k, part, on, choice.field);
    return values ? scalars(values, field.components, choice.axis) : null;
  }

  /** Values of the structure wherever the field lives: {nodes} or {edges, facets}. */
  async membraneValues(k, data, choice) {
    const nodes = await this.valuesOf(k, 'membranes', 'nodes', choice);
    if (nodes) return { nodes };
    let edges = await this.valuesOf(k, 'membranes', 'edges', choice), faces = await this.valuesOf(k, 'membranes', 'facets', choice);
    return { edges, facets: faces };
  }

  /** Shows a frame. Where another is asked for before this one is read, this one is not shown. */
  async show(k) {
    const asked = ++this.asked;
    const data = await this.load(k);
    if (asked !== this.asked) return false;
    this.frame = k;
    this.data = data;
    this.build();
    return true;
  }

  build() {
    this.fillGrains();
    this.fillMembranes();
    this.fillContacts();
    this.fillPlanes();
    this.fillPicked();
    this.stage.elements = Object.values(this.shapes).reduce((sum, shape) => sum + shape.geometry.instanceCount, 0);
    this.stage.change();
  }

  fillGrains() {
    const { x, r, grainValues } = this.data, { shown, opacity } = this.settings.grains;
    const count = shown && opacity > 0 && x ? r.length : 0;
    const { sphere, value } = this.shapes.grains.begin(count);
    for (let i = 0; i < count; i++) {
      sphere[4 * i] = x[3 * i]; sphere[4 * i + 1] = x[3 * i + 1]; sphere[4 * i + 2] = x[3 * i + 2]; sphere[4 * i + 3] = r[i];
      value[i] = grainValues ? grainValues[i] : 0;
    }
    this.paint.grains.uniforms.ghost.value = opacity;
    this.shapes.grains.end();
  }

  fillMembranes() {
    const { data } = this, { shown, mesh, opacity } = this.settings.membranes;
    const { nodes, edges, triangles } = data;
    const on = shown && opacity > 0 && nodes;
    data.sides ??= nodes ? sidesOf(edges, triangles) : null;
    const values = this.valuesOfSides();
    const extra = data.sides?.extra ?? [], lines = edges.length / 2;
    const total = on ? lines + extra.length / 2 : 0;
    const bars = this.shapes.edges.begin(total);
    // Edges of facets are as thick as these; a little thinner they do not flicker through the sides.
    const thin = new Float32Array(total).fill(1);
    if (on) for (const side of data.sides.ofFacet) thin[side] = 0.985;
    const extraRadius = this.radiusOfExtra();
    for (let i = 0; i < total; i++) {
      const [a, b] = i < lines ? [edges[2 * i], edges[2 * i + 1]] : [extra[2 * (i - lines)], extra[2 * (i - lines) + 1]];
      for (let c = 0; c < 3; c++) { bars.from[4 * i + c] = nodes[3 * a + c]; bars.to[3 * i + c] = nodes[3 * b + c]; }
      bars.from[4 * i + 3] = thin[i] * (i < lines ? data.edgeRadius[i] : extraRadius[i - lines]);
      bars.values[2 * i] = values.nodes ? values.nodes[a] : values.sides ? values.sides[i] : 0;
      bars.values[2 * i + 1] = values.nodes ? values.nodes[b] : values.sides ? values.sides[i] : 0;
    }
    const count = on ? triangles.length / 3 : 0;
    const f = this.shapes.facets.begin(count);
    const normals = count ? cornerNormals(nodes, triangles) : null;
    for (let i = 0; i < count; i++) {
      for (let c = 0; c < 3; c++) {
        f.corner_0[4 * i + c] = nodes[3 * triangles[3 * i] + c];
        f.corner_1[3 * i + c] = nodes[3 * triangles[3 * i + 1] + c];
        f.corner_2[3 * i + c] = nodes[3 * triangles[3 * i + 2] + c];
        f.normal_0[3 * i + c] = normals[9 * i + c];
        f.normal_1[3 * i + c] = normals[9 * i + 3 + c];
        f.normal_2[3 * i + c] = normals[9 * i + 6 + c];
        f.values[3 * i + c] = values.nodes ? values.nodes[triangles[3 * i + c]] : values.facets ? values.facets[i] : 0;
      }
      f.corner_0[4 * i + 3] = data.facetRadius[i];
    }
    const u = this.paint.membranes.uniforms;
    u.mesh_lines.value = mesh ? 0.25 : 0;
    u.ghost.value = opacity;
    this.shapes.edges.end();
    this.shapes.facets.end();
  }

  radiusOfExtra() {
    const { sides, edges, triangles, facetRadius } = this.data;
    if (!sides) return [];
    const radius = new Float32Array(sides.extra.length / 2), first = edges.length / 2;
    for (let i = 0; i < triangles.length; i++)
      if (sides.ofFacet[i] >= first) radius[sides.ofFacet[i] - first] = facetRadius[Math.floor(i / 3)];
    return radius;
  }

  /** Every edge and every facet gets a value: an edge without one the mean of its facets, and the other way round. */
  valuesOfSides() {
    const v = this.data.membraneValues;
    if (!v || v.nodes) return v ?? {};
    const { sides, edges, triangles } = this.data;
    const count = edges.length / 2 + sides.extra.length / 2;
    let facetValues = v.facets;
    if (!facetValues && v.edges) {
      facetValues = new Float32Array(triangles.length / 3);
      for (let i = 0; i < facetValues.length; i++) {
        let sum = 0, n = 0;
        for (let k = 0; k < 3; k++) if (sides.ofFacet[3 * i + k] < v.edges.length) { sum += v.edges[sides.ofFacet[3 * i + k]]; n++; }
        facetValues[i] = n ? sum / n : 0;
      }
    }
    const ofSides = new Float32Array(count), n = new Uint8Array(count);
    if (facetValues) for (let i = 0; i < triangles.length; i++) { ofSides[sides.ofFacet[i]] += facetValues[Math.floor(i / 3)]; n[sides.ofFacet[i]]++; }
    for (let i = 0; i < count; i++) ofSides[i] = v.edges && i < v.edges.length ? v.edges[i] : n[i] ? ofSides[i] / n[i] : 0;
    return { sides: ofSides, facets: facetValues };
  }

  /** Ends of the line of a contact: the centres of spheres, and the contact point where there is none. */
  contactLines() {
    const { contacts, x, r, grainNumbers } = this.data;
    if (this.data.lines) return this.data.lines;
    const { kindA, kindB, bodyA, bodyB, places } = contacts;
    const row = new Map();
    let plainNumbers = true;
    grainNumbers?.forEach((id, i) => { row.set(id, i); plainNumbers &&= id === i; });
    const centre = (kind, body) => {
      const i = kind !== 0 ? undefined : plainNumbers ? (r && body < r.length ? body : undefined) : row.get(body);
      return i === undefined ? null : [x[3 * i], x[3 * i + 1], x[3 * i + 2]];
    };
    const lines = [];
    for (let i = 0, place = 0; i < kindA.length; i++) {
      let point = null;
      if (kindA[i] !== 0 || kindB[i] !== 0) { point = [places[3 * place], places[3 * place + 1], places[3 * place + 2]]; place++; }
      const a = centre(kindA[i], bodyA[i]) ?? point, b = centre(kindB[i], bodyB[i]) ?? point;
      lines.push(a && b ? [a, b] : null);
    }
    return (this.data.lines = lines);
  }

  /** Radius (m) of a line at the top of its range. */
  get thickest() {
    return this.settings.contacts.thickness * 0.35 * this.typicalRadius;
  }

  get typicalRadius() {
    const { r, edgeRadius, facetRadius } = this.data;
    const of = r?.length ? r : edgeRadius?.length ? edgeRadius : facetRadius;
    if (!of?.length) return 0.01 * this.stage.reach;
    if (this.typical?.of !== of) this.typical = { of, mean: of.reduce((a, b) => a + b, 0) / of.length };
    return this.typical.mean;
  }

  fillContacts() {
    const { contacts, contactValues } = this.data, settings = this.settings.contacts;
    const shape = this.shapes.contacts;
    if (!settings.shown || !contacts) { shape.begin(0); shape.end(); return; }
    const lines = this.contactLines(), top = this.forceTop();
    const drawn = [];
    for (let i = 0; i < lines.length; i++) if (lines[i] && contacts.force[i] > 0) drawn.push(i);
    const { from, to, values } = shape.begin(drawn.length);
    drawn.forEach((i, k) => {
      const [a, b] = lines[i];
      from.set(a, 4 * k);
      to.set(b, 3 * k);
      from[4 * k + 3] = this.thickest * Math.min(contacts.force[i] / top, 1.5) + 0.02 * this.thickest;
      values[2 * k] = values[2 * k + 1] = contactValues ? contactValues[i] : 0;
    });
    shape.end();
  }

  /** The normal force at which a line is as thick as thickest. */
  forceTop() {
    const field = this.run.field('contacts', 'normal_force_magnitude');
    const range = this.forceRange ?? field?.usual ?? [0, 1];
    return range[1] > 0 ? range[1] : 1;
  }

  fillPlanes() {
    const planes = this.run.frames[this.frame].planes ?? [];
    while (this.planes.length < planes.length) {
      const plane = new Plane();
      plane.group.renderOrder = -1;
      this.planes.push(plane);
      this.stage.scene.add(plane.group);
    }
    const spacing = ticks(0, this.stage.reach, 8)[1] ?? 1;
    this.planes.forEach((plane, i) => {
      plane.group.visible = this.settings.planes.shown && i < planes.length;
      if (!plane.group.visible) return;
      plane.place(planes[i], this.stage.box, spacing);
      plane.uniforms.plain.value.setRGB(...(this.dark ? [0.20, 0.22, 0.25] : [0.86, 0.87, 0.885]));
      plane.uniforms.grid.value.setRGB(...(this.dark ? [0.45, 0.48, 0.52] : [0.52, 0.55, 0.6]));
    });
  }

  /** Called before every picture, for what depends on the view. */
  look() {
    const planes = this.run.frames[this.frame].planes ?? [];
    this.applySlice();
    this.planes.forEach((plane, i) => {
      if (plane.group.visible) plane.endAt(planes.filter((_, k) => k !== i), this.stage.camera.matrixWorldInverse);
    });
  }

  /** Box around what there is in a frame, without the few grains that are far off. */
  boxOf(data) {
    const box = new THREE.Box3();
    const { x, r, nodes } = data;
    if (nodes) for (let i = 0; i < nodes.length; i += 3) box.expandByPoint(new THREE.Vector3(nodes[i], nodes[i + 1], nodes[i + 2]));
    if (x) {
      const lo = [], hi = [], n = r.length;
      for (let c = 0; c < 3; c++) {
        const sorted = Float32Array.from({ length: n }, (_, i) => x[3 * i + c]).sort();
        const most = sorted[Math.floor(0.99 * (n - 1))], least = sorted[Math.ceil(0.01 * (n - 1))], span = most - least;
        // What lies a little outside of the bulk belongs to it.
        lo.push(Math.max(sorted[0], least - 0.3 * span - 2 * r[0])); hi.push(Math.min(sorted[n - 1], most + 0.3 * span + 2 * r[0]));
      }
      if (n) box.union(new THREE.Box3(new THREE.Vector3(...lo), new THREE.Vector3(...hi)).expandByScalar(this.typicalRadiusOf(r)));
    }
    return box;
  }

  typicalRadiusOf(r) { return r.reduce((a, b) => a + b, 0) / r.length; }

  /** Looks at all there is, at the beginning and the end of the run. */
  async home() {
    const box = new THREE.Box3();
    this.places = [];
    for (const k of new Set([0, this.run.frames.length - 1])) {
      const get = (part, on, name) => this.run.array(k, part, on, name);
      const seen = { x: await get('grains', 'grains', 'position'), r: await get('grains', 'grains', 'radius'), nodes: await get('membranes', 'nodes', 'position') };
      const own = this.boxOf(seen);
      this.places.push(...placesIn(own, seen));
      box.union(own);
    }
    if (box.isEmpty()) box.set(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
    this.homeBox = box;
    const s = box.getSize(new THREE.Vector3()), most = Math.max(s.x, s.y, s.z);
    if (most === 0) box.expandByScalar(1);
    // A sheet or net is looked at from the front.
    const direction = s.z < 0.1 * most ? new THREE.Vector3(0, -0.55, 1)
      : s.y < 0.1 * most ? new THREE.Vector3(-0.3, -1, 0.2) : s.x < 0.1 * most ? new THREE.Vector3(1, -0.3, 0.2)
      : new THREE.Vector3(-0.55, -1, 0.55);
    this.stage.frame(box, direction, this.places);
    this.stage.shadeReach = Math.min(0.06 * this.stage.reach, 3 * this.typicalRadius || Infinity);
  }

  applySlice() {
    const { on, axis, at, turned } = this.settings.slice;
    shared.sliced.value = on ? 1 : 0;
    const normal = new THREE.Vector3(), sign = turned ? -1 : 1;
    normal.setComponent(axis, sign);
    const matrix = this.stage.camera.matrixWorldInverse;
    const n = normal.clone().transformDirection(matrix);
    const point = new THREE.Vector3().setComponent(axis, at).applyMatrix4(matrix);
    shared.slice.value.set(n.x, n.y, n.z, -n.dot(point));
  }

  isCutOff(p) {
    const { on, axis, at, turned } = this.settings.slice;
    return on && (turned ? p[axis] < at : p[axis] > at);
  }

  /**
   * The first element along a ray: {part, index, ...}; nothing if there is none.
   * @param slack  m, by which wires and lines of contacts are taken to be thicker
   */
  pick(ray, slack = 0) {
    const o = ray.origin.toArray(), d = ray.direction.toArray(), { data, settings } = this;
    let best = null, nearest = Infinity;
    const { on, axis, at } = settings.slice;
    const offer = (span, hit) => {
      if (!span) return;
      let [t0, t1] = span;
      if (on && this.isCutOff(o.map((v, c) => v + t0 * d[c]))) {
        t0 = (at - o[axis]) / d[axis];
        if (!(t0 > span[0] && t0 < t1)) return;
      }
      if (t0 > 0 && t0 < nearest) { nearest = t0; best = hit; }
    };
    const { x, r, nodes, edges, triangles } = data;
    const grainsSolid = settings.grains.shown && settings.grains.opacity >= 0.5;
    if (x && grainsSolid) for (let i = 0; i < r.length; i++) offer(throughBall(o, d, [x[3 * i], x[3 * i + 1], x[3 * i + 2]], r[i]), { part: 'grains', on: 'grains', index: i });
    const node = (n) => [nodes[3 * n], nodes[3 * n + 1], nodes[3 * n + 2]];
    if (nodes && settings.membranes.shown && settings.membranes.opacity >= 0.5) {
      const normals = triangleNormals(nodes, triangles);
      for (let i = 0; i < triangles.length / 3; i++) {
        const n = [normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]], l = Math.hypot(...n) || 1;
        for (const side of [-1, 1]) {
          const shift = n.map((v) => side * data.facetRadius[i] * v / l);
          const corner = (k) => node(triangles[3 * i + k]).map((v, c) => v + shift[c]);
          const t = throughTriangle(o, d, corner(0), corner(1), corner(2));
          if (t !== null) offer([t, t], { part: 'membranes', on: 'facets', index: i });
        }
      }
      const bare = triangles.length ? 0.985 : 1;
      for (let i = 0; i < edges.length / 2; i++)
        offer(throughCapsule(o, d, node(edges[2 * i]), node(edges[2 * i + 1]), bare * data.edgeRadius[i] + slack), { part: 'membranes', on: 'edges', index: i });
    }
    if (settings.contacts.shown && data.contacts) {
      const top = this.forceTop();
      this.contactLines().forEach((line, i) => {
        if (line && data.contacts.force[i] > 0) offer(throughCapsule(o, d, ...line, slack + this.thickest * Math.min(data.contacts.force[i] / top, 1.5)), { part: 'contacts', on: 'contacts', index: i });
      });
    }
    return best && { ...best, ...this.identity(best) };
  }

  /** What an element is called in every frame: a grain by its number, elements of structures by their nodes. */
  identity({ on, index }) {
    const { data } = this;
    if (on === 'edges') return { nodes: [...data.edges.slice(2 * index, 2 * index + 2)] };
    if (on === 'facets') return { nodes: [...data.triangles.slice(3 * index, 3 * index + 3)] };
    return {};
  }

  async select(hit) {
    this.selected = hit ? { ...hit } : null;
    if (hit && (hit.on === 'edges' || hit.on === 'facets')) {
      const numbers = await this.run.array(this.frame, 'membranes', 'nodes', 'node');
      this.selected.numbers = hit.nodes.map((n) => (numbers ? numbers[n] : n));
    }
    if (hit?.on === 'grains') {
      const ids = await this.run.array(this.frame, 'grains', 'grains', 'id');
      this.selected.numbers = [ids ? ids[hit.index] : hit.index];
    }
    if (hit?.on === 'contacts') {
      const c = this.data.contacts;
      this.selected.numbers = [c.kindA[hit.index], c.bodyA[hit.index], c.kindB[hit.index], c.bodyB[hit.index]];
    }
    this.fillPicked();
    this.stage.change();
  }

  /** Where the selected element is in a frame; -1 if it is not there. */
  async find(k, selected = this.selected) {
    const get = (part, on, name) => this.run.array(k, part, on, name);
    const { on, numbers } = selected;
    if (on === 'grains') {
      const ids = await get('grains', 'grains', 'id');
      if (!ids) return numbers[0] < (this.run.frames[k].grains ?? 0) ? numbers[0] : -1;
      return ids[numbers[0]] === numbers[0] ? numbers[0] : ids.indexOf(numbers[0]);
    }
    if (on === 'contacts') {
      const [ka, a, kb, b] = await Promise.all(['kind_a', 'body_a', 'kind_b', 'body_b'].map((n) => get('contacts', 'contacts', n)));
      for (let i = 0; i < (ka?.length ?? 0); i++) if (a[i] === numbers[1] && b[i] === numbers[3] && ka[i] === numbers[0] && kb[i] === numbers[2]) return i;
      return -1;
    }
    const [names, of] = await Promise.all([get('membranes', 'nodes', 'node'), get('membranes', on, 'nodes')]);
    const size = on === 'edges' ? 2 : 3;
    for (let i = 0; i < (of?.length ?? 0); i += size) {
      let same = true;
      for (let c = 0; c < size && same; c++) same = (names ? names[of[i + c]] : of[i + c]) === numbers[c];
      if (same) return i / size;
    }
    return -1;
  }

  fillPicked() {
    const { ball, bar } = this.shapes, { data, selected } = this;
    let balls = [], bars = [];
    const i = selected?.here ?? selected?.index;
    const node = (n) => [data.nodes[3 * n], data.nodes[3 * n + 1], data.nodes[3 * n + 2]];
    if (selected && i >= 0) {
      if (selected.on === 'grains' && data.r && i < data.r.length) balls.push([data.x[3 * i], data.x[3 * i + 1], data.x[3 * i + 2], 1.015 * data.r[i]]);
      if (selected.on === 'edges' && 2 * i < data.edges.length) bars.push([node(data.edges[2 * i]), node(data.edges[2 * i + 1]), 1.08 * data.edgeRadius[i]]);
      if (selected.on === 'facets' && 3 * i < data.triangles.length)
        for (let k = 0; k < 3; k++) bars.push([node(data.triangles[3 * i + k]), node(data.triangles[3 * i + (k + 1) % 3]), 1.08 * data.facetRadius[i]]);
      if (selected.on === 'contacts' && data.contacts && this.settings.contacts.shown) {
        const line = this.contactLines()[i];
        if (line) bars.push([...line, 1.05 * this.thickest * Math.min(data.contacts.force[i] / this.forceTop(), 1.5) + 0.05 * this.thickest]);
      }
    }
    const b = ball.begin(balls.length);
    balls.forEach((v, k) => b.sphere.set(v, 4 * k));
    ball.end();
    const c = bar.begin(bars.length);
    bars.forEach(([from, to, r], k) => { c.from.set([...from, r], 4 * k); c.to.set(to, 3 * k); });
    bar.end();
  }
}
