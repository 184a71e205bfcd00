// SPDX-License-Identifier: Apache-2.0
// Where the encoder lies: apart from the decoder, so that pages that only show terrain do not carry
// it.
import {compileAt} from './compile.js';
import {nodeWorker} from './node.js';

/** Of all encoders. */
export const startWorker = () =>
  (typeof Worker === 'undefined'
    ? nodeWorker('./encode_worker.js', import.meta.url)
    : new Worker(new URL('./encode_worker.js', import.meta.url), {type: 'module'}));

export const assets = {
  full: () => compileAt(new URL('../dist/tetrakis-encode.wasm', import.meta.url)),
  plain: () => compileAt(new URL('../dist/tetrakis-encode-plain.wasm', import.meta.url)),
  worker: startWorker,
  packed: () => import('../dist/packed_encode.js'),
};
