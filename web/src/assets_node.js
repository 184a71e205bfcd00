// SPDX-License-Identifier: Apache-2.0
// The modules as files, for Node. Decoding there stays on the calling thread.
import {readFile} from 'node:fs/promises';

const compile = async (name) =>
  WebAssembly.compile(await readFile(new URL(`../dist/${name}`, import.meta.url)));

export const assets = {
  full: () => compile('tetrakis.wasm'),
  plain: () => compile('tetrakis-plain.wasm'),
  worker: () => null,
};
