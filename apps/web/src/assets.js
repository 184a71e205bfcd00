// SPDX-License-Identifier: Apache-2.0
// Where the decoder's modules and worker lie: beside this file, as bundlers follow by
// `new URL(..., import.meta.url)`, or packed in a script, for those that do not.
import {compileAt} from './compile.js';

export const assets = {
  full: () => compileAt(new URL('../dist/tetrakis.wasm', import.meta.url)),
  plain: () => compileAt(new URL('../dist/tetrakis-plain.wasm', import.meta.url)),
  /** Decoding in Node stays on the calling thread. */
  worker: () =>
    typeof Worker === 'undefined'
      ? null
      : new Worker(new URL('./worker.js', import.meta.url), {type: 'module'}),
  packed: () => import('../dist/packed.js'),
};
