// SPDX-License-Identifier: Apache-2.0
// Where browsers find the modules and the worker. Bundlers know `new URL(..., import.meta.url)`.

export const assets = {
  full: () => WebAssembly.compileStreaming(fetch(new URL('../dist/tetrakis.wasm', import.meta.url))),
  plain: () =>
    WebAssembly.compileStreaming(fetch(new URL('../dist/tetrakis-plain.wasm', import.meta.url))),
  worker: () =>
    typeof Worker === 'undefined'
      ? null
      : new Worker(new URL('./worker.js', import.meta.url), {type: 'module'}),
};
