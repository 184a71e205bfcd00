// SPDX-License-Identifier: Apache-2.0
// What is drawn and from where: light, camera, and the two ways to move it. Pictures are drawn
// when something has changed, not all the time.
import {
  Box3, MathUtils, PMREMGenerator, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {RoomEnvironment} from 'three/addons/environments/RoomEnvironment.js';

import {Fly} from './fly.js';
import {GlobeCamera} from './globe_camera.js';
import {placeOnGlobe} from './globe_pointer.js';
import {lookAtAll} from './home.js';
import {Journey, wayAcross} from './journey.js';
import {moveByKey} from './keys.js';
import {Light} from './light.js';
import {orbitFor} from './object_view.js';
import {NARROW} from './page.js';
import {pointOn} from './ray.js';

const REST = 150;  // ms
/** Of what is around an object, beside the sun. */
const ROOM_LIGHT = 0.35;
const PANEL_SHIFT = 150;  // pixels, by which a panel beside the terrain moves its middle

export class Picture {
  #scene = new Scene();
  #object = null;
  #original = null;
  #edge = 0.5;  // of the picture's width, left of which the stream is drawn
  #room = null;  // what mirrors show
  #pending = false;
  #last = 0;
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
    this.orbit.addEventListener('start', () => {
      this.isMoved = true;
      this.journey.end();
    });
    this.fly = new Fly(this.camera, canvas, () => {
      this.isMoved ||= this.fly.enabled;
      this.#moved();
    });
    this.globe = new GlobeCamera(this.camera, this.orbit);
    this.light = new Light(this.#scene);
    this.journey = new Journey(this.camera, this.orbit);
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
    else if (!this.fly.enabled && moveByKey(event.key, this.orbit)) {
      this.isMoved = true;
      this.journey.end();
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
      const travelling = this.journey.step(now);
      if (!this.fly.enabled) this.orbit.update();
      const {isGlobe, isObject} = this.#object ?? {}, gliding = this.#object?.glide();
      this.#fitDepth();
      this.light.place(isGlobe || isObject ? this.camera : null);
      this.#render();
      this.ondraw();
      if (moving) this.#moved();
      else if (gliding || travelling) this.draw();
    });
  }
  /** The stream, and right of the edge its original. */
  #render() {
    const {renderer} = this;
    this.#scene.environment = this.#object?.mirrors ? this.#roomAround() : null;
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
    this.journey.end();
    this.globe.isOn = object?.isGlobe ?? false;
    Object.assign(this.orbit, orbitFor(object));
    if (object) this.#scene.add(object);
    this.draw();
  }

  #roomAround() {
    this.#scene.environmentIntensity = ROOM_LIGHT;
    this.#room ??= new PMREMGenerator(this.renderer).fromScene(new RoomEnvironment()).texture;
    return this.#room;
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
    if (this.#object.isObject) return this.#object.pointAt(this.camera, x, y);
    return (this.globe.isOn ? placeOnGlobe : pointOn)(this.#object, this.camera, x, y);
  }
  /** Turns the camera around what it looks at until north is above. */
  faceNorth() {
    if (this.globe.isOn) return;  // it is there
    this.journey.end();
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

  /** From the south, above, with all of the terrain in the picture, or from before an object. */
  home() {
    if (!this.#object) return;
    this.isMoved = false;
    this.journey.end();
    if (this.globe.isOn) return this.#globeHome();
    const box = this.#bounds();
    box.getCenter(this.#middle);
    this.#stretch();
    const size = box.getSize(new Vector3());
    this.#radius = Math.max(size.x, size.y * this.#times, size.z) / 2;
    this.orbit.minDistance = this.#radius / 100;
    this.orbit.maxDistance = this.#radius * 12;
    lookAtAll(this, this.#object, {middle: this.#middle, far: box.max.x * 4});
    this.orbit.update();
    this.draw();
  }
  #globeHome() {
    this.#middle.set(0, 0, 0);
    this.#radius = this.#object.radius;
    this.globe.home(this.#radius, this.free());
    this.draw();
  }
  /** Glides to a point of the ground in the coordinates of the object, of a globe above it;
   * `isStill`: is there at once. */
  visit(point, isStill) {
    this.isMoved = true;
    this.journey.begin(this.globe.isOn ? this.globe.wayTo(point)
      : this.#wayTo(this.#object.localToWorld(new Vector3(point.x, point.y, point.z))),
    isStill ? 0 : undefined);
    this.draw();
  }
  /** Half as far from another point of the ground, in the same direction. */
  #wayTo(target) {
    const {position: eye} = this.camera, {target: from, minDistance} = this.orbit;
    const away = eye.clone().sub(from), distance = Math.max(away.length() / 2, minDistance);
    return wayAcross({eye: eye.clone(), target: from.clone()},
      {eye: away.setLength(distance).add(target), target});
  }
  /** From a place in metres around the middle of the terrain, towards another. */
  look(eye, target) {
    this.journey.end();
    this.camera.position.set(...eye);
    this.orbit.target.set(...target);
    this.orbit.update();
    this.draw();
  }

  setShaded(shaded) {
    this.light.setShaded(shaded);
    this.draw();
  }
  setSun(azimuth, elevation) {
    this.light.setSun(azimuth, elevation);
    this.draw();
  }

  setFlying(flying) {
    this.journey.end();
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
