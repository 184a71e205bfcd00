// SPDX-License-Identifier: Apache-2.0
// The encoder as files, for Node.
import {readFile} from 'node:fs/promises';
import {nodeWorker} from './node_worker.js';

const compile = async (name) =>
  WebAssembly.compile(await readFile(new URL(`../dist/${name}`, import.meta.url)));

export const assets = {
  full: () => compile('tetrakis-encode.wasm'),
  plain: () => compile('tetrakis-encode-plain.wasm'),
  worker: () => nodeWorker(new URL('./encode_worker_node.js', import.meta.url)),
};
