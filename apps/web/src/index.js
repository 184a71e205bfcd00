// SPDX-License-Identifier: Apache-2.0
// The core of the package: opens streams. It knows no renderer.
import {groundAxes} from './axes.js';
import {startDecoder} from './decoders.js';
import {TksError} from './error.js';
import {goesRound} from './globe.js';
import {groundScale} from './ground.js';
import {FIRST_FRAME} from './pace.js';
import {sourceOf} from './source.js';
import {Terrain} from './terrain.js';

export {FIRST_FRAME, TksError, goesRound, groundAxes, groundScale};

export async function open(input, options = {}) {
  const {signal, request, requestBytes} = options;
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
