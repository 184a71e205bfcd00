// SPDX-License-Identifier: Apache-2.0
// Where the encoders lie: apart from the decoder, so that pages that only show terrain do not carry
// them, and from each other.
import {compileAt} from './compile.js';
import {nodeWorker} from './node.js';

const worker = () =>
  (typeof Worker === 'undefined'
    ? nodeWorker('./encode_worker.js', import.meta.url)
    : new Worker(new URL('./encode_worker.js', import.meta.url), {type: 'module'}));

export const assets = {
  full: () => compileAt(new URL('../dist/tetrakis-encode.wasm', import.meta.url)),
  plain: () => compileAt(new URL('../dist/tetrakis-encode-plain.wasm', import.meta.url)),
  worker,
  packed: () => import('../dist/packed_encode.js'),
};

export const objectAssets = {
  full: () => compileAt(new URL('../dist/tetrakis-encode-object.wasm', import.meta.url)),
  plain: () => compileAt(new URL('../dist/tetrakis-encode-object-plain.wasm', import.meta.url)),
  worker,
  packed: () => import('../dist/packed_encode_object.js'),
};
