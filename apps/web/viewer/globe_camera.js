// SPDX-License-Identifier: Apache-2.0
// The camera of a globe: it goes round the centre, and stays above the ground.
import {MathUtils, Vector3} from 'three';

import {wayRound} from './journey.js';

/** What an orbit may do, flat and round. */
const FLAT = {
  maxPolarAngle: 1.53, enablePan: true, zoomToCursor: true, rotateSpeed: 1, zoomSpeed: 1,
};
const ROUND = {maxPolarAngle: Math.PI, enablePan: false, zoomToCursor: false};
/** Radii from the centre: just above the highest ground, and where the globe is small. */
const NEAREST = 1.003, FARTHEST = 12;
/** From where home looks: longitude and latitude. */
const HOME = [15, 20].map(MathUtils.degToRad);
/** What a visit leaves of the way to the ground, and how far above it, in radii, it ends. */
const NEARER = 0.4, NEAR = 0.05;
/** Of what is free that the globe fills. */
const SHARE = 0.92;

export class GlobeCamera {
  #camera;
  #orbit;
  #isOn = false;
  #radius = 1;

  constructor(camera, orbit) {
    this.#camera = camera;
    this.#orbit = orbit;
    orbit.addEventListener('change', () => this.#fitSpeed());
  }

  get isOn() {
    return this.#isOn;
  }
  set isOn(isOn) {
    this.#isOn = isOn;
    Object.assign(this.#orbit, isOn ? ROUND : FLAT);
  }

  /** All of a globe, within {left, right, top, bottom} of the page. */
  home(radius, {left, right, top, bottom}) {
    this.keepAbove(radius);
    const {fov} = this.#camera, share = Math.min(right - left, bottom - top) / innerHeight;
    const half = Math.atan(SHARE * share * Math.tan(MathUtils.degToRad(fov) / 2));
    const [longitude, latitude] = HOME;
    this.#camera.position.set(Math.cos(longitude) * Math.cos(latitude), Math.sin(latitude),
      -Math.sin(longitude) * Math.cos(latitude)).multiplyScalar(radius / Math.sin(half));
    this.#orbit.target.set(0, 0, 0);
    this.#orbit.update();
  }
  /** To what lies below a point: nearer, but not so near that the globe is out of sight. */
  wayTo({x, y, z}) {
    const from = this.#camera.position, above = from.length() / this.#radius - 1;
    const away = 1 + Math.min(above, Math.max(above * NEARER, NEAR));
    const to = new Vector3(x, y, z).setLength(away * this.#radius);
    return wayRound(from.clone(), to, this.#radius);
  }
  /** The radius of the highest ground. */
  keepAbove(radius) {
    this.#radius = radius;
    this.#orbit.minDistance = NEAREST * radius;
    this.#orbit.maxDistance = FARTHEST * radius;
  }
  /** The nearer the ground, the less a drag turns and a step of the wheel comes nearer. */
  #fitSpeed() {
    if (!this.#isOn) return;
    const above = this.#camera.position.length() / this.#radius - 1;
    this.#orbit.rotateSpeed = MathUtils.clamp(above / 1.5, 0.005, 1);
    this.#orbit.zoomSpeed = MathUtils.clamp(above, 0.02, 1);
  }

  /** The point of the ground below, about. */
  get below() {
    return this.#camera.position.clone().setLength(this.#radius);
  }
}
