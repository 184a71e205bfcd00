// SPDX-License-Identifier: Apache-2.0
// The groups of a sequence that are decoded: two at a time, so that the next one is made while
// frames of the first are shown. Each other one takes the decoder of the one that was used longest
// ago.
import {abortable} from './abort.js';
import {askDecoder} from './decoders.js';
import {TksError} from './error.js';
import {FIRST_BYTES} from './pace.js';
import {BegunSource, SliceSource} from './slice_source.js';
import {Terrain} from './terrain.js';

const MOST_HELD = 2;

/** A decoder that serves one group, until dispose(): then it serves another. */
class Lease {
  #decoder;
  #isOver = false;
  constructor(decoder) {
    this.#decoder = decoder;
    this.ready = askDecoder(decoder, 'forget');
    this.ready.catch(() => {});
  }
  async call(operation, argument, signal) {
    if (!this.#isOver) return this.#decoder.call(operation, argument, signal);
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
  constructor(decoder) {
    this.#decoder = decoder;
  }
  /** Has a group in the place of the one before. `stream`: its first bytes that are here. */
  hold(file, {group, stream = new Uint8Array()}, {bytes, requestBytes}) {
    this.terrain?.dispose();
    const known = stream.subarray(0, group.streamBytes);
    const slice = new SliceSource(file, group.streamOffset, group.streamBytes);
    this.terrain =
      new Terrain(new BegunSource(slice, known), new Lease(this.#decoder), requestBytes);
    this.group = group;
    this.opened = this.#open(group, Math.max(bytes, known.length || FIRST_BYTES));
    this.opened.catch(() => this.#release(group));
  }
  async #open(group, bytes) {
    const {terrain} = this;
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
  #requestBytes;
  #slots;
  #another;  // starts a decoder; null: there is to be one
  #uses = 0;
  #waiting = [];  // who waits for a slot

  /** `another()` starts a decoder beside the first one, or gives none. */
  constructor(file, decoder, {another, requestBytes}) {
    [this.#file, this.#another, this.#requestBytes] = [file, another, requestBytes];
    this.#slots = [new Slot(decoder)];
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
        }
        return slot;
      }
      await new Promise((resolve) => this.#waiting.push(resolve));
    }
  }
  #freeSlot() {
    const empty = this.#slots.find(({group, users}) => !group && users === 0);
    if (empty) return empty;
    const decoder = this.#slots.length < MOST_HELD ? this.#another?.() : null;
    if (decoder) this.#slots.push(new Slot(decoder));
    if (decoder) return this.#slots.at(-1);
    return this.#slots.filter(({users}) => users === 0).sort((a, b) => a.used - b.used)[0];
  }
  dispose() {
    for (const slot of this.#slots) slot.dispose();
  }
}
