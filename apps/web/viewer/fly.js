// SPDX-License-Identifier: Apache-2.0
// Flying: a drag turns the head, W A S D and the arrows go, Q and E sink and rise, Shift hurries;
// on a screen that is touched a second finger goes ahead.
import {Euler, Vector3} from 'three';

const TURN = 0.0028;  // radians for a pixel
const KEYS = {
  KeyW: [0, 0, -1], ArrowUp: [0, 0, -1], KeyS: [0, 0, 1], ArrowDown: [0, 0, 1],
  KeyA: [-1, 0, 0], ArrowLeft: [-1, 0, 0], KeyD: [1, 0, 0], ArrowRight: [1, 0, 0],
  KeyQ: [0, -1, 0], KeyE: [0, 1, 0],
};

export class Fly {
  enabled = false;
  #held = new Set();
  #fingers = new Map();
  #way = new Vector3();
  #angles = new Euler(0, 0, 0, 'YXZ');

  /** `changed` is called when the camera has to move. */
  constructor(camera, canvas, changed) {
    this.camera = camera;
    addEventListener('keydown', (event) => {
      if (!this.enabled || !(event.code in KEYS || event.key === 'Shift')) return;
      if (event.target.tagName === 'INPUT' && event.target.type !== 'checkbox') return;
      this.#held.add(event.key === 'Shift' ? 'Shift' : event.code);
      event.preventDefault();
      changed();
    });
    addEventListener('keyup', (event) =>
      this.#held.delete(event.key === 'Shift' ? 'Shift' : event.code));
    addEventListener('blur', () => this.#held.clear());
    canvas.addEventListener('pointerdown', (event) => {
      this.#fingers.set(event.pointerId, event);
      changed();
    });
    for (const name of ['pointerup', 'pointercancel']) {
      addEventListener(name, (event) => this.#fingers.delete(event.pointerId));
    }
    addEventListener('pointermove', (event) => {
      const before = this.#fingers.get(event.pointerId);
      if (!before) return;
      this.#fingers.set(event.pointerId, event);
      if (!this.enabled) return;
      this.#angles.setFromQuaternion(camera.quaternion);
      this.#angles.y += (event.clientX - before.clientX) * TURN;
      this.#angles.x += (event.clientY - before.clientY) * TURN;
      this.#angles.x = Math.min(1.5, Math.max(-1.5, this.#angles.x));
      this.#angles.z = 0;
      camera.quaternion.setFromEuler(this.#angles);
      changed();
    });
  }

  /** Moves on by `seconds` at `speed` metres a second. Whether there is more to do. */
  update(seconds, speed) {
    if (!this.enabled) return false;
    this.#way.set(0, 0, this.#fingers.size > 1 ? -1 : 0);
    for (const code of this.#held) {
      if (code in KEYS) this.#way.add(new Vector3(...KEYS[code]));
    }
    if (this.#way.lengthSq() === 0) return false;
    const hurry = this.#held.has('Shift') ? 4 : 1;
    this.#way.normalize().multiplyScalar(speed * seconds * hurry);
    this.#way.applyQuaternion(this.camera.quaternion);
    this.camera.position.add(this.#way);
    return true;
  }
}
