// SPDX-License-Identifier: Apache-2.0
// Cuts tiles out of a stream: heights or texels at a grid of longitudes and latitudes, by the mip
// level that suits their distance, for renderers that ask for tiles.
import {Columns} from './columns.js';
import {filled} from './fill.js';
import {groundScale} from './index.js';
import {GROWTH} from './pace.js';
import {checkGround, placeOf, turnsTo} from './place.js';
import {Scan} from './scan.js';

/** Of columns and rows that are interpolated, in samples. */
const TOLERANCE = 0.02;

/** Height between two columns, at row y: of the samples around that are no voids; NaN where all
 * are. */
function heightAt({data, width, height}, {left, right, share: u}, y) {
  const above = Math.floor(y), v = y - above, across = right - left;
  const i = above * width + left, j = above + 1 < height ? i + width : i;
  let sum = 0, weight = 0;
  const nw = data[i], ne = data[i + across], sw = data[j], se = data[j + across];
  if (nw === nw) [sum, weight] = [(1 - u) * (1 - v) * nw, (1 - u) * (1 - v)];
  if (ne === ne) sum += u * (1 - v) * ne, weight += u * (1 - v);
  if (sw === sw) sum += (1 - u) * v * sw, weight += (1 - u) * v;
  if (se === se) sum += u * v * se, weight += u * v;
  return sum / weight;
}

/** Writes the four channels there to out[at] and on. */
function putTexel({data, width, height}, {left, right, share: u}, y, out, at) {
  const above = Math.floor(y), v = y - above, across = 4 * (right - left);
  const i = 4 * (above * width + left);
  const j = above + 1 < height ? i + 4 * width : i;
  for (let c = 0; c < 4; ++c) {
    out[at + c] = (1 - v) * ((1 - u) * data[i + c] + u * data[i + across + c]) +
      v * ((1 - u) * data[j + c] + u * data[j + across + c]);
  }
}

const within = (value, least, most) => Math.min(Math.max(value, least), most);

/** How far behind its bounds, which are those of some places on its border, a part may reach. */
const MARGIN = 0.01;

/** Calls put(i, column, row) for the places of a grid that lie on a part, or near it. */
function scanPlace({bounds, pixels}, {longitudes, latitudes}, tolerance, put) {
  const [west, south, east, north] = bounds;
  const across = MARGIN * (east - west), along = MARGIN * (north - south);
  for (const turn of turnsTo(bounds, longitudes)) {
    const scan = new Scan(pixels, longitudes.map((l) => l + turn), tolerance, put);
    latitudes.forEach((latitude, j) => {
      if (latitude < south - along || latitude > north + along) return;
      scan.row(latitude, j * longitudes.length, west - across, east + across);
    });
  }
}

/** Indices [from, to) of runs of numbers that do not fall. */
function risingRuns(numbers) {
  const falls = numbers.flatMap((number, i) => (i > 0 && number < numbers[i - 1] ? [i] : []));
  return [0, ...falls].map((from, i) => [from, falls[i] ?? numbers.length]);
}

/** The same for all places of a grid: those beside the part count as the nearest of its bounds. */
function scanAll({bounds, pixels}, {longitudes, latitudes}, tolerance, put) {
  const [west, south, east, north] = bounds, middle = (west + east) / 2;
  const nearest = longitudes.map((longitude) =>
    within(longitude - 360 * Math.round((longitude - middle) / 360), west, east));
  for (const [from, to] of risingRuns(nearest)) {
    const scan = new Scan(pixels, nearest.slice(from, to), tolerance, put);
    latitudes.forEach((latitude, j) =>
      scan.row(within(latitude, south, north), j * longitudes.length + from, west, east));
  }
}

/** Tiles of one stream. `terrain`: of open(); `given`: as placeOf() takes it. */
export class Cutter {
  #terrain;
  #places = {};
  #rasters = new Map();
  #bytes;

  constructor(terrain, given) {
    this.#terrain = terrain;
    const {info} = terrain;
    checkGround(info);
    if (info.hasHeights) this.#places.heights = placeOf(info, 'heights', given);
    if (info.hasTexture) this.#places.texture = placeOf(info, 'texture', given);
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
    const {bounds} = this.#places[part], [, south, , north] = bounds;
    return turnsTo(bounds, longitudes).length > 0 && latitudes[0] >= south &&
      latitudes.at(-1) <= north;
  }

  /** A raster of the part at a mip level; one decoding for all tiles that need it. `around`: its
   * voids have the height of what lies nearest. */
  #raster(part, level, around) {
    const key = `${part} ${level} ${around}`;
    if (!this.#rasters.has(key)) {
      const promise = around ? this.#raster(part, level, false).then(filled)
        : this.#decoded(part, level);
      promise.catch(() => this.#rasters.delete(key));
      this.#rasters.set(key, promise);
    }
    return this.#rasters.get(key);
  }
  async #decoded(part, level) {
    const isTexture = part === 'texture';
    const options = isTexture
      ? {texture: true, textureLevel: level}
      : {surface: true, surfaceLevel: level, texture: false};
    const frame = await this.#terrain.decode({bytes: this.#bytes, mesh: false, ...options});
    return isTexture ? frame.texture : frame.surface;
  }

  /** Calls put(i, raster, columns, y), between two columns at row y of a mip level, for places on
   * the part; `around`: for those beside it as well, at its border. */
  async #each(part, {longitudes, latitudes, around = false}, put) {
    const {info} = this.#terrain, place = this.#places[part];
    const step = (longitudes.at(-1) - longitudes[0]) / (longitudes.length - 1);
    const coarsest = part === 'texture' ? info.textureCoarsestLevel : info.coarsestLevel;
    const level = Math.min(coarsest, this.finest(part, step)), side = 2 ** level;
    const raster = await this.#raster(part, level, around);
    const columns = new Columns(raster.width, place.goesRound ? place.width / side : 0);
    const isOn = (column, row) => row >= 0 && row <= place.height &&
      (place.goesRound || (column >= 0 && column <= place.width));
    // Sample (x, y) of a mip level lies on sample (x 2^level, y 2^level), not on a cell of them.
    const putPlace = (i, column, row) => {
      if (around ? !isFinite(column + row) : !isOn(column, row)) return;
      columns.find((column - 0.5) / side);
      put(i, raster, columns, within((row - 0.5) / side, 0, raster.height - 1));
    };
    const scan = around ? scanAll : scanPlace;
    scan(place, {longitudes, latitudes}, TOLERANCE * side, putPlace);
  }
  /** Metres at a grid, row by row. Longitudes grow, latitudes fall. In voids and outside NaN, or,
   * `around`, those of the nearest ground. */
  async heights(longitudes, latitudes, around = false) {
    const heights = new Float32Array(longitudes.length * latitudes.length).fill(NaN);
    const metres = groundScale(this.#terrain.info).height;
    await this.#each('heights', {longitudes, latitudes, around},
      (i, raster, columns, y) => (heights[i] = metres * heightAt(raster, columns, y)));
    return heights;
  }
  /** RGBA likewise; transparent outside. */
  async texels(longitudes, latitudes) {
    const rgba = new Uint8ClampedArray(4 * longitudes.length * latitudes.length);
    await this.#each('texture', {longitudes, latitudes},
      (i, raster, columns, y) => putTexel(raster, columns, y, rgba, 4 * i));
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
