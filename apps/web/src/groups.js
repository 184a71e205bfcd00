// SPDX-License-Identifier: Apache-2.0
// The groups of a sequence, as far as their heads were read: where each lies in the file, and which
// frames it has at which times. The indices at the ends of groups lead to the others.
import {askDecoder} from './decoders.js';
import {TksError} from './error.js';
import {FIRST_BYTES} from './pace.js';

/** Of the end of a file: most groups with an index end in it. */
const TAIL_BYTES = 2 ** 16;
/** Heads take no more, but for long texts and far frames. */
const HEAD_BYTES = 512;
/** An index leads to any group through one more index at most. */
const MOST_INDICES = 2;

const endFrame = ({firstFrame, times}) => firstFrame + times.length;
export const endOf = ({offset, bytes}) => offset + bytes;

/** How many of a rising list are not greater. */
function countUpTo(list, value, of) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (of(list[middle]) <= value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** What a head at a place tells. */
function groupOf({bytes, streamHeaderBytes, indexBytes, ...head}, offset) {
  return {
    ...head, offset, bytes: bytes + head.streamBytes + indexBytes, streamOffset: offset + bytes,
  };
}

/** Where the groups begin that one goes on from, and the number of the first of these. */
export const entryOf = ({offset, bytesBack}) => offset - bytesBack;
const entryNumber = ({number, depth}) => number - depth;

/** Whether a group can follow another one in the file, be it with groups between them. */
function follows(a, b) {
  const isLink = b.depth === 0 || b.number !== a.number + 1 ||
    (b.depth === a.depth + 1 && b.bytesBack === a.bytesBack + a.bytes);
  return isLink && a.number < b.number && endFrame(a) <= b.firstFrame &&
    a.times.at(-1) < b.times[0] && JSON.stringify(a.clock) === JSON.stringify(b.clock);
}

export class Groups {
  clock = null;
  firstFrame = 0;
  /** The number of the last frame, and one. */
  frames = 0;
  /** Of each frame whose group is known. */
  times = [];
  #source;
  #decoder;
  #known = [];  // in their order
  #tail = null;  // {tail, end}, as locate() takes them
  #reading = new Map();  // promises of heads, by their places
  #end = 0;  // of the last group, where groups are passed one by one

  constructor(source, decoder) {
    [this.#source, this.#decoder] = [source, decoder];
  }

  /** Of a file that begins with these bytes. */
  async begin(first, signal) {
    const head = await this.#headAt(0, {bytes: first, signal});
    if (!head) throw new TksError('truncated', 'The file is cut short: it ends before a frame.');
    this.#add(head.group);
    const {size} = this.#source;
    let end = endOf(head.group);
    if (end < size && size < Infinity) end = await this.#readTail(size, end, signal);
    await this.walk(end, signal);
    return head;
  }
  /** Where the last group ends that an index tells of; `end`: none does. */
  async #readTail(size, end, signal) {
    const begin = Math.max(end, size - TAIL_BYTES);
    const asked = {tail: await this.#source.scattered(begin, size, signal), end: size};
    const last = await this.#ask('locate', {...asked, byTime: false, place: Infinity}, signal);
    if (!last) return end;
    this.#tail = asked;
    this.frames = last.frames;
    return last.lastEnd;
  }
  /** Passes from head to head, from one at `place` on, as far as frames can be decoded. */
  async walk(place = this.#end, signal = undefined) {
    for (;;) {
      this.#end = place;
      if (place >= this.#source.size) return;
      const head = await this.#headAt(place, {signal});
      if (!head) return;
      this.#add(head.group);
      place = endOf(head.group);
    }
  }

  #ask(operation, argument, signal) {
    return askDecoder(this.#decoder, operation, argument, signal);
  }
  /** {group, stream} of the group at a place, of which these bytes are here, or `wanted` are to
   * come. `stream`: those of its stream. null: the file ends before the header of that does. */
  async #headAt(offset, {bytes, wanted = FIRST_BYTES, signal}, most = FIRST_BYTES) {
    const here = bytes ??
      (await this.#source.scattered(offset, offset + Math.max(wanted, most), signal));
    try {
      const head = await this.#ask('head', here.slice(0, most), signal);
      if (head.bytes + head.streamHeaderBytes > this.#source.size - offset) return null;
      return {group: groupOf(head, offset), stream: here.subarray(head.bytes)};
    } catch (error) {
      if (error.code !== 'truncated') throw error;
      if (here.length <= most && offset + here.length >= this.#source.size) return null;
      const more = Math.max(2 * most, error.needed);
      return this.#headAt(offset, {bytes: here.length > most ? here : null, wanted, signal}, more);
    }
  }
  #add(group) {
    const place = countUpTo(this.#known, group.offset, ({offset}) => offset);
    const before = this.#known[place - 1], after = this.#known[place];
    if (before?.offset === group.offset) return;
    if ((before && !follows(before, group)) || (after && !follows(group, after))) {
      throw new TksError('corrupt', 'Corrupt sequence: a group does not follow the one before it.');
    }
    if (this.#known.length === 0) [this.clock, this.firstFrame] = [group.clock, group.firstFrame];
    this.#known.splice(place, 0, group);
    this.frames = Math.max(this.frames, endFrame(group));
    group.times.forEach((time, i) => (this.times[group.firstFrame + i] = time));
  }

  /** The known group that holds a place; nothing where there may be a later one. */
  #knownAt(place, byTime) {
    const first = byTime ? ({times}) => times[0] : ({firstFrame}) => firstFrame;
    const i = countUpTo(this.#known, place, first) - 1;
    const group = this.#known[Math.max(i, 0)], after = this.#known[i + 1];
    const last = byTime ? group.times.at(-1) : endFrame(group) - 1;
    const isLast = endFrame(group) === this.frames || after?.offset === endOf(group);
    return i < 0 || place <= last || isLast ? group : null;
  }
  /**
   * {group, stream} of a frame or, `byTime`, of a time; places before the first frame or behind the
   * last one are those. `asked`: {bytes, signal}, how many bytes of the group are wanted; `stream`:
   * those of its stream that came with its head.
   */
  async find(place, byTime, asked) {
    const known = this.#knownAt(place, byTime);
    if (known) return {group: known};
    const range = this.#nextTo(place, byTime) ?? (await this.#locate(place, byTime, asked.signal));
    const reading = this.#reading.get(range.begin);
    if (reading) return reading.catch(() => {}).then(() => this.find(place, byTime, asked));
    const wanted = Math.min(asked.bytes + HEAD_BYTES, range.end - range.begin);
    return this.#read(range.begin, wanted, asked.signal);
  }
  /** One at a time of a group: others wait for it. */
  async #read(begin, wanted, signal) {
    const reading = this.#headAt(begin, {wanted, signal});
    this.#reading.set(begin, reading);
    try {
      const head = await reading;
      if (!head) throw new TksError('corrupt', 'Corrupt sequence: an index leads to no group.');
      this.#add(head.group);
      return head;
    } finally {
      this.#reading.delete(begin);
    }
  }
  /** The group behind one that is known, which is taken to be about as long. */
  #nextTo(place, byTime) {
    const before = this.#known[countUpTo(this.#known, place, endFrame) - 1];
    if (byTime || !before || endFrame(before) !== place) return null;
    const begin = endOf(before);
    return {begin, end: begin + before.bytes};
  }
  async #locate(place, byTime, signal) {
    let asked = this.#tail;
    for (let indices = 0; asked && indices < MOST_INDICES; ++indices) {
      const range = await this.#ask('locate', {...asked, byTime, place}, signal);
      if (range?.found) return range;
      asked = range &&
        {tail: await this.#source.scattered(range.begin, range.end, signal), end: range.end};
    }
    throw new TksError('corrupt', 'Corrupt sequence: its indices do not lead to all groups.');
  }

  /** The streams of the groups from a place on that one goes on from. */
  async streamsBefore(group, from) {
    const isLink = (before) => entryOf(before) === entryOf(group) &&
      entryNumber(before) === entryNumber(group);
    const run = this.#knownRun(from, group.offset) ?? (await this.#readRun(from, group.offset));
    if (!run?.every(isLink)) {
      throw new TksError('truncated', `Group ${group.number} of the sequence goes on from group ` +
        `${entryNumber(group)}, which is not there.`);
    }
    return Promise.all(run.map(({streamOffset, streamBytes}) =>
      this.#source.scattered(streamOffset, streamOffset + streamBytes)));
  }
  /** The groups in [begin, end) of the file, if all are known. */
  #knownRun(begin, end) {
    const first = countUpTo(this.#known, begin - 1, ({offset}) => offset);
    const run = this.#known.slice(first, countUpTo(this.#known, end - 1, ({offset}) => offset));
    const places = [...run.map(({offset}) => offset), end];
    return [begin, ...run.map(endOf)].every((place, i) => place === places[i]) ? run : null;
  }
  /** The same of all, of one request; null: no groups fill it. */
  async #readRun(begin, end) {
    const bytes = begin < 0 ? [] : await this.#source.scattered(begin, end), run = [];
    for (let place = begin; place < end; place = endOf(run.at(-1))) {
      if (bytes.length < end - begin) return null;
      const head = await this.#headAt(place, {bytes: bytes.subarray(place - begin)})
        .catch((error) => {
          if (error.code !== 'corrupt') throw error;
        });
      if (!head) return null;
      run.push(head.group);
    }
    return run;
  }

  /** Forgets groups that end before a frame and that its group does not go on from, but not the
   * last one; gives where the first one that is left begins. */
  forget(frame) {
    const ended = countUpTo(this.#known, frame, endFrame);
    const its = Math.min(ended, this.#known.length - 1);
    const gone = Math.max(its - (this.#known[its]?.depth ?? 0), 0);
    for (const {firstFrame, times} of this.#known.splice(0, gone)) {
      for (let i = 0; i < times.length; ++i) delete this.times[firstFrame + i];
    }
    const [first] = this.#known;
    if (first) this.firstFrame = first.firstFrame;
    return first?.offset ?? 0;
  }
}
