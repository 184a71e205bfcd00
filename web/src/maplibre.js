// SPDX-License-Identifier: Apache-2.0
// MapLibre GL JS: a protocol (addProtocol) that cuts tiles of a map out of a stream, heights as
// raster-dem tiles in the terrarium encoding and texels as raster tiles, and gives them anew after
// each refinement.
import {groundScale, open} from './index.js';
import {TksError} from './error.js';
import {abortable} from './source.js';
import {boundsOf, pixelsOf, projectionOf, transformOfBounds} from './place.js';

const TILE = 256;
const MOST_ZOOM = 22;

/** Longitudes of the columns and latitudes of the rows of a tile, at the middles of its pixels. */
function placesOf({z, x, y}) {
  const places = Array.from({length: TILE}, (_, i) => (i + 0.5) / TILE);
  return {
    longitudes: places.map((place) => ((x + place) / 2 ** z) * 360 - 180),
    latitudes: places.map((place) =>
      (Math.atan(Math.sinh(Math.PI * (1 - (2 * (y + place)) / 2 ** z))) * 180) / Math.PI),
  };
}

/** The four samples around sample (x, y), with their weights. Beyond the outer ones these count. */
function neighbours(x, y, {width, height}) {
  x = Math.min(Math.max(x, 0), width - 1);
  y = Math.min(Math.max(y, 0), height - 1);
  const left = Math.floor(x), above = Math.floor(y);
  const right = Math.min(left + 1, width - 1), below = Math.min(above + 1, height - 1);
  const u = x - left, v = y - above;
  return {
    indices: [above * width + left, above * width + right, below * width + left, below * width + right],
    weights: [(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v],
  };
}

/** RGBA of a height of `metres`: steps of 1/256 m from -32768 m to 32768 m. */
function terrarium(metres) {
  const steps = Math.min(Math.max(Math.round((metres + 32768) * 256), 0), 2 ** 24 - 1);
  return [(steps >> 16) & 255, (steps >> 8) & 255, steps & 255, 255];
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

/** One stream on the map. Made by TksProtocol.add(). */
class TksMapSource {
  #terrain;
  #name;
  #parts = {};
  #frames = new Map();
  #bytes = 0;

  constructor(name, terrain, bounds) {
    this.#name = name;
    this.#terrain = terrain;
    const {info} = terrain;
    if (info.hasHeights) this.#parts.heights = this.#place('heights', bounds);
    if (info.hasTexture) this.#parts.texture = this.#place('texture', bounds);
    this.heights = info.hasHeights ? this.#source('heights') : null;
    this.texture = info.hasTexture ? this.#source('texture') : null;
    this.#bytes = Math.min(info.streamBytes, terrain.loaded.bytes);
  }
  get terrain() {
    return this.#terrain;
  }

  /** Where a part lies. A texture without a place of its own covers the ground of the heights. */
  #place(part, bounds) {
    const {info} = this.#terrain, isTexture = part === 'texture';
    const width = isTexture ? info.textureWidth : info.width;
    const height = isTexture ? info.textureHeight : info.height;
    let transform, projection;
    if (bounds) {
      [transform, projection] = [transformOfBounds(bounds, width, height), projectionOf('EPSG:4326')];
    } else if (isTexture && info.textureHasGeotransform) {
      [transform, projection] = [info.textureGeotransform, projectionOf(info.textureCrs)];
    } else if (info.hasGeotransform) {
      const [x0, a, b, y0, c, d] = info.geotransform;
      const across = info.width / width, down = info.height / height;
      transform = [x0, a * across, b * down, y0, c * across, d * down];
      projection = projectionOf(info.crs);
    } else {
      throw new TksError('unsupported', 'The stream does not say where it lies. Give `bounds`: ' +
        '[west, south, east, north] in degrees.');
    }
    const pixels = pixelsOf(transform, projection);
    return {pixels, width, height, bounds: boundsOf(pixels, width, height)};
  }

  /** The zoom at which a pixel of a tile is no larger than a sample. */
  #zoom({bounds, width}) {
    const [west, , east] = bounds;
    const zoom = Math.ceil(Math.log2((width / (east - west)) * (360 / TILE)));
    return Math.min(MOST_ZOOM, Math.max(0, zoom));
  }
  #source(part) {
    const place = this.#parts[part];
    const source = {
      tiles: [`tks://${this.#name}/${part}/{z}/{x}/{y}`],
      tileSize: TILE,
      bounds: place.bounds,
      maxzoom: this.#zoom(place),
    };
    return part === 'heights'
      ? {type: 'raster-dem', encoding: 'terrarium', ...source}
      : {type: 'raster', ...source};
  }

  /** A raster of the part at a mip level; one decoding for all tiles that need it. */
  #raster(part, level) {
    const key = `${part} ${level}`;
    if (!this.#frames.has(key)) {
      const isTexture = part === 'texture';
      const options = isTexture
        ? {texture: true, textureLevel: level} : {surface: true, surfaceLevel: level, texture: false};
      const promise = this.#terrain
        .decode({bytes: this.#bytes, mesh: false, ...options})
        .then((frame) => (isTexture ? frame.texture : frame.surface));
      promise.catch(() => this.#frames.delete(key));
      this.#frames.set(key, promise);
    }
    return this.#frames.get(key);
  }

  /** RGBA of a tile, or null where the stream does not reach. */
  async render(part, tile) {
    const place = this.#parts[part], {info} = this.#terrain;
    const {longitudes, latitudes} = placesOf(tile);
    const [west, south, east, north] = place.bounds;
    if (longitudes.at(-1) < west || longitudes[0] > east || latitudes[0] < south ||
        latitudes.at(-1) > north) return null;
    const coarsest = part === 'texture' ? info.textureCoarsestLevel : info.coarsestLevel;
    const level = Math.min(coarsest, Math.max(0, this.#zoom(place) - tile.z));
    const raster = await this.#raster(part, level);
    const metres = groundScale(info).height;
    const colourAt = part === 'texture'
      ? (at) => texelAt(raster.data, at)
      : (at) => terrarium(metres * heightAt(raster.data, at) || 0);
    const outside = part === 'texture' ? [0, 0, 0, 0] : terrarium(0);
    const rgba = new Uint8ClampedArray(4 * TILE * TILE);
    for (let i = 0; i < TILE * TILE; ++i) {
      const [column, row] = place.pixels(longitudes[i % TILE], latitudes[Math.floor(i / TILE)]);
      const inside = column >= 0 && row >= 0 && column <= place.width && row <= place.height;
      // Sample (x, y) of a mip level lies on sample (x 2^level, y 2^level), not on a cell of them.
      const at = inside &&
        neighbours((column - 0.5) / 2 ** level, (row - 0.5) / 2 ** level, raster);
      rgba.set(inside ? colourAt(at) : outside, 4 * i);
    }
    return rgba;
  }

  /** Fetches on, fourfold each time, and lets the map take its tiles anew. */
  async refine(map, {bytes = Infinity, signal} = {}) {
    const limit = Math.min(bytes, this.#terrain.info.streamBytes);
    while (this.#bytes < limit) {
      const wanted = Math.min(4 * this.#bytes, limit);
      const have = await this.#terrain.load(wanted, {signal});
      this.#bytes = have;
      this.#frames.clear();
      for (const [id, source] of Object.entries(map.getStyle()?.sources ?? {})) {
        if (source.tiles?.[0].startsWith(`tks://${this.#name}/`)) map.refreshTiles(id);
      }
      if (have < wanted) return;
      await abortable(new Promise((resolve) => map.once('idle', resolve)), signal);
    }
  }

  dispose() {
    this.#frames.clear();
    this.#terrain.dispose();
  }
}

/** Give `protocol.tile` to maplibregl.addProtocol('tks', protocol.tile). */
export class TksProtocol {
  #sources = new Map();

  /** Opens a stream under a name, which is part of the addresses of its tiles. */
  async add(name, input, {bounds, ...options} = {}) {
    if (!/^[\w.-]+$/.test(name) || this.#sources.has(name)) {
      throw new TksError('usage', `"${name}" is taken, or no name of letters, digits and "._-".`);
    }
    const terrain = await open(input, options);
    try {
      const source = new TksMapSource(name, terrain, bounds);
      this.#sources.set(name, source);
      return source;
    } catch (error) {
      terrain.dispose();
      throw error;
    }
  }
  remove(name) {
    this.#sources.get(name)?.dispose();
    this.#sources.delete(name);
  }

  tile = async ({url}, {signal}) => {
    const [, name, part, z, x, y] =
      /^tks:\/\/([^/]+)\/(heights|texture)\/(\d+)\/(\d+)\/(\d+)/.exec(url) ?? [];
    const source = this.#sources.get(name);
    if (!source) throw new TksError('usage', `No stream is added for ${url}.`);
    const tile = {z: Number(z), x: Number(x), y: Number(y)};
    const rgba = await abortable(source.render(part, tile), signal);
    // An empty answer is a tile without content.
    if (!rgba) return {data: new ArrayBuffer(0)};
    // Colour management or premultiplication would change heights.
    return {data: await createImageBitmap(new ImageData(rgba, TILE, TILE),
      {premultiplyAlpha: part === 'texture' ? 'premultiply' : 'none', colorSpaceConversion: 'none'})};
  };
}
