// SPDX-License-Identifier: Apache-2.0
// The calls of one decoder, one after another, on whichever thread. Between them and between the
// parts of a frame messages come through, and a call whose signal has aborted goes no further.
import {ReceivingDecoder} from './receiving_decoder.js';
import {Decoder} from './stream_decoder.js';

const messages = () => new Promise((resolve) => setTimeout(resolve));

export class Operations {
  #decoder;
  #last = Promise.resolve();

  /** `receives`: of what a receiver gets, in place of one stream. */
  constructor({module, memory, receives}) {
    this.#decoder = new (receives ? ReceivingDecoder : Decoder)(module, memory);
  }

  /** Resolves to what this method of the decoder gives. */
  call(method, argument, signal) {
    const result = this.#last.then(() => this.#run(method, argument, signal));
    this.#last = result.catch(() => {});
    return result;
  }
  async #run(method, argument, signal) {
    signal?.throwIfAborted();
    if (method !== 'decode') return this.#decoder[method](argument);
    const parts = this.#decoder.parts(argument);
    for (;;) {
      const {done, value} = parts.next();
      if (done) return value;
      await messages();
      signal?.throwIfAborted();
    }
  }
}
