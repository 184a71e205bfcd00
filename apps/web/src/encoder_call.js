// SPDX-License-Identifier: Apache-2.0
// Calls a WebAssembly module that encodes. Nothing here waits: it runs in a worker as well.
import {TksError} from './error.js';
import {Instance, MESSAGE_BYTES, failureOf} from './instance.js';

export const EXHAUSTED = 'The encoder ran out of memory: a page has 4 GB at most.';

/** Memory of an instance for one encoding; the instance is then thrown away. */
class Allocation {
  constructor(instance) {
    this.instance = instance;
  }
  array(array) {
    const address = this.instance.allocate(array.byteLength);
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    this.instance.view(Uint8Array, address, bytes.length).set(bytes);
    return address;
  }
  text(text) {
    return text === undefined || text === null ? 0
      : this.array(new TextEncoder().encode(`${text}\0`));
  }
}

/** An instance of a module whose progress is told. */
function instanceOf(module, progress) {
  // WASI's, by which the module knows when to report again: nanoseconds, as a 64-bit number.
  const clock_time_get = (clock, precision, address) => {
    instance.view(BigInt64Array, address, 1)[0] = BigInt(Math.round(performance.now() * 1e6));
    return 0;
  };
  const instance = new Instance(module, {web_progress: progress, clock_time_get});
  return instance;
}

/** The stream that `call` makes of numbers and texts, by their names, and of arrays in order. */
export function streamOf(instance, call, {numbers, texts, arrays}) {
  const {calls} = instance;
  const memory = new Allocation(instance);
  const namesOf = (kind) => instance.text(calls[`${call}_${kind}`]()).split(' ');
  const given = [
    Float64Array.from(namesOf('names'), (name) => numbers[name] ?? 0),
    Uint32Array.from(namesOf('texts'), (name) => memory.text(texts[name])),
    Uint32Array.from(arrays, (array) => (array ? memory.array(array) : 0)),
  ].map((list) => memory.array(list));
  const out = instance.allocate(8 + MESSAGE_BYTES);
  const status = calls[call](...given, out, out + 8, MESSAGE_BYTES);
  if (status !== 0) throw TksError.ofStatus(status, instance.text(out + 8));
  const [address, size] = instance.view(Uint32Array, out, 2);
  return instance.copy(Uint8Array, address, size);
}

/** What use(instance) gives. `progress` is told how much is done, from 0 to 1; what it throws comes
 * back. */
export function withEncoder(module, progress, use) {
  let thrown = null;
  const watched = (done) => {
    try {
      progress(done);
    } catch (error) {
      thrown = {error};
      throw error;
    }
  };
  try {
    return use(instanceOf(module, watched));
  } catch (error) {
    throw thrown ? thrown.error : failureOf(error, EXHAUSTED);
  }
}
