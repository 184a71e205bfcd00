// SPDX-License-Identifier: Apache-2.0
// Has a module encode in a worker, once, or on this thread.
import {abortable} from './abort.js';
import {compile} from './compile.js';
import {TksError} from './error.js';
import {onFailure, threadOf} from './thread.js';

/** What the worker is asked, with {module, call, input}. */
function encodeIn(worker, asked, progress) {
  return new Promise((resolve, reject) => {
    const tell = (done) => {
      try {
        progress(done);
      } catch (error) {
        reject(error);
      }
    };
    worker.onmessage = ({data: {done, encoded, error}}) => {
      if (error) reject(new TksError(error.code, error.message));
      else if (encoded) resolve(encoded);
      else tell(done);
    };
    onFailure(worker, reject);
    worker.postMessage(asked);
  });
}

/** `encoder`: its assets, the call of its module, and what calls that on this thread. */
export async function encodeApart({assets, call, encode}, input, options) {
  const {signal, worker, wasm, progress = () => {}} = options;
  signal?.throwIfAborted();
  const module = await abortable(compile(assets, wasm, call), signal);
  const thread = threadOf(worker, assets);
  if (!thread) return encode(module, input, progress);
  try {
    return await abortable(encodeIn(thread, {module, call, input}, progress), signal);
  } finally {
    thread.terminate();
  }
}
