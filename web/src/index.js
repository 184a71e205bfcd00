// SPDX-License-Identifier: Apache-2.0
// The core of the package: opens streams and refines them. It knows no renderer.
import {assets} from '#assets';
import {TksError} from './error.js';
import {Decoder, groundScale, hasVectors} from './module.js';
import {abortable, sourceOf} from './source.js';

export {TksError, groundScale};

/** The first request: a picture of most terrains. */
const FIRST_BYTES = 4096;
/** Each frame takes an inverse transform and a mesh anew: with this growth they are few. */
const GROWTH = 4;
const MEMORY = 2 ** 30;

const compiled = new Map();

/** The compiled module: one for all terrains of a page. */
async function compile(wasm) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  const key = wasm ? String(wasm) : hasVectors() ? 'full' : 'plain';
  if (wasm && typeof wasm !== 'string' && !(wasm instanceof URL)) return WebAssembly.compile(wasm);
  if (!compiled.has(key)) {
    const fetched = async () =>
      wasm ? WebAssembly.compile(await (await fetch(wasm)).arrayBuffer()) : assets[key]();
    const promise = fetched().catch((error) => {
      compiled.delete(key);
      throw new TksError('io', `The decoder's WebAssembly module cannot be loaded (${error.message})` +
        '. Bundlers may need {wasm: URL}.', {cause: error});
    });
    compiled.set(key, promise);
  }
  return compiled.get(key);
}

/** A Decoder in a worker: the same calls, as promises. */
class RemoteDecoder {
  #worker;
  #waiting = new Map();
  #calls = 0;

  constructor(worker, module, memory) {
    this.#worker = worker;
    worker.onmessage = ({data: {id, result, error}}) => {
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
  append(chunk) {
    return this.#call({operation: 'append', chunk});
  }
  decode(request) {
    return this.#call({operation: 'decode', request});
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
  async append(chunk) {
    this.#decoder.append(chunk);
  }
  async decode(request) {
    if (!this.#decoder) throw new TksError('usage', 'This terrain is disposed.');
    return this.#decoder.decode(request);
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

/** A stream that is open. Made by open(). */
class Terrain {
  #source;
  #decoder;  // a promise: the first bytes are fetched while the module is compiled
  #have = 0;
  #reading = Promise.resolve();

  constructor(source, decoder) {
    this.#source = source;
    this.#decoder = decoder;
  }

  /** How many requests went out, and how many bytes of the stream are here. */
  get loaded() {
    return {requests: this.#source.requests, bytes: this.#have};
  }
  /** Whether the file ends before the stream does. */
  get truncated() {
    return this.#source.ended && this.#have < this.info.streamBytes;
  }

  async load(bytes, {signal} = {}) {
    // One after another: the source gives bytes in their order.
    const step = async () => {
      const chunk = await this.#source.next(bytes);
      this.#have += chunk.length;
      if (chunk.length > 0) await (await this.#decoder).append(chunk.slice());
    };
    const reading = (this.#reading = this.#reading.catch(() => {}).then(step));
    await abortable(reading, signal);
    return Math.min(bytes, this.#have);
  }

  async decode({bytes = Infinity, signal, ...options} = {}) {
    const wanted = Math.min(bytes, this.info?.streamBytes ?? bytes);
    const have = await this.load(wanted, {signal});
    const request = {...DEFAULTS, ...options, bytes: have};
    return abortable((await this.#decoder).decode(request), signal);
  }

  async *refine({bytes = Infinity, signal, ...options} = {}) {
    const limit = Math.min(bytes, this.info.streamBytes);
    for (let wanted = Math.min(Math.max(this.#have, FIRST_BYTES), limit); ; ) {
      const frame = await this.decode({...options, bytes: wanted, signal});
      yield frame;
      if (frame.bytes >= limit || frame.bytes < wanted) return;
      wanted = GROWTH * wanted;
      if (2 * wanted > limit) wanted = limit;
    }
  }

  /** Reads the header, which may be longer than the first request. */
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
        bytes = Math.max(error.needed ?? 0, GROWTH * bytes);
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

export async function open(input, {signal, worker, wasm, memory = MEMORY} = {}) {
  signal?.throwIfAborted();
  const decoder = compile(wasm).then((module) => makeDecoder(worker, module, memory));
  decoder.catch(() => {});
  const terrain = new Terrain(sourceOf(input), decoder);
  try {
    await terrain.begin(signal);
    return terrain;
  } catch (error) {
    terrain.dispose();
    throw error;
  }
}
