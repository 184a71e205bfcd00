// SPDX-License-Identifier: Apache-2.0
// Sources within another one: a file whose first bytes are here already, and the stream of a group
// as a part of the file of a sequence.
import {TksError} from './error.js';

/** A source whose first bytes, `known`, were read. */
export class BegunSource {
  #file;
  #known;
  constructor(file, known) {
    [this.#file, this.#known] = [file, known];
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
  async next(begin, end, take, signal) {
    const known = this.#known.subarray(begin, end);
    if (known.length > 0) await take(known);
    const from = begin + known.length;
    if (from >= end) return;
    this.#known = new Uint8Array();  // they were taken
    await this.#file.next(from, end, take, signal);
  }
  scattered(begin, end, signal) {
    return this.#file.scattered(begin, end, signal);
  }
  close() {
    this.#file.close();
  }
}

/** So many bytes of a file from `offset` on; close() ends their requests alone. */
export class SliceSource {
  sequential = false;
  #file;
  #offset;
  #bytes;
  #stop = new AbortController();
  constructor(file, offset, bytes) {
    [this.#file, this.#offset, this.#bytes] = [file, offset, bytes];
  }

  get requests() {
    return this.#file.requests;
  }
  /** As far as the file reaches by now. */
  get size() {
    return Math.min(this.#bytes, Math.max(this.#file.size - this.#offset, 0));
  }
  #ended(signal) {
    return signal ? AbortSignal.any([signal, this.#stop.signal]) : this.#stop.signal;
  }
  /** A place of the file, in the slice. */
  #place(place) {
    return this.#offset + Math.min(place, this.#bytes);
  }
  next(begin, end, take, signal) {
    return this.#file.next(this.#place(begin), this.#place(end), take, this.#ended(signal));
  }
  scattered(begin, end, signal) {
    return this.#file.scattered(this.#place(begin), this.#place(end), this.#ended(signal));
  }
  close() {
    this.#stop.abort(new TksError('usage', 'This group of frames was given up for others.'));
  }
}
