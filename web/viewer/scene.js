// SPDX-License-Identifier: Apache-2.0
// What is drawn and from where: light, camera, and the two ways to move it. Pictures are drawn
// when something has changed, not all the time.
import {
  AmbientLight, Box3, DirectionalLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {Fly} from './fly.js';

const REST = 150;  // ms

export class Picture {
  #scene = new Scene();
  #ambient = new AmbientLight(0xffffff);
  #sun = new DirectionalLight(0xfff4e0);
  #object = null;
  #pending = false;
  #last = 0;
  #radius = 1;
  #resting = 0;
  /** Called when the camera has moved and rests. */
  onrest = () => {};

  constructor(canvas) {
    this.renderer = new WebGLRenderer({canvas, antialias: true, alpha: true});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.camera = new PerspectiveCamera(45, 1, 1, 1e7);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = true;
    this.orbit.dampingFactor = 0.12;
    this.orbit.maxPolarAngle = 1.53;
    this.orbit.addEventListener('change', () => this.#moved());
    this.fly = new Fly(this.camera, canvas, () => this.#moved());
    this.#scene.add(this.#ambient, this.#sun);
    this.setShaded(true);
    canvas.addEventListener('webglcontextrestored', () => this.draw());
    addEventListener('resize', () => this.#resize());
    this.#resize();
  }

  #resize() {
    this.renderer.setSize(innerWidth, innerHeight, false);
    this.camera.aspect = innerWidth / innerHeight;
    // The middle of the picture is that of what the panel leaves free.
    const [right, down] = innerWidth > 640 ? [150, 0] : [0, 40];
    this.camera.setViewOffset(innerWidth, innerHeight, right, down, innerWidth, innerHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Rows of the picture. */
  get pixels() {
    return this.renderer.domElement.height;
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
      this.#fitDepth();
      this.renderer.render(this.#scene, this.camera);
      if (moving) this.#moved();
    });
  }
  /** The depth buffer is spent on what lies between the camera and the far end of the terrain. */
  #fitDepth() {
    const distance = this.camera.position.length() + 2 * this.#radius;
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
    if (object) this.#scene.add(object);
    this.draw();
  }

  /** From the south, above, with all of the terrain in the picture. */
  home() {
    this.#object.updateMatrixWorld();
    const box = new Box3().setFromObject(this.#object), size = box.getSize(new Vector3());
    const middle = box.getCenter(new Vector3());
    this.#radius = Math.max(size.x, size.z) / 2;
    // In a narrow picture the width decides, in a wide one the height.
    const narrow = Math.max(1, 1.5 / this.camera.aspect);
    const away = 2.25 * this.#radius * narrow;
    this.camera.position.set(middle.x + 0.35 * away, middle.y + 0.62 * away, middle.z + away);
    this.orbit.target.copy(middle);
    this.orbit.minDistance = this.#radius / 100;
    this.orbit.maxDistance = this.#radius * 12;
    this.camera.lookAt(middle);
    this.#sun.position.set(-1, 1.1, -0.7).multiplyScalar(this.#radius);
    this.orbit.update();
    this.draw();
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
    this.#ambient.intensity = Math.PI * (shaded ? 0.7 : 1);
    this.#sun.intensity = Math.PI * (shaded ? 0.7 : 0);
    this.draw();
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
