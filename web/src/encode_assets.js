// SPDX-License-Identifier: Apache-2.0
// Where browsers find the encoder: apart from the decoder, so that pages that only show terrain do
// not carry it.
import {compileAt} from './compile.js';

export const assets = {
  full: () => compileAt(new URL('../dist/tetrakis-encode.wasm', import.meta.url)),
  plain: () => compileAt(new URL('../dist/tetrakis-encode-plain.wasm', import.meta.url)),
  worker: () =>
    typeof Worker === 'undefined'
      ? null
      : new Worker(new URL('./encode_worker.js', import.meta.url), {type: 'module'}),
};
