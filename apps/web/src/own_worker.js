// SPDX-License-Identifier: Apache-2.0
// A worker of this package, with the calls of Worker that the package makes. Where a bundler has
// left its file behind, or that lies at another origin, the source that is packed in a script
// (dist/packed.js) takes its place.

const addresses = new Map();  // of packed sources, by their assets

async function addressOf(assets) {
  const {worker} = await assets.packed();
  if (!addresses.has(assets)) {
    const source = new Blob([worker], {type: 'text/javascript'});
    addresses.set(assets, URL.createObjectURL(source));
  }
  return addresses.get(assets);
}

export class OwnWorker {
  #assets;
  #worker = null;
  #unanswered = [];  // messages, until a first answer tells that the worker runs
  #isPacked = false;
  #isEnded = false;

  /** `worker`: the one of its own file; null: that may not be started. */
  constructor(worker, assets) {
    this.#assets = assets;
    if (worker) this.#use(worker);
    else this.#replace();
  }
  #use(worker) {
    this.#worker = worker;
    worker.onmessage = (event) => {
      this.#unanswered = null;
      this.onmessage(event);
    };
    worker.onerror = (event) => {
      if (!this.#unanswered || this.#isPacked) return this.onerror(event);
      event.preventDefault();
      this.#replace();
    };
    for (const message of this.#unanswered) worker.postMessage(message);
  }
  async #replace() {
    [this.#worker, this.#isPacked] = [null, true];
    try {
      const address = await addressOf(this.#assets);
      if (!this.#isEnded) this.#use(new Worker(address));
    } catch (error) {
      this.onerror(error);
    }
  }

  postMessage(message) {
    this.#unanswered?.push(message);
    this.#worker?.postMessage(message);
  }
  terminate() {
    this.#isEnded = true;
    this.#worker?.terminate();
  }
}
