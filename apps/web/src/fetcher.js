// SPDX-License-Identifier: Apache-2.0
// Brings the bytes of a stream from its source to its decoder: the first ones that are missing, or
// those that help a view most.
import {abortable, stoppedBy} from './abort.js';
import {askDecoder} from './decoders.js';
import {Flow} from './pace.js';
import {Held, requestsFor} from './ranges.js';

/** What a request costs beside its own bytes: 15 ms at 2 Mb/s; of what is here already a share that
 * nobody misses; and of what is asked for as much as leaves few requests. */
const REQUEST_BYTES = 4096, SHARE_OF_HELD = 1 / 16, SHARE_OF_ASKED = 1 / 4;

export class Fetcher {
  /** Of the stream, once its header is known. */
  info = null;
  #source;
  #decoder;
  #requestBytes;
  #held = new Held();
  #pages = new Held();  // of an index in pages, behind the stream
  #flow = new Flow();
  #reading = Promise.resolve();
  #awaited = new Set();  // {bytes, resolve}: who waits for so many

  /** `requestBytes`: what a request costs beside its own, where the caller says it. */
  constructor(source, decoder, requestBytes) {
    this.#source = source;
    this.#decoder = decoder;
    this.#requestBytes = requestBytes;
  }

  /** What a request costs among those for so many bytes: of a file that is cut short a plan asks
   * for all. */
  #requestCost(bytes) {
    const here = this.#held.bytes;
    const share = this.truncated ? 0 : Math.min(SHARE_OF_ASKED * bytes, here);
    return this.#requestBytes ?? Math.round(Math.max(REQUEST_BYTES, SHARE_OF_HELD * here, share));
  }

  /** How many bytes are here. */
  get bytes() {
    return this.#held.bytes;
  }
  /** How many requests went out, how many bytes of the stream are here, and which. */
  get loaded() {
    const {bytes, ranges} = this.#held;
    return {requests: this.#source.requests, bytes, ranges};
  }
  /** Whether the file ends before the stream does. */
  get truncated() {
    return this.#source.size < this.info.streamBytes;
  }
  /** Whether bytes can be asked for by what they show. */
  get #isIndexed() {
    const {hasIndex, streamBytes, indexBytes} = this.info;
    const there = !indexBytes || this.#source.size >= streamBytes + indexBytes;
    return hasIndex && there && !this.#source.sequential;
  }
  /** Of the file, as far as it is known; Infinity: it is not. */
  get fileBytes() {
    return this.#source.size;
  }
  /** How many ms to wait for the `rest` of the bytes, as Flow says it. */
  patience(rest, took) {
    return this.#flow.patience(rest, took);
  }

  /**
   * Resolves to how many of `bytes` bytes are here. `asked`: {signal, view, triangles, component}:
   * as plannedView(), with a globe where there is one, trianglesOf() and askedOf() give them.
   */
  async load(bytes, asked) {
    if (this.#held.bytes < bytes) {
      // One after another: each asks for what the ones before did not.
      const reading = this.#reading.catch(() => {}).then(() => this.#read(bytes, asked));
      this.#reading = reading;
      await abortable(this.reached(bytes, reading), asked.signal);
    }
    return Math.min(bytes, this.#held.bytes);
  }
  /** Resolves when so many bytes are here, whoever asked for them, or when `reading` ends. */
  async reached(bytes, reading) {
    let waiting;
    const here = new Promise((resolve) => (waiting = {bytes, resolve}));
    if (this.#held.bytes < bytes) this.#awaited.add(waiting);
    else waiting.resolve();
    try {
      await Promise.race([here, reading]);
    } finally {
      this.#awaited.delete(waiting);
    }
  }
  async #read(bytes, {signal, view, ...asked}) {
    const came = () => this.#held.bytes + this.#pages.bytes;
    for (let last = -1; this.#held.bytes < bytes && came() > last; ) {
      signal?.throwIfAborted();
      const before = this.#held.bytes;
      last = came();
      if (!view || !this.info || !this.#isIndexed) {
        await this.#fetchNext(bytes - before, signal);
        continue;
      }
      // A plan counts bytes by integers: there is no infinite number of them.
      const most = Math.min(bytes, this.info.streamBytes) - before;
      await this.#fetchPlanned({view, ...asked}, most, signal);
      if (bytes - this.#held.bytes < this.#requestCost(0)) return;  // not worth another request
    }
  }
  /** The first bytes that are missing. */
  async #fetchNext(bytes, signal) {
    const size = Math.min(this.info?.streamBytes ?? Infinity, this.#source.size);
    const [gap] = this.#held.gaps(0, size);
    if (!gap) return;
    const [begin, end] = gap;
    let place = begin;
    this.#flow.request();
    await this.#source.next(begin, Math.min(end, begin + bytes), async (piece) => {
      this.#take(place, piece);
      place += piece.length;
    }, signal);
  }
  /** Those that help a view most; none where nothing more does. `wanted`: {view, triangles,
   * component}. */
  async #fetchPlanned(wanted, bytes, signal) {
    const {truncated, info} = this, {size} = this.#source;
    // A plan knows no end of the file: all that a short one would hold may lie behind it.
    const [asked, most] = truncated ? [info.streamBytes, bytes] : [bytes, Infinity];
    const request = {...wanted, bytes: asked, requestBytes: this.#requestCost(bytes)};
    const plan = await askDecoder(this.#decoder, 'plan', request, signal);
    const ranges = requestsFor(plan, size, most);
    // Where nothing is left to choose from, the plan counts requests for nothing.
    const total = ranges.reduce((sum, [begin, end]) => sum + end - begin, 0);
    if (total < SHARE_OF_HELD * this.#requestCost(0)) return;
    this.#flow.request();
    const stop = new AbortController();
    await stoppedBy(signal, stop, () => this.#takeAll(ranges, stop));
    // A server that has just forgotten ranges sends all from its beginning.
    if (this.#source.sequential) await this.#fetchNext(bytes, signal);
  }
  /** Asks for ranges [begin, end) of the file. Whether such can be asked for. */
  async bring(ranges, signal) {
    if (!this.#isIndexed) return false;
    const stop = new AbortController();
    await stoppedBy(signal, stop, () => this.#takeAll(ranges, stop));
    return !this.#source.sequential;
  }
  /** Takes ranges [begin, end) as they come. One that fails ends those that are still to come. */
  async #takeAll(ranges, stop) {
    const answers = ranges.map(([begin, end]) =>
      ({begin, chunk: this.#source.scattered(begin, end, stop.signal)}));
    for (const {chunk} of answers) chunk.catch((error) => stop.abort(error));
    for (const {begin, chunk} of answers) {
      const bytes = await chunk.catch(() => null);
      if (bytes) this.#take(begin, bytes);
    }
    stop.signal.throwIfAborted();
  }
  /**
   * Bytes from a place on. Those that are here already are left out. The decoder gets them in front
   * of what it is asked for later; nobody waits for it, because it may be at work on a frame.
   */
  #take(begin, chunk) {
    const end = this.info?.streamBytes ?? Infinity;
    if (begin < end && begin + chunk.length > end) {
      this.#take(begin, chunk.subarray(0, end - begin));
      this.#take(end, chunk.subarray(end - begin));
      return;
    }
    const held = begin < end ? this.#held : this.#pages;
    for (const [b, e] of held.gaps(begin, begin + chunk.length)) {
      const piece = {place: b, chunk: chunk.slice(b - begin, e - begin)};
      const put = askDecoder(this.#decoder, held === this.#held ? 'put' : 'putPage', piece);
      put.catch(() => {});  // of a decoder that failed, and says so to all
    }
    held.add(begin, begin + chunk.length);
    this.#flow.take(chunk.length);
    for (const {bytes, resolve} of this.#awaited) {
      if (this.#held.bytes >= bytes) resolve();
    }
  }

  close() {
    this.#source.close();
  }
}
