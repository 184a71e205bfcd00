// SPDX-License-Identifier: Apache-2.0
// The core of the package: opens streams, and sequences of them. It knows no renderer.
import {groundAxes} from './axes.js';
import {startDecoder} from './decoders.js';
import {TksError} from './error.js';
import {goesRound} from './globe.js';
import {groundScale} from './ground.js';
import {KeptSource} from './kept_source.js';
import {LiveSource} from './live_source.js';
import {FIRST_BYTES, FIRST_FRAME} from './pace.js';
import {gathered} from './pieces.js';
import {Reception} from './reception.js';
import {Sequence} from './sequence.js';
import {BegunSource} from './slice_source.js';
import {anyOrder, sourceOf} from './source.js';
import {Terrain} from './terrain.js';
import {isSequence} from './url_source.js';

export {FIRST_FRAME, TksError, goesRound, groundAxes, groundScale};

/** A Worker of the caller's serves one decoder. */
function anotherOf({decoder, signal, ...options}) {
  const isOne = typeof options.worker === 'object' && !(options.worker instanceof URL);
  return () => (isOne ? null : startDecoder(options));
}

/** `decoder`: of options, where the caller has started it. */
function sequenceOf(source, decoder, options) {
  const {requestBytes} = options;
  return new Sequence(source, decoder, {another: anotherOf(options), requestBytes});
}

export async function open(input, options = {}) {
  const {signal, request, requestBytes} = options;
  signal?.throwIfAborted();
  const source = sourceOf(input, request), decoder = options.decoder ?? startDecoder(options);
  let opened = {dispose() {
    source.close();
    decoder.dispose();
  }};
  try {
    const first = await gathered((take) => source.next(0, FIRST_BYTES, take, signal));
    if (isSequence(first)) {
      const kept = new KeptSource(await anyOrder(source, first, signal), first);
      opened = sequenceOf(kept, decoder, options);
      await opened.begin(first, signal);
    } else {
      opened = new Terrain(new BegunSource(source, first), decoder, requestBytes);
      await opened.begin(signal);
    }
    return opened;
  } catch (error) {
    opened.dispose();
    throw error;
  }
}

export async function openLive(options = {}) {
  return sequenceOf(new LiveSource(), startDecoder(options), options);
}

export async function receive(url, {signal, ...options} = {}) {
  signal?.throwIfAborted();
  const decoder = startDecoder({...options, receives: true});
  let reception = decoder;
  try {
    reception = new Reception(url, decoder, options);
    await reception.begin(signal);
    return reception;
  } catch (error) {
    reception.dispose();
    throw error;
  }
}
