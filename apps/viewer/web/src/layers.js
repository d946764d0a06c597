// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn, as instances of a few shapes.
import * as THREE from 'three';
import * as shaders from './shaders.js';
import { mapBytes } from './colour.js';

/** Uniforms that all layers share: view and slice. */
export const shared = {
  slice: { value: new THREE.Vector4(0, 0, 1, 0) },
  sliced: { value: 0 },
  parallel: { value: 0 },
};

const kQuad = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0]);
const kBox = new THREE.BoxGeometry(2, 2, 2).toNonIndexed().attributes.position.array;
// Corner 0, 1, 2 of the side a facet faces; of the other side turned over.
const kSides = new Float32Array([0, 1, 0, 1, 1, 0, 2, 1, 0, 0, -1, 0, 2, -1, 0, 1, -1, 0]);

function textureOf(map) {
  const texture = new THREE.DataTexture(mapBytes(map), 256, 1, THREE.RGBAFormat);
  texture.minFilter = texture.magFilter = map === 'categories' ? THREE.NearestFilter : THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
const kTextures = new Map();
function sharedTexture(map) {
  if (!kTextures.has(map)) kTextures.set(map, textureOf(map));
  return kTextures.get(map);
}

/** How something is coloured; shapes of one layer share it. */
export class Paint {
  constructor(plain) {
    this.uniforms = {
      ...shared,
      colours: { value: sharedTexture('viridis') },
      range: { value: new THREE.Vector2(0, 1) },
      colouring: { value: 0 },
      plain: { value: new THREE.Color().setRGB(...plain) },
      ghost: { value: 1 },
      mesh_lines: { value: 0 },
    };
  }
  set({ map, range, mode }) {
    this.uniforms.colours.value = sharedTexture(mode === 3 ? 'categories' : map);
    this.uniforms.range.value.set(...range);
    this.uniforms.colouring.value = mode;
  }
}

/** Many copies of one shape, each with attributes of its own. */
class Instances {
  constructor(paint, base, attributes, vertexShader, fragmentShader, side) {
    this.sizes = attributes;
    this.geometry = new THREE.InstancedBufferGeometry();
    this.geometry.setAttribute('position', new THREE.BufferAttribute(base, 3));
    this.geometry.instanceCount = 0;
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader, fragmentShader, uniforms: paint.uniforms, side,
    });
    this.paint = paint;
    this.mesh = new THREE.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.capacity = -1;
  }
  /** Room for a number of copies. @returns the arrays to fill, by name */
  begin(count) {
    if (count > this.capacity) {
      this.capacity = count;
      // Buffers on the graphics card keep their size, so larger ones are new ones.
      this.geometry.dispose();
      for (const [name, size] of Object.entries(this.sizes))
        this.geometry.setAttribute(name, new THREE.InstancedBufferAttribute(new Float32Array(size * Math.max(count, 1)), size));
    }
    this.geometry.instanceCount = count;
    return Object.fromEntries(Object.keys(this.sizes).map((name) => [name, this.geometry.attributes[name].array]));
  }
  end() {
    for (const name of Object.keys(this.sizes)) this.geometry.attributes[name].needsUpdate = true;
    const ghostly = this.paint.uniforms.ghost.value < 1;
    if (this.material.transparent !== ghostly) {
      this.material.transparent = ghostly;
      this.material.depthWrite = !ghostly;
      this.material.needsUpdate = true;
    }
  }
}

export const spheres = (paint) =>
  new Instances(paint, kQuad, { sphere: 4, value: 1 }, shaders.sphereVertex, shaders.sphereFragment, THREE.DoubleSide);

// The back of the box: seen also from within it, and once only.
export const capsules = (paint) =>
  new Instances(paint, kBox, { from: 4, to: 3, values: 2 }, shaders.capsuleVertex, shaders.capsuleFragment, THREE.BackSide);

export const facets = (paint) =>
  new Instances(paint, kSides, { corner_0: 4, corner_1: 3, corner_2: 3, values: 3, normal_0: 3, normal_1: 3, normal_2: 3 },
    shaders.facetVertex, shaders.facetFragment, THREE.DoubleSide);

const kWalls = 12, kContainers = 4;   // as many as the shader has room for

/** Seen from the inside. */
function turnedInward(geometry) {
  const { array } = geometry.index;
  for (let i = 0; i < array.length; i += 3) [array[i], array[i + 1]] = [array[i + 1], array[i]];
  return geometry;
}
// Across z, around y and around the middle, of the size 1.
const kFlat = new THREE.PlaneGeometry(2, 2);
const kCylinder = turnedInward(new THREE.CylinderGeometry(1, 1, 2, 96, 1, true));
const kSphere = turnedInward(new THREE.SphereGeometry(1, 96, 48));

/** A unit vector across another one. */
function across(n) {
  const u = new THREE.Vector3(...(Math.abs(n.x) < 0.9 ? [1, 0, 0] : [0, 1, 0]));
  return u.addScaledVector(n, -u.dot(n)).normalize();
}

/** A plane as it is in a frame: point, direction and radius, which older runs have not. */
const isContainer = (plane) => plane[6] > 0;

/** A rigid wall with a grid: a rectangle of a half-space, or a container. */
export class Plane {
  constructor() {
    this.uniforms = {
      ...shared,
      colours: { value: sharedTexture('viridis') }, range: { value: new THREE.Vector2(0, 1) }, colouring: { value: 0 },
      ghost: { value: 1 },
      plain: { value: new THREE.Color() }, grid: { value: new THREE.Color() },
      size: { value: new THREE.Vector2(1, 1) }, shift: { value: new THREE.Vector2() }, spacing: { value: 1 },
      walls: { value: Array.from({ length: kWalls }, () => new THREE.Vector4()) }, wall_count: { value: 0 }, slack: { value: 0 },
      middles: { value: Array.from({ length: kContainers }, () => new THREE.Vector4()) }, container_count: { value: 0 },
      axes: { value: Array.from({ length: kContainers }, () => new THREE.Vector3()) }, ends: { value: new THREE.Vector2(1, 1) },
    };
    const material = (side) => new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: shaders.planeVertex, fragmentShader: shaders.planeFragment,
      uniforms: this.uniforms, side, defines: side === THREE.BackSide ? { BACK: 1 } : {}, transparent: side === THREE.BackSide, depthWrite: side === THREE.FrontSide,
    });
    this.group = new THREE.Group();
    for (const side of [THREE.FrontSide, THREE.BackSide]) this.group.add(new THREE.Mesh(kFlat, material(side)));
    this.group.children.forEach((mesh) => { mesh.frustumCulled = false; mesh.matrixAutoUpdate = false; });
  }
  /** Puts it where a plane of a frame is, wide enough for a box. */
  place(plane, box, spacing) {
    const p = new THREE.Vector3(...plane.slice(0, 3)), n = new THREE.Vector3(...plane.slice(3, 6));
    this.uniforms.spacing.value = spacing;
    this.uniforms.slack.value = 1e-4 * box.min.distanceTo(box.max);
    const range = (axis) => {
      let lo = Infinity, hi = -Infinity;
      for (let k = 0; k < 8; k++) {
        const x = (k & 1 ? box.max.x : box.min.x) * axis.x + (k & 2 ? box.max.y : box.min.y) * axis.y + (k & 4 ? box.max.z : box.min.z) * axis.z;
        lo = Math.min(lo, x); hi = Math.max(hi, x);
      }
      const margin = 0.08 * box.min.distanceTo(box.max);
      return [Math.floor((lo - margin) / spacing) * spacing, Math.ceil((hi + margin) / spacing) * spacing];
    };
    if (!isContainer(plane)) this.placeFlat(p, n, range);
    else if (n.lengthSq() > 0) this.placeCylinder(p, n, plane[6], range);
    else this.set(kSphere, new THREE.Matrix4().makeScale(plane[6], plane[6], plane[6]).setPosition(p), [Math.PI * plane[6], Math.PI / 2 * plane[6]], [0, 0], [0, 0]);
  }
  placeFlat(p, n, range) {
    const u = across(n), v = new THREE.Vector3().crossVectors(n, u);
    const [u0, u1] = range(u), [v0, v1] = range(v);
    const centre = n.clone().multiplyScalar(p.dot(n)).addScaledVector(u, (u0 + u1) / 2).addScaledVector(v, (v0 + v1) / 2);
    const matrix = new THREE.Matrix4().makeBasis(u.clone().multiplyScalar((u1 - u0) / 2), v.clone().multiplyScalar((v1 - v0) / 2), n);
    this.set(kFlat, matrix.setPosition(centre), [(u1 - u0) / 2, (v1 - v0) / 2], [(u0 + u1) / 2, (v0 + v1) / 2], [1, 1]);
  }
  placeCylinder(p, n, radius, range) {
    const u = across(n), w = new THREE.Vector3().crossVectors(u, n);
    const [n0, n1] = range(n), half = (n1 - n0) / 2, middle = (n0 + n1) / 2;
    const matrix = new THREE.Matrix4().makeBasis(u.clone().multiplyScalar(radius), n.clone().multiplyScalar(half), w.multiplyScalar(radius));
    matrix.setPosition(p.clone().addScaledVector(n, middle - p.dot(n)));
    this.set(kCylinder, matrix, [Math.PI * radius, half], [0, middle], [0, 1]);
  }
  /** @param ends whether it has an end across, and along */
  set(geometry, matrix, size, shift, ends) {
    for (const mesh of this.group.children) { mesh.geometry = geometry; mesh.matrix.copy(matrix); mesh.matrixWorldNeedsUpdate = true; }
    this.uniforms.size.value.set(...size);
    this.uniforms.shift.value.set(...shift);
    this.uniforms.ends.value.set(...ends);
  }

  /** Ends it where it meets other planes of its frame, as the camera sees them. */
  endAt(others, viewMatrix) {
    const { walls, wall_count, middles, axes, container_count } = this.uniforms;
    const direction = (plane) => {
      const n = new THREE.Vector3(...plane.slice(3, 6));
      return n.lengthSq() > 0 ? n.transformDirection(viewMatrix) : n;
    };
    const point = (plane) => new THREE.Vector3(...plane.slice(0, 3)).applyMatrix4(viewMatrix);
    const flat = others.filter((plane) => !isContainer(plane)).slice(0, kWalls);
    wall_count.value = flat.length;
    flat.forEach((plane, i) => {
      const n = direction(plane);
      walls.value[i].set(n.x, n.y, n.z, -n.dot(point(plane)));
    });
    const containers = others.filter(isContainer).slice(0, kContainers);
    container_count.value = containers.length;
    containers.forEach((plane, i) => {
      const p = point(plane);
      middles.value[i].set(p.x, p.y, p.z, plane[6]);
      axes.value[i].copy(direction(plane));
    });
  }
}
