// SPDX-License-Identifier: Apache-2.0
// Where browsers find the modules and the worker. Bundlers know `new URL(..., import.meta.url)`.
import {compileAt} from './compile.js';

export const assets = {
  full: () => compileAt(new URL('../dist/tetrakis.wasm', import.meta.url)),
  plain: () => compileAt(new URL('../dist/tetrakis-plain.wasm', import.meta.url)),
  worker: () =>
    typeof Worker === 'undefined'
      ? null
      : new Worker(new URL('./worker.js', import.meta.url), {type: 'module'}),
};
