// SPDX-License-Identifier: Apache-2.0
// A source of a file whose groups go on from those before: what it brought of these is kept, so
// that nothing is asked for twice.
import {joined} from './pieces.js';
import {gapsIn} from './ranges.js';

export class KeptSource {
  #file;
  #keeps = true;
  #pieces = [];  // {begin, end, bytes}, in their order, none of which overlap
  /** `first`: bytes of the file that are here. */
  constructor(file, first) {
    this.#file = file;
    this.#add(0, first);
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
  /** Gives up what is not in these ranges. What comes is kept until the next call, if there are
   * any. */
  keep(ranges) {
    this.#keeps = ranges.length > 0;
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
    if (from > begin) await take(this.#kept(begin, from));
    let place = from;
    if (from >= end) return;
    await this.#file.next(from, end, async (piece) => {
      this.#add(place, piece);
      place += piece.length;
      await take(piece);
    }, signal);
  }
  /** Asks once: for all between the first byte that is missing and the last one. */
  async scattered(begin, end, signal) {
    const gaps = this.#gaps(begin, end);
    if (gaps.length === 0) return this.#kept(begin, end);
    const from = gaps[0][0], to = gaps.at(-1)[1];
    const before = this.#kept(begin, from), behind = this.#kept(to, end);
    const bytes = await this.#file.scattered(from, to, signal);
    this.#add(from, bytes);
    return joined([before, bytes, behind]);
  }
  #kept(begin, end) {
    return joined(this.#pieces.filter((piece) => piece.begin < end && piece.end > begin)
      .map((piece) => piece.bytes.subarray(Math.max(begin - piece.begin, 0), end - piece.begin)));
  }
  close() {
    this.#pieces = [];
    this.#file.close();
  }
}
