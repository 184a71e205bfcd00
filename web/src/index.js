// SPDX-License-Identifier: Apache-2.0
// The core of the package: opens streams. It knows no renderer.
import {groundAxes} from './axes.js';
import {startDecoder} from './decoders.js';
import {TksError} from './error.js';
import {groundScale} from './ground.js';
import {FIRST_FRAME} from './pace.js';
import {sourceOf} from './source.js';
import {Terrain} from './terrain.js';

export {FIRST_FRAME, TksError, groundAxes, groundScale};

/** What a request costs beside its own: 50 ms at 10 Mb/s, shared by the dozen sent at a time. */
const REQUEST_BYTES = 4096;

export async function open(input, options = {}) {
  const {signal, request, requestBytes = REQUEST_BYTES} = options;
  signal?.throwIfAborted();
  const source = sourceOf(input, request);
  const terrain = new Terrain(source, options.decoder ?? startDecoder(options), requestBytes);
  try {
    await terrain.begin(signal);
    return terrain;
  } catch (error) {
    terrain.dispose();
    throw error;
  }
}
