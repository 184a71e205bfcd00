// SPDX-License-Identifier: Apache-2.0
// Encodes in the browser: terrain by one module, meshes by another, each loaded when it is first
// used.
import {encodeApart} from './encode_apart.js';
import {assets, objectAssets} from './encode_assets.js';
import {checkNames, checkObjectNames} from './encode_names.js';
import {located} from './encoder_calls.js';

export {TksError} from './error.js';

export async function encode(input = {}, options = {}) {
  checkNames(input, options);
  return encodeApart(assets, 'web_encode', options,
    async (ask) => ask('web_encode', await located(input, ask)));
}

export async function encodeObject(mesh = {}, options = {}) {
  checkObjectNames(mesh, options);
  return encodeApart(objectAssets, 'web_encode_object', options,
    (ask) => ask('web_encode_object', mesh));
}
