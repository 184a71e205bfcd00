// SPDX-License-Identifier: Apache-2.0
// Two textures of three.js that take turns: while one is drawn, the other takes the texels of the
// next frame, in the memory of the graphics card that it has.
import {textureOf} from './three_frame.js';

export class Turns {
  #textures = [];

  /** A texture with these texels that is not the one that is `drawn`. */
  next(raster, drawn) {
    const fits = ({image}) => image.width === raster.width && image.height === raster.height;
    if (!this.#textures.every(fits)) this.dispose();
    const free = this.#textures.find((texture) => texture !== drawn);
    if (!free || this.#textures.length < 2) {
      const texture = textureOf(raster);
      this.#textures.push(texture);
      return texture;
    }
    const {data} = raster;
    free.image.data = new Uint8Array(data.buffer, data.byteOffset, data.length);
    free.needsUpdate = true;
    return free;
  }
  /** Whether it takes turns, and so stays when another one is drawn. */
  has(texture) {
    return this.#textures.includes(texture);
  }
  dispose() {
    for (const texture of this.#textures.splice(0)) texture.dispose();
  }
}
