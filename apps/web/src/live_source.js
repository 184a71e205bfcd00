// SPDX-License-Identifier: Apache-2.0
// Bytes that the caller hands over as they come, and of which the first ones may be given up.
import {gathered, inLarger} from './pieces.js';

export class LiveSource {
  requests = 0;
  sequential = false;
  size = 0;
  #pieces = [];  // {begin, bytes}, one behind the other

  append(bytes) {
    this.#pieces.push({begin: this.size, bytes});
    this.size += bytes.length;
  }
  /** Gives up pieces that end before a place. */
  forget(place) {
    const first = this.#pieces.findIndex(({begin, bytes}) => begin + bytes.length > place);
    this.#pieces.splice(0, first < 0 ? this.#pieces.length : first);
  }
  async next(begin, end, take) {
    return inLarger(take, (give) => this.#bring(begin, end, give));
  }
  async scattered(begin, end) {
    return gathered((take) => this.#bring(begin, end, take));
  }
  async #bring(begin, end, take) {
    for (const piece of this.#pieces) {
      const from = Math.max(begin - piece.begin, 0);
      const part = piece.bytes.subarray(from, Math.max(from, end - piece.begin));
      if (part.length > 0) await take(part);
    }
  }
  close() {
    this.#pieces = [];
  }
}
