// SPDX-License-Identifier: Apache-2.0
// Encodes meshes of triangles: by a module of its own, so that pages that encode terrain do not
// carry it.
import {compileAt} from './compile.js';
import {startWorker} from './encode_assets.js';
import {checkObjectNames} from './encode_names.js';
import {encodeApart} from './encode_apart.js';
import {encodeObjectWith} from './object_encoder.js';

const assets = {
  full: () => compileAt(new URL('../dist/tetrakis-encode-object.wasm', import.meta.url)),
  plain: () => compileAt(new URL('../dist/tetrakis-encode-object-plain.wasm', import.meta.url)),
  worker: startWorker,
  packed: () => import('../dist/packed_encode_object.js'),
};

export async function encodeObject(mesh = {}, options = {}) {
  checkObjectNames(mesh, options);
  return encodeApart({assets, call: 'web_encode_object', encode: encodeObjectWith}, mesh, options);
}
