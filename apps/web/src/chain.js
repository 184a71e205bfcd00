// SPDX-License-Identifier: Apache-2.0
// The streams of a run of groups, each of which goes on from the one before, in the module that
// opens the next one. They live here, so that an instance that aborted can be replaced.

export class Chain {
  #memory;
  #streams = [];
  #instance = null;
  #address = 0;  // in the instance
  #pushed = 0;  // of the streams

  constructor(memory) {
    this.#memory = memory;
  }

  /** Has further streams behind those that it has, or, unless it `goesOn`, in their place. What was
   * opened behind those is closed. */
  follow({goesOn, streams}) {
    if (!goesOn) {
      this.#instance?.calls.web_chain_free(this.#address);
      this.leave();
      this.#streams = [];
    }
    this.#streams.push(...streams);
  }
  /** Knows of no instance: the one before has aborted. */
  leave() {
    this.#instance = null;
  }
  /** Where all of them are in an instance. */
  addressIn(instance) {
    const {calls} = instance;
    if (this.#instance !== instance) {
      this.#instance = instance;
      [this.#address, this.#pushed] = [calls.web_chain_new(this.#memory), 0];
    }
    for (const stream of this.#streams.slice(this.#pushed)) {
      instance.with(stream.length, (data) => {
        instance.view(Uint8Array, data, stream.length).set(stream);
        calls.web_chain_push(this.#address, data, stream.length);
      });
      ++this.#pushed;
    }
    return this.#address;
  }
}
