// SPDX-License-Identifier: GPL-3.0-or-later
// Camera and picture. A picture that does not change is drawn again and again, each time shifted by a part of a
// pixel, and averaged: edges become smooth and shade soft, and whoever turns the scene still gets every frame fast.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import * as shaders from './shaders.js';
import { shared } from './layers.js';

const kPictures = 24;          // averaged; more change nothing that can be seen
const kPicturesInSoftware = 8; // where no graphics card helps, of scenes of some thousand elements; of larger ones fewer
const kFieldOfView = 32;   // degrees, that of a short telephoto lens: little distortion

function screenPass(fragmentShader, uniforms, options = {}) {
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: shaders.screenVertex, fragmentShader, uniforms, depthTest: false, depthWrite: false, ...options,
  });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
  mesh.frustumCulled = false;
  const scene = new THREE.Scene();
  scene.add(mesh);
  return { scene, uniforms };
}

/** The Halton sequence: numbers in [0, 1) that fill it evenly. */
function halton(index, base) {
  let result = 0;
  for (let f = 1 / base, i = index; i > 0; i = Math.floor(i / base), f /= base) result += f * (i % base);
  return result;
}

function cornersOf({ min, max }) {
  return Array.from({ length: 8 }, (_, k) => [k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z, 0]);
}

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    this.scene = new THREE.Scene();
    this.scene.matrixWorldAutoUpdate = true;
    this.perspective = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.01, 100);
    this.orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01, 100);
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.camera = this.perspective;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.rotateSpeed = 0.8;
    this.controls.zoomSpeed = 1.2;
    this.controls.addEventListener('change', () => this.change());
    this.controls.addEventListener('start', () => { this.framed = null; });
    this.reach = 1;        // size of what is seen, set by frame()
    this.box = new THREE.Box3(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
    this.onDraw = [];      // called after a picture is shown
    this.beforeDraw = [];  // called before it is drawn, when the camera stands
    const none = { value: null };
    this.shade = screenPass(shaders.shadeFragment, {
      scene: { ...none }, depth: { ...none }, unproject: { value: new THREE.Matrix4() }, pixels: { value: new THREE.Vector2() },
      turn: { value: 0 }, reach: { value: 1 }, strength: { value: 1.9 }, pixels_per_length: { value: 1 }, parallel: shared.parallel,
      opacity: { value: 1 }, sky_top: { value: new THREE.Color() }, sky_bottom: { value: new THREE.Color() },
    }, { transparent: true, blending: THREE.CustomBlending, blendSrc: THREE.SrcAlphaFactor, blendDst: THREE.OneMinusSrcAlphaFactor });
    this.copy = screenPass(shaders.copyFragment, { scene: { ...none } });
    const averages = this.renderer.getContext().getExtension('EXT_color_buffer_float') !== null;
    this.most = averages ? kPictures : 1;
    const gl = this.renderer.getContext(), info = gl.getExtension('WEBGL_debug_renderer_info');
    const drawnBy = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
    this.inSoftware = /swiftshader|llvmpipe|software|basic render/i.test(drawnBy);
    this.elements = 0;   // that are drawn, set by who fills the scene
    this.target = null;
    this.average = null;
    this.done = 0;
    this.setSky();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    const loop = () => { requestAnimationFrame(loop); this.tick(); };
    requestAnimationFrame(loop);
  }

  /** Light enough for dark colours and dark enough for light ones, if nothing else is said. */
  setSky(top = [0.945, 0.952, 0.96], bottom = [0.755, 0.785, 0.82]) {
    this.shade.uniforms.sky_top.value.setRGB(...top);
    this.shade.uniforms.sky_bottom.value.setRGB(...bottom);
    this.change();
  }

  /** Something has changed: begin the picture anew. */
  change() { this.done = 0; }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.width = Math.max(clientWidth, 1);
    this.height = Math.max(clientHeight, 1);
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.width, this.height, false);
    const w = this.canvas.width, h = this.canvas.height;
    this.target?.dispose();
    this.average?.dispose();
    this.target?.depthTexture.dispose();
    const depthTexture = new THREE.DepthTexture(w, h, THREE.FloatType);
    const near = { minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, generateMipmaps: false };
    this.target = new THREE.WebGLRenderTarget(w, h, { ...near, depthTexture });
    this.average = new THREE.WebGLRenderTarget(w, h, { ...near, depthBuffer: false, type: this.most > 1 ? THREE.HalfFloatType : THREE.UnsignedByteType });
    this.shade.uniforms.scene.value = this.target.texture;
    this.shade.uniforms.depth.value = depthTexture;
    this.shade.uniforms.pixels.value.set(w, h);
    this.copy.uniforms.scene.value = this.average.texture;
    // Who has not moved the view yet sees all of the scene in a window of another size too.
    if (this.framed) this.frame(...this.framed);
    this.change();
  }

  /** Pictures that are averaged. */
  get pictures() {
    if (!this.inSoftware) return this.most;
    return Math.min(this.most, Math.max(1, Math.round(kPicturesInSoftware * Math.min(1, 10000 / (this.elements + 1)))));
  }

  get distance() { return this.camera.position.distanceTo(this.controls.target); }

  /** Length in the scene of a pixel of the page, at the middle of the view. */
  get pixelLength() {
    return this.camera === this.perspective
      ? 2 * this.distance * Math.tan(THREE.MathUtils.degToRad(kFieldOfView) / 2) / this.height
      : (this.orthographic.top - this.orthographic.bottom) / this.orthographic.zoom / this.height;
  }

  /**
   * Looks from a direction at what is in a box.
   * @param places  [x, y, z, radius] of what is to be seen; if not given the corners of the box
   */
  frame(box, direction, places = cornersOf(box)) {
    this.box.copy(box);
    this.framed = [box, direction, places];
    const centre = box.getCenter(new THREE.Vector3());
    const d = direction.clone().normalize();
    const right = new THREE.Vector3().crossVectors(new THREE.Vector3(0, 0, 1), d);
    if (right.lengthSq() < 1e-8) right.set(1, 0, 0);
    right.normalize();
    const up = new THREE.Vector3().crossVectors(d, right);
    const half = Math.tan(THREE.MathUtils.degToRad(kFieldOfView) / 2), aspect = this.width / this.height;
    // The nearest place from which every corner of the box is seen.
    let distance = 0, tall = 0;
    const fit = () => {
      distance = tall = 0;
      for (const [x, y, z, r] of places) {
        const place = new THREE.Vector3(x, y, z).sub(centre);
        const across = Math.max((Math.abs(place.dot(right)) + r) / aspect, Math.abs(place.dot(up)) + r);
        distance = Math.max(distance, across / half + place.dot(d) + r);
        tall = Math.max(tall, across);
      }
    };
    fit();
    // What is seen need not be about the middle of its box: shift it there.
    for (let i = 0; i < 3; i++) {
      let lo = [Infinity, Infinity], hi = [-Infinity, -Infinity];
      for (const [x, y, z] of places) {
        const place = new THREE.Vector3(x, y, z).sub(centre), away = Math.max(distance - place.dot(d), 1e-3 * distance);
        [right, up].forEach((axis, k) => { const t = place.dot(axis) / away; lo[k] = Math.min(lo[k], t); hi[k] = Math.max(hi[k], t); });
      }
      if (lo[0] <= hi[0]) [right, up].forEach((axis, k) => centre.addScaledVector(axis, distance * (lo[k] + hi[k]) / 2));
      fit();
    }
    distance *= 1.05;
    this.reach = box.min.distanceTo(box.max) || 1;
    this.controls.target.copy(centre);
    this.orthographic.zoom = 1;
    this.tall = 1.06 * tall;
    for (const camera of [this.perspective, this.orthographic]) {
      camera.position.copy(centre).addScaledVector(d, distance);
      camera.lookAt(centre);
    }
    this.controls.update();
    this.change();
  }

  setParallel(parallel) {
    if ((this.camera === this.orthographic) === parallel) return;
    const from = this.camera;
    const length = this.pixelLength;
    this.camera = parallel ? this.orthographic : this.perspective;
    this.camera.position.copy(from.position);
    this.camera.quaternion.copy(from.quaternion);
    if (parallel) {
      this.tall = length * this.height / 2;
      this.orthographic.zoom = 1;
    } else {
      const d = length * this.height / 2 / Math.tan(THREE.MathUtils.degToRad(kFieldOfView) / 2);
      this.camera.position.sub(this.controls.target).setLength(d).add(this.controls.target);
    }
    this.controls.object = this.camera;
    shared.parallel.value = parallel ? 1 : 0;
    this.controls.update();
    this.change();
  }

  /** Near and far from the scene, so that depth is as fine as it can be. */
  fitCamera() {
    const { camera } = this, centre = this.box.getCenter(new THREE.Vector3());
    const radius = 1.3 * this.box.min.distanceTo(this.box.max) / 2 + 1e-9;
    const ahead = camera.getWorldDirection(new THREE.Vector3());
    const middle = centre.clone().sub(camera.position).dot(ahead);
    camera.far = Math.max(middle + 2 * radius, 1e-3 * radius);
    if (camera === this.perspective) {
      camera.near = Math.max(middle - 2 * radius, 0.002 * camera.far);
      camera.aspect = this.width / this.height;
    } else {
      // The rays of a parallel view begin in the plane of the eye, which is to be before everything.
      const back = 2 * radius - middle;
      if (back > 0) camera.position.addScaledVector(ahead, -back);
      camera.near = 0;
      camera.far = Math.max(middle, 2 * radius) + 4 * radius;
      const tall = this.tall ?? 1;
      camera.top = tall; camera.bottom = -tall;
      camera.right = tall * this.width / this.height; camera.left = -camera.right;
    }
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  tick() {
    if (this.done >= this.pictures) return;
    const { camera, renderer } = this;
    const start = performance.now();
    // Some more of them at once where that is quick.
    do { this.picture(); } while (this.done > 1 && this.done < this.pictures && performance.now() - start < 8);
    renderer.setRenderTarget(null);
    renderer.render(this.copy.scene, camera);
    for (const hear of this.onDraw) hear();
  }

  picture() {
    const { camera, renderer } = this;
    this.fitCamera();
    for (const hear of this.beforeDraw) hear();
    const w = this.canvas.width, h = this.canvas.height;
    if (this.done > 0) {
      camera.setViewOffset(w, h, halton(this.done, 2) - 0.5, halton(this.done, 3) - 0.5, w, h);
    } else {
      camera.clearViewOffset();
    }
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(this.scene, camera);
    const u = this.shade.uniforms;
    u.unproject.value.copy(camera.projectionMatrixInverse);
    u.turn.value = this.done * 0.618034;
    u.opacity.value = 1 / (this.done + 1);
    u.reach.value = this.shadeReach ?? 0.05 * this.reach;
    u.pixels_per_length.value = camera.projectionMatrix.elements[5] * h / 2;
    renderer.setRenderTarget(this.average);
    renderer.render(this.shade.scene, camera);
    camera.clearViewOffset();
    this.done++;
  }

  /** Draws what is missing of the picture now. */
  finish() {
    while (this.done < this.pictures) this.picture();
    this.renderer.setRenderTarget(null);
    this.renderer.render(this.copy.scene, this.camera);
  }

  /** Ray (origin, direction) through a place of the page. */
  rayAt(x, y) {
    const rectangle = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(2 * (x - rectangle.left) / rectangle.width - 1, 1 - 2 * (y - rectangle.top) / rectangle.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, this.camera);
    return caster.ray;
  }
}
