// SPDX-License-Identifier: Apache-2.0
// A sequence that is open, as users have it: what a Terrain is, of frames in groups that are
// fetched and decoded as they are asked for.
import {TksError} from './error.js';
import {Groups} from './groups.js';
import {HeldGroups} from './held_groups.js';
import {checkBytes, checkFrame} from './limits.js';
import {FIRST_BYTES} from './pace.js';

/** Made by open() and openLive(). */
export class Sequence {
  isSequence = true;
  #source;
  #groups;
  #held;
  #decoder;
  #current = null;  // the terrain of the group that was asked for last
  #appending = Promise.resolve();

  /** `options`: {another, requestBytes}, as HeldGroups takes them. */
  constructor(source, decoder, options) {
    this.#source = source;
    this.#decoder = decoder;
    this.#groups = new Groups(source, decoder);
    this.#held = new HeldGroups(source, this.#groups, decoder, options);
  }

  get info() {
    return this.#current?.info ?? null;
  }
  get loaded() {
    return this.#current?.loaded ?? {requests: this.#source.requests, bytes: 0, ranges: []};
  }
  get truncated() {
    return this.#current?.truncated ?? false;
  }
  get fileBytes() {
    return this.#source.size;
  }
  get clock() {
    return this.#groups.clock;
  }
  get firstFrame() {
    return this.#groups.firstFrame;
  }
  get frames() {
    return this.#groups.frames;
  }
  get times() {
    return this.#groups.times;
  }

  /** Of a file that begins with these bytes. */
  async begin(first, signal) {
    const found = await this.#groups.begin(first, signal);
    await this.#beginAt(found, signal);
  }
  /** Of a sequence that was cut out of another one the first groups may go on from what is gone. */
  async #beginAt(found, signal) {
    const {firstFrame, times} = found.group, next = firstFrame + times.length;
    try {
      await this.#use(found, {bytes: 0, signal}, () => {});
    } catch (error) {
      if (error.code !== 'truncated' || next >= this.frames) throw error;
      await this.#beginAt(
        await this.#groups.find(next, false, {bytes: FIRST_BYTES, signal}), signal);
    }
  }
  /** Of a live one: the bytes that follow those before. */
  append(bytes) {
    const appended = this.#appending.then(async () => {
      if (!this.#source.append) {
        throw new TksError('usage', 'append() is for a sequence of openLive().');
      }
      this.#source.append(bytes.slice());
      await this.#groups.walk();
      return this.frames;
    });
    this.#appending = appended;
    appended.catch(() => {});
    return appended;
  }
  forget(frame) {
    this.#source.forget?.(this.#groups.forget(frame));
  }

  async at(time, {signal} = {}) {
    if (typeof time !== 'number' || Number.isNaN(time)) {
      throw new TksError('usage', '`time` is a number of ticks.');
    }
    this.#checkBegun();
    const {group} = await this.#groups.find(time, true, {bytes: FIRST_BYTES, signal});
    const later = group.times.findIndex((each) => each > time);
    const before = later < 0 ? group.times.length - 1 : Math.max(later - 1, 0);
    return group.firstFrame + before;
  }
  async group(frame, {signal} = {}) {
    this.#checkFrame(frame);
    const {group} = await this.#groups.find(frame, false, {bytes: FIRST_BYTES, signal});
    const {firstFrame, times, streamBytes} = group;
    return {firstFrame, endFrame: firstFrame + times.length, bytes: streamBytes};
  }
  #checkFrame(frame) {
    this.#checkBegun();
    checkFrame(frame, this.firstFrame, this.frames);
  }
  #checkBegun() {
    if (this.frames > this.firstFrame) return;
    throw new TksError('usage', 'There is no frame yet: append() brings some.');
  }

  /** Calls use(terrain, i) with the group of a frame, the i-th of it. `asked`: {bytes, signal}. */
  async #of(frame, asked, use) {
    this.#checkFrame(frame);
    const found = await this.#groups.find(frame, false, asked);
    const i = frame - found.group.firstFrame;
    if (i >= found.group.times.length) {
      throw new TksError('usage', `The sequence has no frame ${frame}.`);
    }
    return this.#use(found, asked, (terrain) => use(terrain, i));
  }
  #use(found, asked, use) {
    return this.#held.with(found, asked, (terrain) => {
      this.#current = terrain;
      return use(terrain);
    });
  }
  #numbered(made, frame) {
    return {...made, number: frame, time: this.times[frame]};
  }

  async load(bytes, {frame = this.firstFrame, ...options} = {}) {
    checkBytes(bytes);
    return this.#of(frame, firstOf({...options, bytes}),
      (terrain) => terrain.load(bytes, options));
  }
  async decode({frame = this.firstFrame, bytes = Infinity, ...options} = {}) {
    checkBytes(bytes);
    const made = await this.#of(frame, firstOf({...options, bytes}),
      (terrain, i) => terrain.decode({...options, bytes, frame: i}));
    return this.#numbered(made, frame);
  }
  async *refine({frame = this.firstFrame, ...options} = {}) {
    const [terrain, i] =
      await this.#of(frame, {bytes: FIRST_BYTES, signal: options.signal}, (...found) => found);
    for await (const made of terrain.refine({...options, frame: i})) {
      yield this.#numbered(made, frame);
    }
  }
  async needed({frame = this.firstFrame, ...options} = {}) {
    return this.#of(frame, {bytes: FIRST_BYTES}, (terrain) => terrain.needed(options));
  }

  dispose() {
    this.#source.close();
    this.#held.dispose();
    this.#decoder.dispose();
  }
  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.dispose();
  }
}

/** How many bytes of a group are asked for with its head: a plan for a view chooses others. */
const firstOf = ({view, bytes, signal}) => ({bytes: view?.clip ? FIRST_BYTES : bytes, signal});
