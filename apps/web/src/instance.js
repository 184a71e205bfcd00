// SPDX-License-Identifier: Apache-2.0
// An instance of a WebAssembly module of Tetrakis: its calls and its memory. The modules are built
// without JavaScript of emscripten's, so this file is all of their glue.
import {TksError} from './error.js';

/** By the numbers of tks_sample. */
export const SAMPLES = [
  Uint8Array, Int8Array, Uint16Array, Int16Array, Uint32Array, Int32Array, Float32Array,
];
export const MESSAGE_BYTES = 400;
/** A module counts its memory by 32 bits: of more bytes malloc would see the lower bits only. */
const ADDRESSES = 2 ** 32;

/** A page has 64 kB; so many make 1 MB. */
const LEAST_PAGES = 16;

/** What a module imports: a notice that memory grew, and an exit that only an abort calls. */
function importsOf(module, given, grown) {
  const imports = {};
  for (const {module: space, name} of WebAssembly.Module.imports(module)) {
    const abort = () => {
      throw new WebAssembly.RuntimeError(`aborted in ${name}`);
    };
    const known = given[name] ?? (name.startsWith('emscripten_notify') ? grown : abort);
    (imports[space] ??= {})[name] = known;
  }
  return imports;
}

/**
 * What is told of an error in a call of a module. Modules trap where memory runs out, and engines
 * throw a RangeError where they have none to give: `exhausted` is the sentence for that.
 */
export function failureOf(error, exhausted) {
  if (error instanceof TksError) return error;
  const isMemory = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
  return isMemory ? new TksError('memory', exhausted, {cause: error})
    : new TksError('usage', `The WebAssembly module cannot be called so (${error.message}).`,
      {cause: error});
}

/** An instance with the few operations on its memory that codecs need. */
export class Instance {
  /** given: functions that the module imports. */
  constructor(module, given = {}) {
    const imports = importsOf(module, given, () => this.#growAhead());
    this.calls = new WebAssembly.Instance(module, imports).exports;
    this.calls._initialize?.();
  }
  /**
   * Modules grow by the pages that one allocation lacks. Engines collect garbage each time, which
   * takes more than what the memory is for: so an eighth more comes along.
   */
  #growAhead() {
    const {memory} = this.calls;
    try {
      memory.grow(Math.max(LEAST_PAGES, memory.buffer.byteLength / 2 ** 19));
    } catch {}  // what the module has asked for is there
  }
  /**
   * Anew at each use: growing memory detaches the old buffer. Addresses above 2 GiB, which
   * functions of the module give as negative numbers, are made whole here.
   */
  view(Type, address, length) {
    return new Type(this.calls.memory.buffer, address >>> 0, length);
  }
  copy(Type, address, length) {
    return this.view(Type, address, length).slice();
  }
  text(address) {
    const bytes = this.view(Uint8Array, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }
  /** Memory to be freed. */
  allocate(bytes) {
    const address = bytes < ADDRESSES ? this.calls.malloc(Math.max(bytes, 1)) : 0;
    if (address === 0) throw new TksError('memory', `There is no memory for ${bytes} bytes more.`);
    return address;
  }
  /** Calls `use` with memory that is freed afterwards. */
  with(bytes, use) {
    const address = this.allocate(bytes);
    try {
      return use(address);
    } finally {
      this.calls.free(address);
    }
  }
}
