// SPDX-License-Identifier: Apache-2.0
// What is drawn and from where: light, camera, and the two ways to move it. Pictures are drawn
// when something has changed, not all the time.
import {
  AmbientLight, Box3, DirectionalLight, MathUtils, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {placeFor} from '../src/fit.js';
import {Fly} from './fly.js';
import {GlobeCamera} from './globe_camera.js';
import {placeOnGlobe} from './globe_pointer.js';
import {NARROW} from './page.js';
import {pointOn} from './ray.js';

const REST = 150;  // ms
const PANEL_SHIFT = 150;  // pixels, by which a panel beside the terrain moves its middle
const TURN = 0.08, NEARER = 0.9;
/** Shares of the light: together they show white as white, and no more. */
const AMBIENT = 0.45, SUN = 1 - AMBIENT;
/** Keys of the picture while nobody flies. */
const KEYS = {
  'ArrowLeft': (orbit) => orbit.rotateLeft(-TURN),
  'ArrowRight': (orbit) => orbit.rotateLeft(TURN),
  'ArrowUp': (orbit) => orbit.rotateUp(-TURN),
  'ArrowDown': (orbit) => orbit.rotateUp(TURN),
  '+': (orbit) => orbit.dollyIn(1 / NEARER),
  '=': (orbit) => orbit.dollyIn(1 / NEARER),
  '-': (orbit) => orbit.dollyOut(1 / NEARER),
};

export class Picture {
  #scene = new Scene();
  #ambient = new AmbientLight(0xffffff);
  #sun = new DirectionalLight(0xffffff);
  #object = null;
  #original = null;
  #edge = 0.5;  // of the picture's width, left of which the stream is drawn
  #pending = false;
  #last = 0;
  #sunAt = new Vector3();  // as on a map that is looked down on
  #radius = 1;
  #middle = new Vector3();
  #times = 1;
  #resting = 0;
  #sized = [];  // who waits for a picture with a size
  /** Called when the camera has moved and rests, and with each picture. */
  onrest = () => {};
  ondraw = () => {};
  /** The camera is where somebody has moved it. */
  isMoved = false;

  /** `free()`: the part of the page, {left, right, top, bottom}, that nothing lies over. */
  constructor(canvas, free) {
    this.free = free;
    this.renderer = new WebGLRenderer({canvas, antialias: true, alpha: true});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.camera = new PerspectiveCamera(45, 1, 1, 1e7);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = true;
    this.orbit.dampingFactor = 0.12;
    this.orbit.maxPolarAngle = 1.53;
    this.orbit.screenSpacePanning = false;
    this.orbit.zoomToCursor = true;
    this.orbit.addEventListener('change', () => this.#moved());
    this.orbit.addEventListener('start', () => (this.isMoved = true));
    this.fly = new Fly(this.camera, canvas, () => {
      this.isMoved ||= this.fly.enabled;
      this.#moved();
    });
    this.globe = new GlobeCamera(this.camera, this.orbit);
    this.#scene.add(this.#ambient, this.#sun);
    this.setShaded(true);
    canvas.addEventListener('webglcontextrestored', () => this.draw());
    canvas.addEventListener('keydown', (event) => this.#pressed(event));
    addEventListener('resize', () => this.resize());
    this.resize();
  }

  /** The page, or what lies over it, has another size. */
  resize() {
    if (!this.hasSize) return;  // there is no camera for no picture
    for (const tell of this.#sized.splice(0)) tell();
    this.renderer.setSize(innerWidth, innerHeight, false);
    this.camera.aspect = innerWidth / innerHeight;
    // The middle of the picture is about that of what the panel leaves free.
    const [right, down] = innerWidth > NARROW
      ? [PANEL_SHIFT, 0] : [0, (innerHeight - this.free().bottom) / 2];
    this.camera.setViewOffset(innerWidth, innerHeight, right, down, innerWidth, innerHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** False in a frame that is not shown. */
  get hasSize() {
    return innerWidth > 0 && innerHeight > 0;
  }
  /** Resolves once there is a picture to be drawn. */
  async sized() {
    if (!this.hasSize) await new Promise((resolve) => this.#sized.push(resolve));
  }

  /** Rows of the picture. */
  get pixels() {
    return this.renderer.domElement.height;
  }
  #pressed(event) {
    if (event.key === 'Home') this.home();
    else if (!this.fly.enabled && KEYS[event.key]) {
      this.isMoved = true;
      KEYS[event.key](this.orbit);
    } else return;
    event.preventDefault();
  }
  #moved() {
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => this.onrest(), REST);
    this.draw();
  }

  /** Draws once the browser is ready for it. */
  draw() {
    if (this.#pending) return;
    this.#pending = true;
    requestAnimationFrame((now) => {
      this.#pending = false;
      const seconds = Math.min(0.1, (now - this.#last) / 1000);
      this.#last = now;
      const moving = this.fly.update(seconds, 0.25 * this.#radius);
      if (!this.fly.enabled) this.orbit.update();
      const gliding = this.#object?.glide();
      this.#fitDepth();
      this.#placeSun();
      this.#render();
      this.ondraw();
      if (moving) this.#moved();
      else if (gliding) this.draw();
    });
  }
  /** The stream, and right of the edge its original. */
  #render() {
    const {renderer} = this;
    if (!this.#original) return renderer.render(this.#scene, this.camera);
    const edge = Math.round(this.#edge * innerWidth);
    renderer.setScissorTest(true);
    for (const [isOriginal, left, width] of [[false, 0, edge], [true, edge, innerWidth - edge]]) {
      this.#object.visible = !isOriginal;
      this.#original.visible = isOriginal;
      renderer.setScissor(left, 0, width, innerHeight);
      renderer.render(this.#scene, this.camera);
    }
    this.#object.visible = true;
    renderer.setScissorTest(false);
  }
  /** The depth buffer is spent on what lies between the camera and the far end of the terrain. */
  #fitDepth() {
    const distance = this.camera.position.distanceTo(this.#middle) + 2 * this.#radius;
    this.camera.near = Math.max(distance / 5000, 1e-3 * this.#radius);
    this.camera.far = 2 * distance;
    this.camera.updateProjectionMatrix();
  }

  setObject(object) {
    if (this.#object) {
      this.#scene.remove(this.#object);
      this.#object.dispose();
    }
    this.#object = object;
    this.globe.isOn = object?.isGlobe ?? false;
    if (object) this.#scene.add(object);
    this.draw();
  }

  /** What the stream was made of, or null: drawn right of the edge. */
  setOriginal(object) {
    if (this.#original) {
      this.#scene.remove(this.#original);
      for (const part of [this.#original.geometry, this.#original.material.map,
        this.#original.material]) part.dispose();
    }
    this.#original = object;
    if (object) this.#scene.add(object);
    this.#stretch();
    this.draw();
  }
  setEdge(share) {
    this.#edge = share;
    this.draw();
  }

  /** What lies under a place of the page, in metres as the mesh has them; null: nothing. */
  pointAt(x, y) {
    if (!this.#object?.frame) return null;
    return (this.globe.isOn ? placeOnGlobe : pointOn)(this.#object, this.camera, x, y);
  }
  /** Turns the camera around what it looks at until north is above. */
  faceNorth() {
    if (this.globe.isOn) return;  // it is there
    const {target} = this.orbit, {x, y, z} = this.camera.position.clone().sub(target);
    this.camera.position.copy(target).add(new Vector3(0, y, Math.hypot(x, z)));
    this.isMoved = true;
    this.orbit.update();
    this.draw();
  }

  /** How many times as high as wide the terrain is. */
  get tallness() {
    if (this.globe.isOn) return 0;
    const size = this.#bounds().getSize(new Vector3());
    return size.y / Math.max(size.x, size.z);
  }
  #bounds() {
    const {geometry} = this.#object;
    geometry.computeBoundingBox();
    return geometry.boundingBox.isEmpty() ? new Box3(new Vector3(-1, 0, -1), new Vector3(1, 0, 1))
      : geometry.boundingBox;
  }
  /** Heights are drawn so many times as large, around the middle one. */
  setExaggeration(times) {
    this.#times = times;
    this.#stretch();
    this.draw();
  }
  #stretch() {
    for (const object of [this.#object, this.#original]) {
      if (!object || object.isGlobe) continue;
      object.scale.y = this.#times;
      object.position.y = this.#middle.y * (1 - this.#times);
      object.updateMatrixWorld();
    }
  }

  /** From the south, above, with all of the terrain in the picture. */
  home() {
    if (!this.#object) return;
    this.isMoved = false;
    if (this.globe.isOn) return this.#globeHome();
    const box = this.#bounds();
    box.getCenter(this.#middle);
    this.#stretch();
    const size = box.getSize(new Vector3());
    this.#radius = Math.max(size.x, size.y * this.#times, size.z) / 2;
    this.orbit.minDistance = this.#radius / 100;
    this.orbit.maxDistance = this.#radius * 12;
    this.#lookAtAll(box);
    this.orbit.update();
    this.draw();
  }
  #globeHome() {
    this.#middle.set(0, 0, 0);
    this.#radius = this.#object.radius;
    this.globe.home(this.#radius, this.free());
    this.draw();
  }
  #lookAtAll(box) {
    const {left, right, top, bottom} = this.free();
    // A tall page shows more of what is seen from further above.
    const steepness = MathUtils.clamp((0.9 * (bottom - top)) / (right - left), 0.62, 1.8);
    const ahead = new Vector3(-0.35, -steepness, -1).normalize();
    const across = new Vector3().crossVectors(ahead, this.camera.up).normalize();
    const pixel = Math.tan(MathUtils.degToRad(this.camera.fov) / 2) / (innerHeight / 2);
    const {offsetX, offsetY} = this.camera.view;
    const window = {
      left: (left - innerWidth / 2 + offsetX) * pixel,
      right: (right - innerWidth / 2 + offsetX) * pixel,
      low: (innerHeight / 2 - offsetY - bottom) * pixel,
      high: (innerHeight / 2 - offsetY - top) * pixel,
    };
    const axes = {ahead, right: across, up: new Vector3().crossVectors(across, ahead)};
    const {matrixWorld, geometry} = this.#object, places = geometry.getAttribute('position');
    const point = new Vector3();
    const place = placeFor(axes, window, (take) => {
      for (let i = 0; i < places.count; ++i) {
        take(point.fromBufferAttribute(places, i).applyMatrix4(matrixWorld));
      }
    });
    if (!isFinite(place.length())) place.copy(this.#middle).addScaledVector(ahead, -box.max.x * 4);
    this.camera.position.copy(place);
    // What orbits turn around lies at the middle height.
    this.orbit.target.copy(place).addScaledVector(ahead, (this.#middle.y - place.y) / ahead.y);
  }

  /** From a place in metres around the middle of the terrain, towards another. */
  look(eye, target) {
    this.camera.position.set(...eye);
    this.orbit.target.set(...target);
    this.orbit.update();
    this.draw();
  }

  /** Without light a texture is seen as it is. */
  setShaded(shaded) {
    this.#ambient.intensity = Math.PI * (shaded ? AMBIENT : 1);
    this.#sun.intensity = Math.PI * (shaded ? SUN : 0);
    this.draw();
  }
  /** Where the sun stands, in degrees: clockwise from north, and above the horizon. */
  setSun(azimuth, elevation) {
    const [turn, rise] = [azimuth, elevation].map(MathUtils.degToRad);
    this.#sunAt.set(
      Math.sin(turn) * Math.cos(rise), Math.sin(rise), -Math.cos(turn) * Math.cos(rise));
    this.draw();
  }
  /** Over a globe the sun goes along with the camera, so that there is light where it looks. */
  #placeSun() {
    this.#sun.position.copy(this.#sunAt);
    if (this.globe.isOn) this.globe.turnOverhead(this.#sun.position);
  }

  setFlying(flying) {
    this.fly.enabled = flying;
    this.orbit.enabled = !flying;
    if (!flying) {
      // Orbits go around what the flight looked at last.
      const ahead = this.camera.getWorldDirection(new Vector3());
      this.orbit.target.copy(this.camera.position).addScaledVector(ahead, this.#radius);
    }
    this.draw();
  }
}
