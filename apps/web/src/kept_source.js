// SPDX-License-Identifier: Apache-2.0
// A source of a file whose groups go on from those before: what it brought of these is kept, so
// that nothing is asked for twice.
import {joined} from './pieces.js';
import {gapsIn} from './ranges.js';

export class KeptSource {
  #file;
  #keeps = false;
  #pieces = [];  // {begin, end, bytes}, in their order, none of which overlap
  constructor(file) {
    this.#file = file;
  }

  get requests() {
    return this.#file.requests;
  }
  get sequential() {
    return this.#file.sequential;
  }
  get size() {
    return this.#file.size;
  }
  /** From now on all that comes is kept, until a later call does not have it in its ranges. */
  keep(ranges) {
    this.#keeps = true;
    this.#pieces = this.#pieces.filter((piece) =>
      ranges.some(([begin, end]) => piece.begin < end && piece.end > begin));
  }
  #add(place, bytes) {
    if (!this.#keeps) return;
    for (const [begin, end] of this.#gaps(place, place + bytes.length)) {
      this.#pieces.push({begin, end, bytes: bytes.subarray(begin - place, end - place)});
    }
    this.#pieces.sort((a, b) => a.begin - b.begin);
  }
  #gaps(begin, end) {
    return gapsIn(this.#pieces.map((piece) => [piece.begin, piece.end]), begin, end);
  }

  async next(begin, end, take, signal) {
    const [[from] = [end]] = this.#gaps(begin, end);
    if (from > begin) await take(await this.scattered(begin, from));
    let place = from;
    if (from >= end) return;
    await this.#file.next(from, end, async (piece) => {
      this.#add(place, piece);
      place += piece.length;
      await take(piece);
    }, signal);
  }
  async scattered(begin, end, signal) {
    const kept = this.#pieces.filter((piece) => piece.begin < end && piece.end > begin);
    const brought = await Promise.all(this.#gaps(begin, end).map(async ([from, to]) => {
      const bytes = await this.#file.scattered(from, to, signal);
      this.#add(from, bytes);
      return {begin: from, bytes};
    }));
    const all = [...kept, ...brought].sort((a, b) => a.begin - b.begin);
    return joined(all.map(({begin: place, bytes}) =>
      bytes.subarray(Math.max(begin - place, 0), Math.max(end - place, 0))));
  }
  close() {
    this.#pieces = [];
    this.#file.close();
  }
}
