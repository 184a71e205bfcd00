// SPDX-License-Identifier: Apache-2.0
// Plays the frames of a sequence: each is decoded while the one before is shown, and the first one
// of the next group while this one plays.
import {framesOf, rateOf} from './frame_time.js';

/** Resolves after so many ms, or rejects when the signal aborts. */
const wait = (ms, signal) => new Promise((resolve, reject) => {
  signal.throwIfAborted();
  const timer = setTimeout(resolve, ms);
  signal.addEventListener('abort', () => {
    clearTimeout(timer);
    reject(signal.reason);
  }, {once: true});
});

export class Player {
  /** Of the frame that is shown. */
  number = 0;
  speed = 1;
  loops = true;
  #decode;
  #show;
  #fail;
  #onend;
  #terrain = null;
  #stop = null;  // of what is being played
  #prepared = null;  // the frame whose group was decoded ahead

  /** `decode({frame, signal, isSoon})` gives a frame, of few bytes where it is to be soon;
   * `show(frame)` draws it; `fail(error)` hears why there is none; `onend()` is called behind the
   * last one that is played. */
  constructor({decode, show, fail, onend}) {
    [this.#decode, this.#show, this.#fail, this.#onend] = [decode, show, fail, onend];
  }
  begin(terrain, number) {
    this.pause();
    [this.#terrain, this.number, this.#prepared] = [terrain, number, null];
  }

  get isPlaying() {
    return this.#stop !== null && this.#stop.plays;
  }
  pause() {
    this.#stop?.abort();
    this.#stop = null;
  }
  /** A new signal; what went on before ends. */
  #begin(plays) {
    this.pause();
    this.#stop = Object.assign(new AbortController(), {plays});
    return this.#stop.signal;
  }
  /** What grows has no end to begin anew behind. */
  get #loops() {
    return this.loops && !this.#terrain.isLive;
  }
  /** The frame behind this one; null: it is the last. */
  #after(number) {
    const {first, end} = framesOf(this.#terrain);
    return number + 1 < end ? number + 1 : this.#loops ? first : null;
  }
  /** Milliseconds until the next frame, or as many as since the one before. */
  get #period() {
    const {clock, times} = this.#terrain, {number} = this;
    const first = times[number + 1] === undefined ? number - 1 : number;
    return 1000 / (rateOf(clock, times[first], times[first + 1]) * this.speed);
  }

  async play() {
    const signal = this.#begin(true), {first, end} = framesOf(this.#terrain);
    const ask = (number) => {
      const asked = this.#decodeFrom(number, signal);
      asked.catch(() => {});
      return asked;
    };
    try {
      let coming = ask(this.number + 1 < end ? this.number + 1 : first);
      for (let due = performance.now(); coming; due = Math.max(due, performance.now())) {
        const frame = await coming, next = this.#after(frame.number);
        coming = next === null ? null : ask(next);
        this.#prepare(frame.number, ask).catch(() => {});  // the frame itself will tell
        await wait(due - performance.now(), signal);
        this.#shown(frame);
        due += this.#period;
      }
      this.#stop = null;
      this.#onend();
    } catch (error) {
      this.#failed(signal, error);
    }
  }
  /** A frame; where groups are gone that it goes on from, the first one of a later group. */
  async #decodeFrom(number, signal) {
    try {
      return await this.#decode({frame: number, signal});
    } catch (error) {
      if (error.code !== 'truncated') throw error;
      const {endFrame} = await this.#terrain.group(number);
      if (endFrame >= framesOf(this.#terrain).end) throw error;
      return this.#decodeFrom(endFrame, signal);
    }
  }
  #failed(signal, error) {
    if (signal.aborted) return;
    this.#stop = null;
    this.#fail(error);
  }
  #shown(frame) {
    this.number = frame.number;
    this.#show(frame);
  }
  /** Has the group behind that of a frame decoded. */
  async #prepare(number, ask) {
    const {first, end} = framesOf(this.#terrain), group = await this.#terrain.group(number);
    const isLast = group.endFrame >= end, next = isLast ? first : group.endFrame;
    const isOnly = isLast && group.firstFrame === first;
    if (isOnly || (isLast && !this.#loops) || next === this.#prepared) return;
    this.#prepared = next;
    ask(next);
  }

  /** Shows a frame, and plays on from it if frames were playing. */
  async seek(number) {
    const {isPlaying} = this, signal = this.#begin(isPlaying);
    this.number = number;
    try {
      const frame = await this.#decode({frame: number, signal, isSoon: !isPlaying});
      signal.throwIfAborted();
      if (!isPlaying) this.#stop = null;
      this.#shown(frame);
      if (isPlaying) this.play();
    } catch (error) {
      this.#failed(signal, error);
    }
  }
}
