// SPDX-License-Identifier: Apache-2.0
// Encodes in the browser: the encoder is a module of its own, loaded when it is first used.
import {abortable} from './abort.js';
import {compile} from './compile.js';
import {assets} from './encode_assets.js';
import {checkNames} from './encode_names.js';
import {encodeWith} from './encoder.js';
import {TksError} from './error.js';
import {onFailure, threadOf} from './thread.js';

export {TksError};

function encodeIn(worker, module, input, progress) {
  return new Promise((resolve, reject) => {
    const tell = (done) => {
      try {
        progress(done);
      } catch (error) {
        reject(error);
      }
    };
    worker.onmessage = ({data: {done, stream, error}}) => {
      if (error) reject(new TksError(error.code, error.message));
      else if (stream) resolve(stream);
      else tell(done);
    };
    onFailure(worker, reject);
    worker.postMessage({module, input});
  });
}

export async function encode(input = {}, options = {}) {
  checkNames(input, options);
  const {signal, worker, wasm, progress = () => {}} = options;
  signal?.throwIfAborted();
  const module = await abortable(compile(assets, wasm, 'web_encode'), signal);
  const thread = threadOf(worker, assets);
  if (!thread) return encodeWith(module, input, progress);
  try {
    return await abortable(encodeIn(thread, module, input, progress), signal);
  } finally {
    thread.terminate();
  }
}
