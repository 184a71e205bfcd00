// SPDX-License-Identifier: Apache-2.0
// Cuts tiles out of a stream: heights or texels at a grid of longitudes and latitudes, by the mip
// level that suits their distance, for renderers that ask for tiles.
import {groundScale} from './index.js';
import {GROWTH} from './pace.js';
import {placeOf} from './place.js';

/** The four samples around sample (x, y), with their weights. Beyond the outer ones these count. */
function neighbours(x, y, {width, height}) {
  x = Math.min(Math.max(x, 0), width - 1);
  y = Math.min(Math.max(y, 0), height - 1);
  const left = Math.floor(x), above = Math.floor(y);
  const right = Math.min(left + 1, width - 1), below = Math.min(above + 1, height - 1);
  const u = x - left, v = y - above;
  return {
    indices: [above, below].flatMap((row) => [row * width + left, row * width + right]),
    weights: [(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v],
  };
}

/** Height at a place: of the samples around that are no voids; NaN where all are. */
function heightAt(data, {indices, weights}) {
  let sum = 0, weight = 0;
  indices.forEach((index, i) => {
    if (Number.isNaN(data[index])) return;
    sum += weights[i] * data[index];
    weight += weights[i];
  });
  return sum / weight;
}

function texelAt(data, {indices, weights}) {
  return [0, 1, 2, 3].map((channel) =>
    indices.reduce((sum, index, i) => sum + weights[i] * data[4 * index + channel], 0));
}

/** Tiles of one stream. `terrain`: of open(); `bounds`: as those of placeOf(). */
export class Cutter {
  #terrain;
  #places = {};
  #rasters = new Map();
  #bytes;

  constructor(terrain, bounds) {
    this.#terrain = terrain;
    const {info} = terrain;
    if (info.hasHeights) this.#places.heights = placeOf(info, 'heights', bounds);
    if (info.hasTexture) this.#places.texture = placeOf(info, 'texture', bounds);
    this.#bytes = Math.min(info.streamBytes, terrain.loaded.bytes);
  }
  place(part) {
    return this.#places[part];
  }

  /** The level of a pyramid of tiles where `step` / 2^level degrees are no more than a sample. */
  finest(part, step) {
    const {bounds: [west, , east], width} = this.#places[part];
    return Math.max(0, Math.ceil(Math.log2((step * width) / (east - west))));
  }
  /** Whether a grid and a part have ground in common. */
  reaches(part, longitudes, latitudes) {
    const [west, south, east, north] = this.#places[part].bounds;
    return longitudes.at(-1) >= west && longitudes[0] <= east && latitudes[0] >= south &&
      latitudes.at(-1) <= north;
  }

  /** A raster of the part at a mip level; one decoding for all tiles that need it. */
  #raster(part, level) {
    const key = `${part} ${level}`;
    if (!this.#rasters.has(key)) {
      const isTexture = part === 'texture';
      const options = isTexture
        ? {texture: true, textureLevel: level}
        : {surface: true, surfaceLevel: level, texture: false};
      const promise = this.#terrain
        .decode({bytes: this.#bytes, mesh: false, ...options})
        .then((frame) => (isTexture ? frame.texture : frame.surface));
      promise.catch(() => this.#rasters.delete(key));
      this.#rasters.set(key, promise);
    }
    return this.#rasters.get(key);
  }

  /** Calls put(i, raster, samples around) for the places of a grid that lie on the part. */
  async #each(part, longitudes, latitudes, put) {
    const place = this.#places[part], {info} = this.#terrain;
    const step = (longitudes.at(-1) - longitudes[0]) / (longitudes.length - 1);
    const coarsest = part === 'texture' ? info.textureCoarsestLevel : info.coarsestLevel;
    const level = Math.min(coarsest, this.finest(part, step));
    const raster = await this.#raster(part, level), columns = longitudes.length;
    for (let i = 0; i < columns * latitudes.length; ++i) {
      const [column, row] =
        place.pixels(longitudes[i % columns], latitudes[Math.floor(i / columns)]);
      if (!(column >= 0 && row >= 0 && column <= place.width && row <= place.height)) continue;
      // Sample (x, y) of a mip level lies on sample (x 2^level, y 2^level), not on a cell of them.
      const at = neighbours((column - 0.5) / 2 ** level, (row - 0.5) / 2 ** level, raster);
      put(i, raster.data, at);
    }
  }
  /** Metres at a grid, row by row; NaN in voids and outside. Longitudes grow, latitudes fall. */
  async heights(longitudes, latitudes) {
    const heights = new Float32Array(longitudes.length * latitudes.length).fill(NaN);
    const metres = groundScale(this.#terrain.info).height;
    await this.#each('heights', longitudes, latitudes,
      (i, data, at) => (heights[i] = metres * heightAt(data, at)));
    return heights;
  }
  /** RGBA likewise; transparent outside. */
  async texels(longitudes, latitudes) {
    const rgba = new Uint8ClampedArray(4 * longitudes.length * latitudes.length);
    await this.#each('texture', longitudes, latitudes,
      (i, data, at) => rgba.set(texelAt(data, at), 4 * i));
    return rgba;
  }

  /** Fetches on, GROWTH-fold each time; after each step tiles are those of the longer prefix. */
  async *refine({bytes = Infinity, signal} = {}) {
    const limit = Math.min(bytes, this.#terrain.info.streamBytes);
    while (this.#bytes < limit) {
      const wanted = Math.min(GROWTH * this.#bytes, limit);
      const have = await this.#terrain.load(wanted, {signal});
      this.#bytes = have;
      this.#rasters.clear();
      yield have;
      if (have < wanted) return;
    }
  }
}
