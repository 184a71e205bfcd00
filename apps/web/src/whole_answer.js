// SPDX-License-Identifier: Apache-2.0
// The answer of a server that knows no ranges: the whole file, read as far as its bytes are asked
// for.

export class WholeAnswer {
  #reader;
  #place = 0;  // of the reader
  #left = null;  // of a piece that came

  /** `stop`: an AbortController of the request. */
  constructor(answer, stop) {
    this.#reader = answer.body.getReader();
    this.stop = stop;
  }

  /**
   * Gives `take` the bytes [begin, end), piece by piece; those before them are left out. Resolves
   * to where they end, which is the end of the file if that comes first.
   */
  async read(begin, end, take) {
    while (this.#place < end) {
      const piece = this.#left ?? (await this.#reader.read()).value;
      if (!piece) break;
      const size = Math.min(piece.length, end - this.#place);
      this.#left = size < piece.length ? piece.subarray(size) : null;
      const from = Math.max(begin - this.#place, 0);
      this.#place += size;
      if (from < size) await take(piece.subarray(from, size));
    }
    return this.#place;
  }
}
