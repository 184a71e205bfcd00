// SPDX-License-Identifier: Apache-2.0
// What the pages of bench/web_arrival have in common: one view, the times of pictures, their PSNR.
import {
  LinearFilter, LinearMipmapLinearFilter, MeshBasicMaterial, PerspectiveCamera, Scene,
  SRGBColorSpace, WebGLRenderer,
} from 'three';

export const query = Object.fromEntries(new URLSearchParams(location.search));
const [WIDTH, HEIGHT] = [960, 540];

/** Unlit: pictures of the ground hold the light of their day. */
export function material(texture) {
  if (texture) {
    texture.colorSpace = SRGBColorSpace;
    texture.anisotropy = 8;
    texture.generateMipmaps = true;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.magFilter = LinearFilter;
  }
  return new MeshBasicMaterial(texture ? {map: texture} : {});
}

export class Picture {
  scene = new Scene();
  #renderer = new WebGLRenderer({alpha: true, antialias: false, preserveDrawingBuffer: true});
  #camera = new PerspectiveCamera(40, WIDTH / HEIGHT, 1, 1e7);
  #object = null;

  /** From the south, above, with all of the ground, whose sides are in metres, in the picture. */
  constructor() {
    const [across, down, middle] = query.ground.split(',').map(Number);
    this.#renderer.setSize(WIDTH, HEIGHT);
    this.#renderer.setClearColor(0, 0);
    this.#renderer.localClippingEnabled = true;
    document.body.append(this.#renderer.domElement);
    const distance = 0.75 * across + 0.6 * down;
    this.#camera.position.set(0, middle + 0.6 * distance, 0.8 * distance);
    this.#camera.near = distance / 100;
    this.#camera.far = 10 * distance;
    this.#camera.lookAt(0, middle, 0);
    this.#camera.updateProjectionMatrix();
  }
  set object(object) {
    if (this.#object) this.scene.remove(this.#object);
    this.scene.add((this.#object = object));
  }
  /** RGBA of what is drawn now. */
  pixels() {
    this.#renderer.render(this.scene, this.#camera);
    const gl = this.#renderer.getContext(), data = new Uint8Array(4 * WIDTH * HEIGHT);
    gl.readPixels(0, 0, WIDTH, HEIGHT, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return data;
  }
  /** Draws, and waits until that is done. */
  async draw() {
    this.#renderer.render(this.scene, this.#camera);
    const gl = this.#renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}

/** dB between pictures where alpha of the second is not 0. */
function psnr(got, wanted) {
  let squares = 0, count = 0;
  for (let i = 0; i < wanted.length; i += 4) {
    if (wanted[i + 3] === 0) continue;
    for (let k = 0; k < 3; ++k) squares += (got[i + k] - wanted[i + k]) ** 2;
    count += 3;
  }
  return 10 * Math.log10((255 ** 2 * count) / squares);
}

/**
 * Draws what `arrive()` yields, {bytes, rounds of requests, show}, as it comes; then again, for the
 * PSNR of each against query.judge. Leaves [{ms, bytes, rounds, dB}] in window.marks.
 */
export async function measure(arrive) {
  try {
    const arriving = arrive(), first = arriving.next();  // asked for before a context is made
    first.catch(() => {});
    const picture = new Picture(), marks = [];
    for (let next = await first; !next.done; next = await arriving.next()) {
      const {bytes, rounds, show} = next.value;
      picture.object = await show();
      await picture.draw();
      marks.push({ms: performance.now(), bytes, rounds, show});
    }
    if (query.judge) {
      const judge = new Uint8Array(await (await fetch(query.judge)).arrayBuffer());
      for (const mark of marks) {
        picture.object = await mark.show();
        mark.dB = psnr(picture.pixels(), judge);
      }
    }
    window.marks = marks.map(({show, ...mark}) => mark);
  } catch (error) {
    window.failure = String(error.stack ?? error);
  }
  document.body.dataset.state = 'done';
}
