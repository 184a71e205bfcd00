// SPDX-License-Identifier: Apache-2.0
// The encoder as files, for Node. Encoding there stays on the calling thread.
import {readFile} from 'node:fs/promises';

const compile = async (name) =>
  WebAssembly.compile(await readFile(new URL(`../dist/${name}`, import.meta.url)));

export const assets = {
  full: () => compile('tetrakis-encode.wasm'),
  plain: () => compile('tetrakis-encode-plain.wasm'),
  worker: () => null,
};
