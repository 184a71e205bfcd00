// SPDX-License-Identifier: Apache-2.0
// Encodes in the browser: terrain by one module, meshes by another, each loaded when it is first
// used.
import {encodeApart} from './encode_apart.js';
import {assets, objectAssets} from './encode_assets.js';
import {checkNames, checkObjectNames} from './encode_names.js';
import {encodeWith} from './encoder.js';
import {encodeObjectWith} from './object_encoder.js';

export {TksError} from './error.js';

export async function encode(input = {}, options = {}) {
  checkNames(input, options);
  return encodeApart({assets, call: 'web_encode', encode: encodeWith}, input, options);
}

export async function encodeObject(mesh = {}, options = {}) {
  checkObjectNames(mesh, options);
  const encoder = {assets: objectAssets, call: 'web_encode_object', encode: encodeObjectWith};
  return encodeApart(encoder, mesh, options);
}
