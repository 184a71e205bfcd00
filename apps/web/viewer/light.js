// SPDX-License-Identifier: Apache-2.0
// The light of the scene: a sun, and what comes from all around.
import {AmbientLight, DirectionalLight, MathUtils, Vector3} from 'three';

/** Shares of the light: together they show white as white, and no more. */
const AMBIENT = 0.45, SUN = 1 - AMBIENT;

export class Light {
  #ambient = new AmbientLight(0xffffff);
  #sun = new DirectionalLight(0xffffff);
  #at = new Vector3();  // as on a map that is looked down on

  constructor(scene) {
    scene.add(this.#ambient, this.#sun);
    this.setShaded(true);
  }
  /** Without light a texture is seen as it is. */
  setShaded(shaded) {
    this.#ambient.intensity = Math.PI * (shaded ? AMBIENT : 1);
    this.#sun.intensity = Math.PI * (shaded ? SUN : 0);
  }
  /** Where the sun stands, in degrees: clockwise from north, and above the horizon. */
  setSun(azimuth, elevation) {
    const [turn, rise] = [azimuth, elevation].map(MathUtils.degToRad);
    this.#at.set(
      Math.sin(turn) * Math.cos(rise), Math.sin(rise), -Math.cos(turn) * Math.cos(rise));
  }
  /** Round a globe or an object the sun goes along with `camera`, so that there is light where it
   * looks; null: it stays. */
  place(camera) {
    this.#sun.position.copy(this.#at);
    if (!camera) return;
    // From x to the east, y up and z to the south of what the camera looks down on.
    const {x, y, z} = this.#at;
    this.#sun.position.set(x, -z, y).applyQuaternion(camera.quaternion);
  }
}
