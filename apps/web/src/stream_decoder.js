// SPDX-License-Identifier: Apache-2.0
// The decoder of one stream, whose bytes come bit by bit. Nothing here waits: workers run it, too.
import {Chain} from './chain.js';
import {TksError} from './error.js';
import {partsOf} from './frame.js';
import {locate, readHead} from './group_calls.js';
import {Instance, failureOf} from './instance.js';
import {checkLevels} from './limits.js';
import {OpenedStream} from './opened_stream.js';

export const EXHAUSTED =
  'The decoder ran out of memory. Ask for fewer texels, samples or triangles.';

/** What steps return at their end. */
function lastOf(steps) {
  for (;;) {
    const {done, value} = steps.next();
    if (done) return value;
  }
}

/** Parts {place, bytes} as runs {place, parts} without gaps, in the order of the stream. */
function runsOf(parts) {
  const runs = [];
  let end = -1;
  for (const {place, bytes} of parts.sort((a, b) => a.place - b.place)) {
    if (place === end) runs.at(-1).parts.push(bytes);
    else runs.push({place, parts: [bytes]});
    end = place + bytes.length;
  }
  return runs;
}

/**
 * Decodes one stream from the first so many bytes that came. They live here, so that fewer than
 * before can be decoded anew, and an instance that aborted be replaced.
 */
export class Decoder {
  #instance = null;
  #opened = new Map();  // by the components that are asked for
  #chunks = [];  // in the order in which they came
  #length = 0;
  #pages = [];  // {place, bytes} of an index behind the stream, which count for nothing
  #chain;  // that the stream goes on from
  #centre = null;  // that positions of an object count from, in all frames

  constructor(module, memory) {
    this.module = module;
    this.#chain = new Chain(memory);
  }

  /** Bytes that are not here yet, from a place of the stream on. All of its header comes first. */
  put({place, chunk}) {
    this.#chunks.push({place, bytes: chunk, before: this.#length});
    this.#length += chunk.length;
  }
  /** The same of pages of an index, which lie behind the stream. */
  putPage({place, chunk}) {
    this.#pages.push({place, bytes: chunk});
  }
  /** The same, of bytes that come in the order of the stream. */
  append(bytes) {
    this.put({place: this.#length, chunk: bytes});
  }

  /** Forgets the stream for another one, which goes on from these as Chain.follow() takes them.
   * The memory of the instance stays for it. */
  forget(behind) {
    this.#close();
    this.#chain.follow(behind);
    [this.#chunks, this.#length, this.#pages, this.#centre] = [[], 0, [], null];
  }

  #first(size) {
    const first = new Uint8Array(size);
    let length = 0;
    for (const {bytes} of this.#chunks) {
      if (length === size) break;
      const part = bytes.subarray(0, size - length);
      first.set(part, length);
      length += part.length;
    }
    return first.subarray(0, length);
  }
  /** Parts {place, bytes} of the first `size` bytes that came, without the first `open` of them. */
  #behind(open, size) {
    return this.#chunks.map(({place, bytes, before}) => {
      const from = Math.max(open - before, 0);
      return {place: place + from, bytes: bytes.subarray(from, Math.max(from, size - before))};
    }).filter(({bytes}) => bytes.length > 0);
  }
  /** Those behind the ones that were open cost what they tell. */
  #openedTo(size, component) {
    const key = JSON.stringify(component);
    if (this.#opened.get(key)?.size > size) this.#close();
    const opened = this.#opened.get(key) ?? this.#open(size, key, component);
    // The decoder looks through its index each time that it gets bytes.
    for (const {place, parts} of runsOf(this.#behind(opened.size, size))) opened.put(place, parts);
    opened.putPages(this.#pages);
    opened.setLevels(0, 0);
    return opened;
  }
  #open(size, key, component) {
    this.#instance ??= new Instance(this.module);
    const opened = new OpenedStream(
      this.#instance, (bytes) => this.#first(Math.min(bytes, size)),
      this.#chain.addressIn(this.#instance), component);
    this.#opened.set(key, opened);
    return opened;
  }
  #close() {
    const all = this.#opened;
    this.#opened = new Map();
    for (const opened of all.values()) opened.close();
  }

  /** An instance that aborted does no more. */
  #leave() {
    this.#opened = new Map();
    this.#instance = null;
    this.#chain.leave();
  }

  /** Takes the steps of `use`, a generator, with the first `bytes` bytes that came, opened. */
  *#steps(bytes, component, use) {
    try {
      try {
        return yield* use(this.#openedTo(Math.min(bytes, this.#length), component));
      } catch (error) {
        if (error instanceof TksError) this.#close();  // it may take no more bytes
        throw error;
      }
    } catch (error) {
      if (!(error instanceof TksError)) this.#leave();
      throw failureOf(error, EXHAUSTED);
    }
  }
  /** What `use` gives, called with the first `bytes` bytes that came, opened; `component`: names
   * and numbers, as askedOf() gives them. */
  opened(bytes, use, component = []) {
    return lastOf(this.#steps(bytes, component, function* (opened) {
      return use(opened);
    }));
  }

  /** Makes a frame, a part of it at each step. Until it returns it no other call may be made, or it
   * has to be given up. */
  parts(request) {
    const decoder = this;
    return this.#steps(request.bytes, request.component ?? [], function* (opened) {
      yield;
      opened.setFrame(request.frame ?? 0);
      const info = opened.info();
      checkLevels(request, info);
      const parts = yield* partsOf(opened, info, {...request, centre: decoder.#centre});
      decoder.#centre ??= parts.object?.centre;
      return {bytes: opened.size, complete: opened.size >= info.streamBytes, info, ...parts};
    });
  }
  decode(request) {
    return lastOf(this.parts(request));
  }

  plan(request) {
    return this.opened(Infinity, (opened) => opened.plan(request), request.component);
  }
  needed({part, window, component}) {
    return this.opened(Infinity, (opened) => opened.needed(part, window), component);
  }

  /** What readHead() and locate() give, of bytes of a sequence. */
  head(bytes) {
    return this.#called((instance) => readHead(instance, bytes));
  }
  locate(request) {
    return this.#called((instance) => locate(instance, request));
  }
  #called(use) {
    try {
      return use(this.#instance ??= new Instance(this.module));
    } catch (error) {
      throw failureOf(error, EXHAUSTED);
    }
  }

  /** The very samples of a frame, as the conformance vectors state them. */
  samples(bytes, level, frame = 0, component = []) {
    return this.opened(bytes, (opened) => {
      opened.setFrame(frame);
      const whole = opened.info();
      opened.setLevels(Math.min(level, whole.coarsestLevel),
        Math.min(level, whole.textureCoarsestLevel));
      const info = opened.info();
      return {
        heights: info.hasHeights ? opened.heights(info) : null,
        texture: info.hasTexture ? opened.texels(info) : null,
      };
    }, component);
  }
}
