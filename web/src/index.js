// SPDX-License-Identifier: Apache-2.0
// The core of the package: opens streams and refines them. It knows no renderer.
import {assets} from '#assets';
import {compile} from './compile.js';
import {TksError} from './error.js';
import {Decoder, groundScale} from './module.js';
import {FIRST_BYTES, GROWTH} from './pace.js';
import {Held, requestsFor} from './ranges.js';
import {abortable, sourceOf} from './source.js';

export {TksError, groundScale};

const MEMORY = 2 ** 30;
/** What a request costs beside its own: 50 ms at 10 Mb/s, shared by the dozen that go out at a time. */
const REQUEST_BYTES = 4096;

/** A Decoder in a worker: the same calls, as promises. */
class RemoteDecoder {
  #worker;
  #waiting = new Map();
  #calls = 0;

  constructor(worker, module, memory) {
    this.#worker = worker;
    worker.onmessage = ({data: {id, result, error}}) => {
      if (!this.#waiting.has(id)) return;  // all were told of a failure or the end
      const {resolve, reject} = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (!error) return resolve(result);
      reject(Object.assign(new TksError(error.code, error.message), {needed: error.needed}));
    };
    worker.onerror = (event) => {
      event.preventDefault?.();
      this.#failAll(new TksError('io', `The worker failed: ${event.message ?? 'it did not start'}.`));
    };
    this.#call({operation: 'start', module, memory}).catch(() => {});
  }
  #failAll(error) {
    for (const {reject} of this.#waiting.values()) reject(error);
    this.#waiting.clear();
    this.failed = error;
  }
  #call(message) {
    if (this.failed) return Promise.reject(this.failed);
    return new Promise((resolve, reject) => {
      const id = this.#calls++;
      this.#waiting.set(id, {resolve, reject});
      this.#worker.postMessage({...message, id});
    });
  }
  put(place, chunk) {
    return this.#call({operation: 'put', place, chunk});
  }
  decode(request) {
    return this.#call({operation: 'decode', request});
  }
  plan(request) {
    return this.#call({operation: 'plan', request});
  }
  needed(request) {
    return this.#call({operation: 'needed', request});
  }
  dispose() {
    this.#worker.terminate();
    this.#failAll(new TksError('usage', 'This terrain is disposed.'));
  }
}

class LocalDecoder {
  #decoder;
  constructor(module, memory) {
    this.#decoder = new Decoder(module, memory);
  }
  get #open() {
    if (!this.#decoder) throw new TksError('usage', 'This terrain is disposed.');
    return this.#decoder;
  }
  async put(place, chunk) {
    this.#open.put(place, chunk);
  }
  async decode(request) {
    return this.#open.decode(request);
  }
  async plan(request) {
    return this.#open.plan(request);
  }
  async needed(request) {
    return this.#open.needed(request);
  }
  dispose() {
    this.#decoder = null;
  }
}

function makeDecoder(worker, module, memory) {
  if (worker === false) return new LocalDecoder(module, memory);
  let made = worker;
  if (worker === undefined || worker === true) {
    try {
      made = assets.worker();
    } catch {
      made = null;  // pages may not start workers of another origin
    }
  } else if (typeof worker === 'string' || worker instanceof URL) {
    made = new Worker(worker, {type: 'module'});
  }
  return made ? new RemoteDecoder(made, module, memory) : new LocalDecoder(module, memory);
}

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

/** A view as a plan needs it; nothing where there are but 16 numbers. */
function plannedView(view) {
  if (!view?.clip) return null;
  if (view.clip.length !== 16 || !(view.width >= 1) || !(view.height >= 1)) {
    throw new TksError('usage', 'A view takes clip, 16 numbers, and width and height, the pixels of ' +
      'its picture.');
  }
  const pixels = (side) => Math.min(32768, Math.round(side));
  return {clip: [...view.clip], width: pixels(view.width), height: pixels(view.height)};
}

/** A stream that is open. Made by open(). */
class Terrain {
  #source;
  #decoder;  // a promise: the first bytes are fetched while the module is compiled
  #held = new Held();
  #reading = Promise.resolve();

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

  async load(bytes, {signal, view, triangles = DEFAULTS.triangles} = {}) {
    signal?.throwIfAborted();
    const seen = plannedView(view);
    // One after another: each asks for what the ones before did not.
    const step = async () => {
      for (let before = -1; this.#held.bytes < bytes && this.#held.bytes > before; ) {
        before = this.#held.bytes;
        const isPlanned = seen && this.info?.hasIndex && !this.#source.sequential;
        if (!isPlanned) {
          await this.#fetchNext(bytes - before);
          continue;
        }
        await this.#fetchPlanned(seen, bytes - before, triangles);
        if (bytes - this.#held.bytes < this.requestBytes) return;  // not worth another request
      }
    };
    const reading = (this.#reading = this.#reading.catch(() => {}).then(step));
    await abortable(reading, signal);
    return Math.min(bytes, this.#held.bytes);
  }
  /** The first bytes that are missing. */
  async #fetchNext(bytes) {
    const size = Math.min(this.info?.streamBytes ?? Infinity, this.#source.size);
    const [gap] = this.#held.gaps(0, size);
    if (!gap) return;
    const [begin, end] = gap;
    await this.#take(begin, await this.#source.next(begin, Math.min(end, begin + bytes)));
  }
  /** Those that help a view most; none where nothing more does. */
  async #fetchPlanned(view, bytes, triangles) {
    const {requestBytes} = this;
    const plan = await (await this.#decoder).plan({view, bytes, triangles, requestBytes});
    const answers = requestsFor(plan, this.#source.size).map(([begin, end]) =>
      ({begin, chunk: this.#source.scattered(begin, end)}));
    await Promise.all(answers.map(({chunk}) => chunk));
    for (const {begin, chunk} of answers) await this.#take(begin, await chunk);
    // A server that has just forgotten ranges sends all from its beginning.
    if (this.#source.sequential) await this.#fetchNext(bytes);
  }
  /** Bytes from a place on. Those that are here already are left out. */
  async #take(begin, chunk) {
    const decoder = await this.#decoder;
    for (const [b, e] of this.#held.gaps(begin, begin + chunk.length)) {
      await decoder.put(b, chunk.slice(b - begin, e - begin));
    }
    this.#held.add(begin, begin + chunk.length);
  }

  async decode({bytes = Infinity, signal, ...options} = {}) {
    const {headerBytes = 0, streamBytes = bytes} = this.info ?? {};
    const wanted = Math.min(Math.max(bytes, headerBytes), streamBytes);
    const {view, triangles} = {...DEFAULTS, ...options};
    const have = await this.load(wanted, {signal, view, triangles});
    const cut = view?.clip ? (view.cut ? [...view.clip] : null) : view;
    const request = {...DEFAULTS, ...options, view: null, cut, bytes: have};
    return abortable((await this.#decoder).decode(request), signal);
  }

  async *refine({bytes = Infinity, signal, ...options} = {}) {
    const limit = Math.min(bytes, this.info.streamBytes), {headerBytes} = this.info;
    for (let wanted = Math.min(Math.max(this.#held.bytes, FIRST_BYTES), limit); ; ) {
      const frame = await this.decode({...options, bytes: wanted, signal});
      yield frame;
      if (wanted === limit || wanted - frame.bytes > this.requestBytes) return;
      wanted = headerBytes + GROWTH * Math.max(wanted - headerBytes, FIRST_BYTES);
      if (2 * wanted > limit) wanted = limit;
    }
  }

  /** Which bytes a window of the heights or of the texture takes, as [begin, end). */
  async needed({part = 'heights', window}) {
    const request = {part: PARTS[part], window};
    return (await (await this.#decoder).needed(request)).map(({begin, end}) => [begin, end]);
  }

  /** Reads the header, which may be longer than the first request: the second brings a picture. */
  async begin(signal) {
    for (let bytes = FIRST_BYTES; ; ) {
      const have = await this.load(bytes, {signal});
      try {
        this.info = (await this.decode({bytes, signal, mesh: false, texture: false})).info;
        return;
      } catch (error) {
        if (error.code !== 'truncated') throw error;
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
    this.#decoder.then((decoder) => decoder.dispose()).catch(() => {});
  }
  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.dispose();
  }
}

export async function open(input, options = {}) {
  const {signal, worker, wasm, memory = MEMORY, requestBytes = REQUEST_BYTES} = options;
  signal?.throwIfAborted();
  const decoder = compile(assets, wasm).then((module) => makeDecoder(worker, module, memory));
  decoder.catch(() => {});
  const terrain = new Terrain(sourceOf(input), decoder, requestBytes);
  try {
    await terrain.begin(signal);
    return terrain;
  } catch (error) {
    terrain.dispose();
    throw error;
  }
}
