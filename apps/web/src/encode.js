// SPDX-License-Identifier: Apache-2.0
// Encodes in the browser: the encoder is a module of its own, loaded when it is first used.
import {encodeApart} from './encode_apart.js';
import {assets} from './encode_assets.js';
import {checkNames} from './encode_names.js';
import {encodeWith} from './encoder.js';

export {encodeObject} from './encode_object.js';
export {TksError} from './error.js';

export async function encode(input = {}, options = {}) {
  checkNames(input, options);
  return encodeApart({assets, call: 'web_encode', encode: encodeWith}, input, options);
}
