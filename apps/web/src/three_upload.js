// SPDX-License-Identifier: Apache-2.0
// Brings a large texture to the graphics card in slices, one for each picture that is drawn, so
// that none of them waits for all of it.

/** Bytes of a slice, which take a few milliseconds, and of a texture that is worth several. */
const SLICE = 2 ** 21, LARGE = 2 ** 22;

/** Whether a renderer of three.js can take slices of this texture, and it is large enough. */
export function isSliced(texture, renderer) {
  const canTake = renderer?.isWebGLRenderer && texture.addUpdateRange &&
    'mipmapsAutoUpdate' in texture;
  return Boolean(canTake) && texture.image.data.length > LARGE;
}

export class Upload {
  #row = -1;  // the next one; -1: there is no memory yet

  /** `show` is called behind the last slice. */
  constructor(texture, show) {
    this.texture = texture;
    this.show = show;
  }
  /** Brings one slice more. */
  step(renderer) {
    const {texture} = this, {width, height} = texture.image;
    if (this.#row < 0) {
      texture.source.dataReady = texture.mipmapsAutoUpdate = false;  // not at each slice
      renderer.initTexture(texture);
      texture.source.dataReady = true;
      this.#row = 0;
      return;
    }
    const end = Math.min(height, this.#row + Math.ceil(SLICE / (4 * width)));
    // three.js takes what lies in one row.
    for (let row = this.#row; row < end; ++row) texture.addUpdateRange(4 * width * row, 4 * width);
    texture.needsUpdate = true;
    renderer.initTexture(texture);
    this.#row = end;
    if (end < height) return;
    if (texture.generateMipmaps) this.#makeMipmaps(renderer, renderer.getContext());
    this.show();
  }
  #makeMipmaps({properties, state}, gl) {
    state.bindTexture(gl.TEXTURE_2D, properties.get(this.texture).__webglTexture);
    gl.generateMipmap(gl.TEXTURE_2D);
    state.unbindTexture();
  }
}
