// SPDX-License-Identifier: Apache-2.0
// MapLibre GL JS: a protocol (addProtocol) that cuts tiles of a map out of a stream, heights as
// raster-dem tiles in the terrarium encoding and texels as raster tiles, and gives them anew after
// each refinement.
import {abortable} from './abort.js';
import {Cutter} from './cut.js';
import {TksError} from './error.js';
import {open} from './index.js';
import {boxOf} from './place.js';

export {TksError};

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

/** RGBA of heights in metres: steps of 1/256 m from -32768 m to 32768 m. NaN is 0. */
function terrarium(heights) {
  const rgba = new Uint8ClampedArray(4 * heights.length);
  for (let i = 0; i < heights.length; ++i) {
    const above = ((heights[i] || 0) + 32768) * 256;
    const steps = Math.min(Math.max(Math.round(above), 0), 2 ** 24 - 1);
    rgba[4 * i] = steps >> 16;
    rgba[4 * i + 1] = (steps >> 8) & 255;
    rgba[4 * i + 2] = steps & 255;
    rgba[4 * i + 3] = 255;
  }
  return rgba;
}

/** Milliseconds by which most maps have drawn; what they lack then may never come. */
const PATIENCE = 5000;
const IS_WAITING = 'Tetrakis: the map has not drawn all that it has for 5 s. If it shows ' +
  'nothing, its own worker may be missing: give its address to setWorkerUrl() of MapLibre.';

/** Resolves when the map has drawn all that it has, in a picture that nothing else may bring;
 * false: it takes long. */
function drawn(map) {
  return new Promise((resolve) => {
    const end = (isIdle) => {
      clearTimeout(timer);
      map.off('idle', heard);
      resolve(isIdle);
    };
    const heard = () => end(true), timer = setTimeout(end, PATIENCE, false);
    map.once('idle', heard);
    map.triggerRepaint();
  });
}

/** One stream on the map. Made by TksProtocol.add(). */
class TksMapSource {
  #terrain;
  #name;
  #cutter;

  constructor(name, terrain, given) {
    this.#name = name;
    this.#terrain = terrain;
    this.#cutter = new Cutter(terrain, given);
    this.heights = terrain.info.hasHeights ? this.#source('heights') : null;
    this.texture = terrain.info.hasTexture ? this.#source('texture') : null;
  }
  get terrain() {
    return this.#terrain;
  }
  /** West, south, east and north. */
  get bounds() {
    return boxOf((this.#cutter.place('heights') ?? this.#cutter.place('texture')).bounds);
  }

  #source(part) {
    const source = {
      tiles: [`tks://${this.#name}/${part}/{z}/{x}/{y}`],
      tileSize: TILE,
      // Where a pixel of a tile is no larger than a sample.
      maxzoom: Math.min(MOST_ZOOM, this.#cutter.finest(part, 360 / TILE)),
    };
    // Tiles of heights are everywhere: where a map has none, its ground falls to 0.
    return part === 'heights'
      ? {type: 'raster-dem', encoding: 'terrarium', ...source}
      : {type: 'raster', bounds: boxOf(this.#cutter.place(part).bounds), ...source};
  }

  /** RGBA of a tile, or null where a texture does not reach. */
  async render(part, tile) {
    const {longitudes, latitudes} = placesOf(tile);
    if (!this.#cutter.place(part)) throw new TksError('usage', `This stream has no ${part}.`);
    if (part === 'heights') {
      return terrarium(await this.#cutter.heights(longitudes, latitudes, true));
    }
    return this.#cutter.reaches(part, longitudes, latitudes)
      ? this.#cutter.texels(longitudes, latitudes) : null;
  }

  /** Has the map take its tiles of this stream anew; false: it has none. */
  #refresh(map) {
    const ours = Object.entries(map.getStyle()?.sources ?? {})
      .filter(([, {tiles}]) => tiles?.[0].startsWith(`tks://${this.#name}/`));
    for (const [id] of ours) map.refreshTiles(id);
    return ours.length > 0;
  }
  /** Fetches on, fourfold each time, and lets the map take its tiles anew. */
  async refine(map, {bytes = Infinity, signal} = {}) {
    const gone = new AbortController(), leave = () => gone.abort();
    const either = signal ? AbortSignal.any([signal, gone.signal]) : gone.signal;
    let isTold = false;
    map.on('remove', leave);
    try {
      for await (const _ of this.#cutter.refine({bytes, signal: either})) {
        if (!this.#refresh(map) || (await abortable(drawn(map), either)) || isTold) continue;
        isTold = true;
        console.warn(IS_WAITING);
      }
    } catch (error) {
      if (error !== gone.signal.reason) throw error;  // nobody sees a map that was removed
    } finally {
      map.off('remove', leave);
    }
  }

  dispose() {
    this.#terrain.dispose();
  }
}

async function openedSource(name, input, {bounds, project, ...options}) {
  const terrain = await open(input, options);
  try {
    return new TksMapSource(name, terrain, {bounds, project});
  } catch (error) {
    terrain.dispose();
    throw error;
  }
}

/** Give `protocol.tile` to maplibregl.addProtocol('tks', protocol.tile). */
export class TksProtocol {
  #sources = new Map();  // of a name: {stop, source}

  /** Opens a stream under a name, which is part of the addresses of its tiles. */
  async add(name, input, {signal, ...options} = {}) {
    if (!/^[\w.-]+$/.test(name) || this.#sources.has(name)) {
      throw new TksError('usage', `"${name}" is taken, or no name of letters, digits and "._-".`);
    }
    // Taken from now on, though there is a source only once the stream is open.
    const entry = {stop: new AbortController(), source: null};
    this.#sources.set(name, entry);
    const either = signal ? AbortSignal.any([signal, entry.stop.signal]) : entry.stop.signal;
    try {
      entry.source = await openedSource(name, input, {...options, signal: either});
      return entry.source;
    } catch (error) {
      if (this.#sources.get(name) === entry) this.#sources.delete(name);
      throw error;
    }
  }
  remove(name) {
    const entry = this.#sources.get(name);
    this.#sources.delete(name);
    entry?.stop.abort(new TksError('usage', `"${name}" was removed while it was opened.`));
    entry?.source?.dispose();
  }

  tile = async ({url}, {signal}) => {
    const [, name, part, z, x, y] =
      /^tks:\/\/([^/]+)\/(heights|texture)\/(\d+)\/(\d+)\/(\d+)/.exec(url) ?? [];
    const source = this.#sources.get(name)?.source;
    if (!source) throw new TksError('usage', `No stream is added for ${url}.`);
    const tile = {z: Number(z), x: Number(x), y: Number(y)};
    const rgba = await abortable(source.render(part, tile), signal);
    // An empty answer is a tile without content.
    if (!rgba) return {data: new ArrayBuffer(0)};
    // Colour management or premultiplication would change heights.
    const premultiplyAlpha = part === 'texture' ? 'premultiply' : 'none';
    return {data: await createImageBitmap(new ImageData(rgba, TILE, TILE),
      {premultiplyAlpha, colorSpaceConversion: 'none'})};
  };
}
