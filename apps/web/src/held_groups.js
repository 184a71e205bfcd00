// SPDX-License-Identifier: Apache-2.0
// The groups of a sequence that are decoded: two at a time, so that the next one is made while
// frames of the first are shown. Each other one takes the decoder of the one that was used longest
// ago.
import {abortable} from './abort.js';
import {askDecoder} from './decoders.js';
import {TksError} from './error.js';
import {endOf, entryOf} from './groups.js';
import {FIRST_BYTES} from './pace.js';
import {BegunSource, SliceSource} from './slice_source.js';
import {Terrain} from './terrain.js';

const MOST_HELD = 2;

/** A decoder that serves one group, until dispose(): then it serves another. */
class Lease {
  #decoder;
  #isOver = false;
  /** `prepare(lease)` readies the decoder. */
  constructor(decoder, prepare) {
    this.#decoder = decoder;
    this.ready = prepare(this);
    this.ready.catch(() => {});
  }
  async call(operation, argument, signal) {
    this.check();
    return this.#decoder.call(operation, argument, signal);
  }
  check() {
    if (!this.#isOver) return;
    throw new TksError('usage', 'Frames of more groups were asked for meanwhile than are held.');
  }
  dispose() {
    this.#isOver = true;
  }
}

class Slot {
  group = null;
  terrain = null;
  users = 0;
  used = 0;  // when
  #decoder;
  #groups;
  #chain = {begin: 0, end: 0};  // where the groups lie that the decoder can go on from
  constructor(decoder, groups) {
    [this.#decoder, this.#groups] = [decoder, groups];
  }
  /** Has a group in the place of the one before. `stream`: its first bytes that are here. */
  hold(file, {group, stream = new Uint8Array()}, {bytes, requestBytes}) {
    this.terrain?.dispose();
    const known = stream.subarray(0, group.streamBytes);
    const slice = new SliceSource(file, group.streamOffset, group.streamBytes);
    const lease = new Lease(this.#decoder, (its) => this.#prepare(group, its));
    this.terrain = new Terrain(new BegunSource(slice, known), lease, requestBytes);
    this.group = group;
    this.opened = this.#open(lease, Math.max(bytes, known.length || FIRST_BYTES));
    this.opened.catch(() => this.#release(group));
  }
  /** Gives the decoder what it lacks of the groups that this one goes on from. */
  async #prepare(group, lease) {
    const begin = entryOf(group), chain = this.#chain;
    const goesOn = chain.begin === begin && chain.end <= group.offset;
    const from = goesOn ? chain.end : begin;
    const streams = from < group.offset ? await this.#groups.streamsBefore(group, from) : [];
    lease.check();
    this.#chain = {begin, end: group.offset};
    return askDecoder(this.#decoder, 'forget', {goesOn, streams});
  }
  async #open(lease, bytes) {
    const {terrain, group} = this;
    await lease.ready;
    await terrain.begin(undefined, bytes);
    if (terrain.info.frames === group.times.length) return terrain;
    throw new TksError('corrupt', 'Corrupt sequence: a group has another number of frames than ' +
      'its head says.');
  }
  #release(group) {
    if (this.group === group) this.group = null;
  }
  dispose() {
    this.terrain?.dispose();
    this.#decoder.dispose();
  }
}

export class HeldGroups {
  #file;
  #groups;
  #goesOn = false;  // a group of the sequence does, from the one before
  #requestBytes;
  #slots;
  #another;  // starts a decoder; null: there is to be one
  #uses = 0;
  #waiting = [];  // who waits for a slot

  /** `another()` starts a decoder beside the first one, or gives none. */
  constructor(file, groups, decoder, {another, requestBytes}) {
    [this.#file, this.#groups] = [file, groups];
    [this.#another, this.#requestBytes] = [another, requestBytes];
    this.#slots = [new Slot(decoder, groups)];
  }

  /** What `use` gives of the terrain of a group, which is held meanwhile. `found`: {group, stream};
   * `bytes`: how many of it are wanted. */
  async with(found, {bytes, signal}, use) {
    const slot = await this.#slotFor(found, bytes);
    try {
      return await use(await abortable(slot.opened, signal));
    } finally {
      --slot.users;
      for (const go of this.#waiting.splice(0)) go();
    }
  }
  /** Holds a group, and counts one user more. */
  async #slotFor(found, bytes) {
    for (;;) {
      const isHeld = ({group}) => group?.offset === found.group.offset;
      const slot = this.#slots.find(isHeld) ?? this.#freeSlot();
      if (slot) {
        slot.used = ++this.#uses;
        ++slot.users;
        if (!isHeld(slot)) {
          slot.hold(this.#file, found, {bytes, requestBytes: this.#requestBytes});
          this.#keep();
        }
        return slot;
      }
      await new Promise((resolve) => this.#waiting.push(resolve));
    }
  }
  /** Has the file keep what the groups behind those that are held go on from, if they do. */
  #keep() {
    const held = this.#slots.flatMap(({group}) => group ?? []);
    this.#goesOn ||= held.some(({depth}) => depth > 0);
    const keeps = this.#goesOn || held.every(({number}) => number === 0);  // nobody knows yet
    this.#file.keep?.(keeps ? held.map((group) => [entryOf(group), endOf(group)]) : []);
  }
  #freeSlot() {
    const empty = this.#slots.find(({group, users}) => !group && users === 0);
    if (empty) return empty;
    const decoder = this.#slots.length < MOST_HELD ? this.#another?.() : null;
    if (decoder) this.#slots.push(new Slot(decoder, this.#groups));
    if (decoder) return this.#slots.at(-1);
    return this.#slots.filter(({users}) => users === 0).sort((a, b) => a.used - b.used)[0];
  }
  dispose() {
    for (const slot of this.#slots) slot.dispose();
  }
}
