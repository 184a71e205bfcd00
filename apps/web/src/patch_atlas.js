// SPDX-License-Identifier: Apache-2.0
// The texture of an object, whose patches lie one below the other in its stream, as a picture for
// meshes: the patches in rows and columns, each with a gutter of one texel around it that repeats
// its border. So renderers that take means of neighbouring texels find none of another patch. It is
// laid out as `tetrakis decode` does it (apps/tools/report/patch_atlas.hpp).

/** A weight of a texel of every second one: those beside the border are met along it alone, so that
 * patches go on sharing the texels of their sides. */
const weightsAt = (place, last) =>
  (place === 0 || place === last ? [[0, 4]] : [[-1, 1], [0, 2], [1, 1]]);

/** RGBA of patches with every second texel a side, as means of those around. */
function halved(data, patches, side) {
  const half = (side + 1) / 2, out = new Uint8ClampedArray(4 * half * half * patches);
  let to = 0;
  for (let i = 0; i < patches * half; ++i) {
    const patch = Math.floor(i / half), y = 2 * (i % half), rows = weightsAt(y, side - 1);
    for (let x = 0; x < side; x += 2) {
      const columns = weightsAt(x, side - 1);
      for (let channel = 0; channel < 4; ++channel) {
        let sum = 0;
        for (const [down, weight] of rows) {
          const row = 4 * ((patch * side + y + down) * side + x) + channel;
          for (const [across, share] of columns) sum += weight * share * data[row + 4 * across];
        }
        out[to++] = sum / 16;
      }
    }
  }
  return out;
}

const GUTTER = 1;

export class PatchAtlas {
  /** `level`: how often every second texel of a side is left out; side: of the patches as they are,
   * 2^depth + 1. */
  constructor(patches, side, level = 0) {
    this.patches = patches;
    this.level = level;
    this.whole = side;
    this.side = (side - 1) / 2 ** level + 1;
    this.columns = Math.ceil(Math.sqrt(patches));
    this.rows = Math.ceil(patches / this.columns);
  }
  /** That of a texture with `width` texels a side, at the first level, if there is one, at which it
   * has at most so many texels a side. */
  static within(texels, patches, side) {
    for (let level = 0; ; ++level) {
      const atlas = new PatchAtlas(patches, side, level);
      if (atlas.side <= 2 || Math.max(atlas.width, atlas.height) <= texels) return atlas;
    }
  }

  get cell() {
    return this.side + 2 * GUTTER;
  }
  get width() {
    return this.columns * this.cell;
  }
  get height() {
    return this.rows * this.cell;
  }

  /** Where a place of a patch lies on the picture, from (0, 0) to (1, 1) across it. x, y: from 0,
   * the middle of the first texel of the patch, to 1, that of the last one. */
  at(patch, x, y) {
    const across = (place, part, whole) =>  // over the gutter to the middle of the first texel
      (place * this.cell + GUTTER + 0.5 + part * (this.side - 1)) / whole;
    return [
      across(patch % this.columns, x, this.width),
      across(Math.floor(patch / this.columns), y, this.height),
    ];
  }

  /** Of RGBA of the raster, as `texture` of a frame. Places behind the last patch show it again. */
  pictureOf(raster) {
    let data = raster;
    for (let side = this.whole; side > this.side; side = (side + 1) / 2)
      data = halved(data, this.patches, side);
    const texels = new Uint32Array(data.buffer, data.byteOffset, data.length / 4);
    const picture = new Uint32Array(this.width * this.height);
    for (let place = 0; place < this.columns * this.rows; ++place)
      this.#put(picture, place, texels, Math.min(place, this.patches - 1));
    const {level, width, height} = this, rgba = new Uint8ClampedArray(picture.buffer);
    return {level, width, height, gutter: GUTTER, data: rgba};
  }
  #put(picture, place, texels, patch) {
    const {side, cell, width} = this, left = (place % this.columns) * cell;
    const top = Math.floor(place / this.columns) * cell;
    for (let y = 0; y < cell; ++y) {
      const row = Math.min(Math.max(y - GUTTER, 0), side - 1);
      const from = (patch * side + row) * side, to = (top + y) * width + left;
      picture.fill(texels[from], to, to + GUTTER);
      picture.set(texels.subarray(from, from + side), to + GUTTER);
      picture.fill(texels[from + side - 1], to + GUTTER + side, to + cell);
    }
  }
}
