// SPDX-License-Identifier: Apache-2.0
// A stream that is open, as users have it: frames of its bytes, one or a series that refines.
import {abortable} from './abort.js';
import {globeOn} from './body.js';
import {askedOf} from './components.js';
import {askDecoder} from './decoders.js';
import {TksError} from './error.js';
import {Fetcher} from './fetcher.js';
import {checkBytes, checkFrame, checkLevels, checkSides, trianglesOf} from './limits.js';
import {mapsOf} from './material.js';
import {FIRST_BYTES, GROWTH, nextBytes} from './pace.js';
import {PARTS} from './parts.js';
import {cutOf, plannedView} from './view.js';

const DEFAULTS = {
  frame: 0,
  component: null,
  triangles: 20000,
  view: null,
  mesh: true,
  globe: null,
  normals: false,
  texture: true,
  maps: true,
  surface: false,
  texels: 4096,
  samples: 4096,
};

/** Resolves when the promise ends, however it does, or after so many ms. */
async function within(ms, promise) {
  let timer;
  const end = new Promise((resolve) => (timer = setTimeout(resolve, ms)));
  await Promise.race([promise.catch(() => {}), end]);
  clearTimeout(timer);
}

/** Made by open(). */
export class Terrain {
  #fetcher;
  #decoder;
  #told = 0;  // bytes of the frame that `info` is of

  constructor(source, decoder, requestBytes) {
    this.#fetcher = new Fetcher(source, decoder, requestBytes);
    this.#decoder = decoder;
  }

  get info() {
    return this.#fetcher.info;
  }
  get loaded() {
    return this.#fetcher.loaded;
  }
  get truncated() {
    return this.#fetcher.truncated;
  }
  get fileBytes() {
    return this.#fetcher.fileBytes;
  }

  isSequence = false;
  /** Nobody knows when the frames of a stream are: a tick is taken to lie between them. */
  clock = null;
  firstFrame = 0;
  get frames() {
    return this.info.frames;
  }
  get times() {
    return Array.from({length: this.frames}, (_, frame) => frame);
  }
  async at(time) {
    return Math.min(Math.max(Math.floor(time), 0), this.frames - 1) || 0;
  }
  async group() {
    return {firstFrame: 0, endFrame: this.frames, bytes: this.info.streamBytes};
  }

  async load(bytes, {signal, view, globe, component, triangles = DEFAULTS.triangles} = {}) {
    signal?.throwIfAborted();
    checkBytes(bytes);
    const planned = this.#plannedView(view, globe);
    return this.#fetcher.load(bytes, {
      signal, view: planned, triangles: trianglesOf(triangles), component: askedOf(component),
    });
  }
  /** Views are of ground, which lies round a globe where one is asked for. */
  #plannedView(view, globe) {
    const planned = this.info?.isObject ? null : plannedView(view);
    return planned && this.info && globe ? {...planned, globe: globeOn(globe, this.info)} : planned;
  }

  async decode({bytes = Infinity, signal, ...options} = {}) {
    checkBytes(bytes);
    const {leastBytes = 0, streamBytes = bytes} = this.info ?? {};
    const wanted = Math.min(Math.max(bytes, leastBytes), streamBytes);
    const {view, globe, triangles, component} = {...DEFAULTS, ...options};
    const have = await this.load(wanted, {signal, view, globe, triangles, component});
    return this.#frame(have, {...options, signal});
  }
  /** Of the first so many bytes, which are here. */
  async #frame(bytes, {signal, ...options}) {
    const asked = {...DEFAULTS, ...options};
    const component = askedOf(asked.component);
    checkSides(asked);
    if (component.length === 0) checkLevels(asked, this.info ?? {});
    checkFrame(asked.frame, 0, this.info?.frames ?? 1);
    const triangles = trianglesOf(asked.triangles), cut = cutOf(asked.view);
    const frame = await askDecoder(
      this.#decoder, 'decode', {...asked, view: null, triangles, cut, bytes, component}, signal);
    if (component.length === 0 && frame.bytes >= this.#told) {
      [this.#told, this.#fetcher.info] = [frame.bytes, frame.info];
    }
    const maps = await this.#maps(frame, {...asked, signal});
    return {...frame, ...maps, number: asked.frame, time: asked.frame};
  }
  /** Those of an object's material, as far as the bytes of the frame tell of them. */
  async #maps({info, bytes}, {maps, texture, texels, component, signal}) {
    const found = mapsOf(info);
    if (found.size === 0 || !maps || !texture || askedOf(component).length > 0) return {};
    const rasters = {};
    for (const [name, {number, bytes: known}] of found) {
      if (known === 0 && bytes < info.streamBytes) continue;
      const map = await askDecoder(this.#decoder, 'decode',
        {...DEFAULTS, mesh: false, texels, bytes, component: [number]}, signal);
      rasters[name] = {...map.texture, psnr: map.info.texturePsnr};
    }
    return {maps: rasters};
  }

  /** While a frame is decoded and shown, bytes come on; the next one takes what is here by then. */
  async *refine({bytes = Infinity, signal, first, after = 0, ...options} = {}) {
    checkBytes(bytes);
    const {leastBytes, streamBytes} = this.info;
    const limit = Math.min(Math.max(bytes, leastBytes), streamBytes);
    let shown = after, beginning = null;
    if (!after) {
      shown = await this.load(Math.min(this.#fetcher.bytes, limit), {signal});
      beginning = this.#frame(shown, {...options, ...first, signal});
      beginning.catch(() => {});
    }
    const leave = new AbortController();
    const ended = signal ? AbortSignal.any([signal, leave.signal]) : leave.signal;
    const all = this.load(limit, {...options, signal: ended});
    all.catch(() => {});
    let took = 0;
    try {
      if (beginning) yield await beginning;
      if (first) shown = 0;  // not yet as it is asked for
      for (;;) {
        const wanted = leastBytes + GROWTH * Math.max(shown - leastBytes, FIRST_BYTES);
        await abortable(this.#fetcher.reached(2 * wanted > limit ? limit : wanted, all), signal);
        const patience = this.#fetcher.patience(limit - this.#fetcher.bytes, took);
        if (patience) await abortable(within(patience, all), signal);
        const taken = nextBytes(shown, Math.min(this.#fetcher.bytes, limit));
        if (taken <= shown) return;
        const begun = performance.now();
        const frame = await this.#frame((shown = taken), {...options, signal});
        took = performance.now() - begun;
        yield frame;
      }
    } finally {
      leave.abort();
    }
  }

  /** Which bytes a window of the heights or of the texture takes, as [begin, end). Of an index in
   * pages it fetches those that tell of the window. */
  async needed({part = 'heights', window, component, signal} = {}) {
    const {x, y, width, height} = window ?? {};
    if (!(part in PARTS) || ![x, y, width, height].every((number) => number >= 0)) {
      throw new TksError('usage', 'needed() takes `part`, "heights" or "texture", and `window`: ' +
        '{x, y, width, height}.');
    }
    const asked = {part: PARTS[part], window, component: askedOf(component)};
    const {headerBytes, streamBytes} = this.info;
    for (;;) {
      const planned = await askDecoder(this.#decoder, 'needed', asked);
      const ranges = planned.map(({begin, end}) => [begin, end]);
      if (!ranges.some(([begin]) => begin >= streamBytes)) return ranges;
      // Without its index the stream is read as a whole.
      if (!(await this.#fetcher.bring(ranges, signal))) return [[headerBytes, streamBytes]];
    }
  }

  /** Reads the header, which may be longer than the first request: the second brings a picture. */
  async begin(signal, bytes = FIRST_BYTES) {
    for (;;) {
      const have = await this.load(bytes, {signal});
      try {
        await this.decode({bytes, signal, mesh: false, texture: false});
        return;
      } catch (error) {
        if (error.code !== 'truncated') throw error;
        if (have === 0) throw new TksError('truncated', 'The file is empty.');
        if (have < bytes) {
          throw new TksError('truncated', `The file is cut short: it ends after ${have} bytes, ` +
            'inside the header of the stream.');
        }
        bytes = (error.needed > bytes ? error.needed : GROWTH * bytes) + FIRST_BYTES;
      }
    }
  }

  dispose() {
    this.#fetcher.close();
    this.#decoder.dispose();
  }
  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.dispose();
  }
}
