// SPDX-License-Identifier: Apache-2.0
// Has a module encode in a worker, or on this thread.
import {abortable} from './abort.js';
import {compile} from './compile.js';
import {CALLS} from './encoder_calls.js';
import {TksError} from './error.js';
import {onFailure, threadOf} from './thread.js';

/** What the worker is asked, with {module, call, input}. */
function askOf(worker, asked, progress) {
  return new Promise((resolve, reject) => {
    const tell = (done) => {
      try {
        progress(done);
      } catch (error) {
        reject(error);
      }
    };
    worker.onmessage = ({data: {done, made, error}}) => {
      if (error) reject(new TksError(error.code, error.message));
      else if (made) resolve(made);
      else tell(done);
    };
    onFailure(worker, reject);
    worker.postMessage(asked);
  });
}

/**
 * What use(ask) gives, of a module that has the call `needed`. ask(call, input): what one of CALLS
 * makes, by a worker that ends with this, or by this thread.
 */
export async function encodeApart(assets, needed, options, use) {
  const {signal, worker, wasm, progress = () => {}} = options;
  signal?.throwIfAborted();
  const module = await abortable(compile(assets, wasm, needed), signal);
  const thread = threadOf(worker, assets);
  if (!thread) return use(async (call, input) => CALLS[call](module, input, progress));
  try {
    return await use((call, input) => abortable(askOf(thread, {module, call, input}, progress),
      signal));
  } finally {
    thread.terminate();
  }
}
