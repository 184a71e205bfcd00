// SPDX-License-Identifier: Apache-2.0
// What a page may ask of a module that encodes, by name: each takes (module, input, progress).
import {encodeWith} from './encoder.js';
import {fitPositions, placesToFit} from './encoder_positions.js';
import {encodeObjectWith} from './object_encoder.js';

export const CALLS = {
  web_encode: encodeWith, web_encode_object: encodeObjectWith, placesToFit, fitPositions,
};
