// SPDX-License-Identifier: Apache-2.0
// Decoders as the page calls them: in a worker, or on its own thread.
import {abortable} from './abort.js';
import {assets} from './assets.js';
import {compile} from './compile.js';
import {TksError} from './error.js';
import {Operations} from './operations.js';
import {onFailure, threadOf} from './thread.js';

/** What one decoding may take. */
const MEMORY = 2 ** 30;

const disposed = () => new TksError('usage', 'This terrain is disposed.');

/** Operations in a worker: the same calls. */
class RemoteDecoder {
  #worker;
  #waiting = new Map();
  #calls = 0;

  constructor(worker) {
    this.#worker = worker;
    worker.onmessage = ({data: {id, result, error}}) => {
      if (!this.#waiting.has(id)) return;  // all were told of a failure or the end
      const {resolve, reject} = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (!error) return resolve(result);
      reject(Object.assign(new TksError(error.code, error.message), {needed: error.needed}));
    };
    onFailure(worker, (error) => this.#failAll(error));
  }
  #failAll(error) {
    for (const {reject} of this.#waiting.values()) reject(error);
    this.#waiting.clear();
    this.failed = error;
  }
  start(what) {
    return this.call('start', what);
  }
  async call(operation, argument, signal) {
    signal?.throwIfAborted();
    if (this.failed) throw this.failed;
    const id = this.#calls++;
    const answer = new Promise((resolve, reject) => {
      this.#waiting.set(id, {resolve, reject});
      this.#worker.postMessage({id, operation, argument});
    });
    return abortable(answer, signal, () => this.#worker.postMessage({id, operation: 'stop'}));
  }
  dispose() {
    this.#worker.terminate();
    this.#failAll(disposed());
  }
}

class LocalDecoder {
  #operations;
  #end = new AbortController();
  async start(what) {
    this.#operations = new Operations(what);
  }
  async call(operation, argument, signal) {
    const end = this.#end.signal;
    end.throwIfAborted();
    const either = signal ? AbortSignal.any([signal, end]) : end;
    return abortable(this.#operations.call(operation, argument, either), either);
  }
  dispose() {
    this.#end.abort(disposed());
    this.#operations = null;
  }
}

/** A decoder whose thread starts while its module is fetched: `ready` resolves with both.
 * `receives`: it decodes what a receiver of a served sequence gets. */
export function startDecoder({worker, wasm, memory = MEMORY, receives = false} = {}) {
  const thread = threadOf(worker, assets);
  const decoder = thread ? new RemoteDecoder(thread) : new LocalDecoder();
  decoder.ready = compile(assets, wasm, receives ? 'web_receiver_open' : 'web_open')
    .then((module) => decoder.start({module, memory, receives}));
  decoder.ready.catch(() => {});
  return decoder;
}

/** What a call of a decoder gives, once that is ready: the first bytes are fetched meanwhile. */
export async function askDecoder(decoder, operation, argument, signal) {
  await abortable(decoder.ready, signal);
  return decoder.call(operation, argument, signal);
}
