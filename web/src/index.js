// SPDX-License-Identifier: Apache-2.0
// The core of the package: opens streams and refines them. It knows no renderer.
import {abortable, stoppedBy} from './abort.js';
import {groundAxes} from './axes.js';
import {startDecoder} from './decoders.js';
import {TksError} from './error.js';
import {groundScale} from './ground.js';
import {checkBytes, checkLevels, checkSides, trianglesOf} from './limits.js';
import {FIRST_BYTES, FIRST_FRAME, Flow, GROWTH, nextBytes} from './pace.js';
import {Held, requestsFor} from './ranges.js';
import {sourceOf} from './source.js';
import {cutOf, plannedView} from './view.js';

export {FIRST_FRAME, TksError, groundAxes, groundScale};

/** What a request costs beside its own: 50 ms at 10 Mb/s, shared by the dozen that go out at a time. */
const REQUEST_BYTES = 4096;

const DEFAULTS = {
  triangles: 20000,
  view: null,
  mesh: true,
  normals: false,
  texture: true,
  surface: false,
  texels: 4096,
  samples: 4096,
};

/** The numbers of tks_part. */
const PARTS = {heights: 0, texture: 2};

/** Resolves when the promise ends, however it does, or after so many ms. */
async function within(ms, promise) {
  let timer;
  const end = new Promise((resolve) => (timer = setTimeout(resolve, ms)));
  await Promise.race([promise.catch(() => {}), end]);
  clearTimeout(timer);
}

/** A stream that is open. Made by open(). */
class Terrain {
  #source;
  #decoder;
  #held = new Held();
  #flow = new Flow();
  #reading = Promise.resolve();
  #awaited = new Set();  // {bytes, resolve}: who waits for so many
  #told = 0;  // bytes of the frame that `info` is of

  constructor(source, decoder, requestBytes) {
    this.#source = source;
    this.#decoder = decoder;
    this.requestBytes = requestBytes;
  }

  /** How many requests went out, how many bytes of the stream are here, and which. */
  get loaded() {
    const {bytes, ranges} = this.#held;
    return {requests: this.#source.requests, bytes, ranges};
  }
  /** Whether the file ends before the stream does. */
  get truncated() {
    return this.#source.size < this.info.streamBytes;
  }

  /** Of the file, as far as it is known; Infinity: it is not. */
  get fileBytes() {
    return this.#source.size;
  }

  async load(bytes, {signal, view, triangles = DEFAULTS.triangles} = {}) {
    signal?.throwIfAborted();
    checkBytes(bytes);
    const asked = {signal, view: plannedView(view), triangles: trianglesOf(triangles)};
    if (this.#held.bytes < bytes) {
      // One after another: each asks for what the ones before did not.
      const reading = this.#reading.catch(() => {}).then(() => this.#read(bytes, asked));
      this.#reading = reading;
      await abortable(this.#reached(bytes, reading), signal);
    }
    return Math.min(bytes, this.#held.bytes);
  }
  /** Resolves when so many bytes are here, whoever asked for them, or when `reading` ends. */
  async #reached(bytes, reading) {
    let waiting;
    const here = new Promise((resolve) => (waiting = {bytes, resolve}));
    if (this.#held.bytes < bytes) this.#awaited.add(waiting);
    else waiting.resolve();
    try {
      await Promise.race([here, reading]);
    } finally {
      this.#awaited.delete(waiting);
    }
  }
  async #read(bytes, {signal, view, triangles}) {
    for (let before = -1; this.#held.bytes < bytes && this.#held.bytes > before; ) {
      signal?.throwIfAborted();
      before = this.#held.bytes;
      const isPlanned = view && this.info?.hasIndex && !this.#source.sequential;
      if (!isPlanned) {
        await this.#fetchNext(bytes - before, signal);
        continue;
      }
      // A plan counts bytes by integers: there is no infinite number of them.
      const most = Math.min(bytes, this.info.streamBytes) - before;
      await this.#fetchPlanned(view, most, triangles, signal);
      if (bytes - this.#held.bytes < this.requestBytes) return;  // not worth another request
    }
  }
  async #call(operation, argument, signal) {
    await abortable(this.#decoder.ready, signal);  // the first bytes are fetched meanwhile
    return this.#decoder.call(operation, argument, signal);
  }
  /** The first bytes that are missing. */
  async #fetchNext(bytes, signal) {
    const size = Math.min(this.info?.streamBytes ?? Infinity, this.#source.size);
    const [gap] = this.#held.gaps(0, size);
    if (!gap) return;
    const [begin, end] = gap;
    let place = begin;
    this.#flow.request();
    await this.#source.next(begin, Math.min(end, begin + bytes), async (piece) => {
      this.#take(place, piece);
      place += piece.length;
    }, signal);
  }
  /** Those that help a view most; none where nothing more does. */
  async #fetchPlanned(view, bytes, triangles, signal) {
    const {requestBytes, truncated} = this, {size} = this.#source;
    // A plan knows no end of the file: all that a short one would hold may lie behind it.
    const [asked, most] = truncated ? [this.info.streamBytes, bytes] : [bytes, Infinity];
    const plan = await this.#call('plan', {view, bytes: asked, triangles, requestBytes}, signal);
    this.#flow.request();
    const stop = new AbortController();
    await stoppedBy(signal, stop, () =>
      this.#takeAll(requestsFor(plan, size, most), stop));
    // A server that has just forgotten ranges sends all from its beginning.
    if (this.#source.sequential) await this.#fetchNext(bytes, signal);
  }
  /** Takes ranges [begin, end) as they come. One that fails ends those that are still to come. */
  async #takeAll(ranges, stop) {
    const answers = ranges.map(([begin, end]) =>
      ({begin, chunk: this.#source.scattered(begin, end, stop.signal)}));
    for (const {chunk} of answers) chunk.catch((error) => stop.abort(error));
    for (const {begin, chunk} of answers) {
      const bytes = await chunk.catch(() => null);
      if (bytes) this.#take(begin, bytes);
    }
    stop.signal.throwIfAborted();
  }
  /**
   * Bytes from a place on. Those that are here already are left out. The decoder gets them in front
   * of what it is asked for later; nobody waits for it, because it may be at work on a frame.
   */
  #take(begin, chunk) {
    for (const [b, e] of this.#held.gaps(begin, begin + chunk.length)) {
      const put = this.#call('put', {place: b, chunk: chunk.slice(b - begin, e - begin)});
      put.catch(() => {});  // of a decoder that failed, and says so to all
    }
    this.#held.add(begin, begin + chunk.length);
    this.#flow.take(chunk.length);
    for (const {bytes, resolve} of this.#awaited) {
      if (this.#held.bytes >= bytes) resolve();
    }
  }

  async decode({bytes = Infinity, signal, ...options} = {}) {
    checkBytes(bytes);
    const {headerBytes = 0, streamBytes = bytes} = this.info ?? {};
    const wanted = Math.min(Math.max(bytes, headerBytes), streamBytes);
    const {view, triangles} = {...DEFAULTS, ...options};
    const have = await this.load(wanted, {signal, view, triangles});
    return this.#frame(have, {...options, signal});
  }
  /** Of the first so many bytes, which are here. */
  async #frame(bytes, {signal, ...options}) {
    const asked = {...DEFAULTS, ...options};
    checkSides(asked);
    checkLevels(asked, this.info ?? {});
    const triangles = trianglesOf(asked.triangles), cut = cutOf(asked.view);
    const frame =
      await this.#call('decode', {...asked, view: null, triangles, cut, bytes}, signal);
    if (frame.bytes >= this.#told) [this.#told, this.info] = [frame.bytes, frame.info];
    return frame;
  }

  /** While a frame is decoded and shown, bytes come on; the next one takes what is here by then. */
  async *refine({bytes = Infinity, signal, first, after = 0, ...options} = {}) {
    checkBytes(bytes);
    const {headerBytes, streamBytes} = this.info;
    const limit = Math.min(Math.max(bytes, headerBytes), streamBytes);
    let shown = after, beginning = null;
    if (!after) {
      shown = await this.load(Math.min(Math.max(this.#held.bytes, FIRST_BYTES), limit), {signal});
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
        const wanted = headerBytes + GROWTH * Math.max(shown - headerBytes, FIRST_BYTES);
        await abortable(this.#reached(2 * wanted > limit ? limit : wanted, all), signal);
        const patience = this.#flow.patience(limit - this.#held.bytes, took);
        if (patience) await abortable(within(patience, all), signal);
        const taken = nextBytes(shown, Math.min(this.#held.bytes, limit));
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

  /** Which bytes a window of the heights or of the texture takes, as [begin, end). */
  async needed({part = 'heights', window} = {}) {
    const {x, y, width, height} = window ?? {};
    if (!(part in PARTS) || ![x, y, width, height].every((number) => number >= 0)) {
      throw new TksError('usage', 'needed() takes `part`, "heights" or "texture", and `window`: ' +
        '{x, y, width, height}.');
    }
    const ranges = await this.#call('needed', {part: PARTS[part], window});
    return ranges.map(({begin, end}) => [begin, end]);
  }

  /** Reads the header, which may be longer than the first request: the second brings a picture. */
  async begin(signal) {
    for (let bytes = FIRST_BYTES; ; ) {
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
    this.#source.close();
    this.#decoder.dispose();
  }
  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.dispose();
  }
}

export async function open(input, options = {}) {
  const {signal, request, requestBytes = REQUEST_BYTES} = options;
  signal?.throwIfAborted();
  const source = sourceOf(input, request);
  const terrain = new Terrain(source, options.decoder ?? startDecoder(options), requestBytes);
  try {
    await terrain.begin(signal);
    return terrain;
  } catch (error) {
    terrain.dispose();
    throw error;
  }
}
