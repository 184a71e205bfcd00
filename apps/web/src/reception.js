// SPDX-License-Identifier: Apache-2.0
// What a receiver gets of a sequence that `tetrakis serve` serves, as users have it: what a
// Sequence is, of frames that come as the server sees fit for the receiver.
import {abortable} from './abort.js';
import {globeOn} from './body.js';
import {askedOf} from './components.js';
import {ControlUrl} from './control_url.js';
import {askDecoder} from './decoders.js';
import {TksError} from './error.js';
import {Exchange} from './exchange.js';
import {HeldFrames} from './held_frames.js';
import {checkBytes, checkLevels, checkNumber, checkSides, trianglesOf} from './limits.js';
import {GROWTH} from './pace.js';
import {PARTS} from './parts.js';
import {cutOf} from './view.js';
import {wantsOf} from './wants.js';

const DEFAULTS = {
  triangles: 20000, view: null, mesh: true, globe: null, normals: false, texture: true,
  surface: false, texels: 4096, samples: 4096,
};
/** Of a receiver: frames that stay behind the one that is wanted, ms of failures, ms without a
 * byte. */
const KEEP = 256, PATIENCE = 30000, TIMEOUT = 15000;

/** Made by receive(). */
export class Reception {
  isSequence = true;
  isLive = true;
  /** A receiver has no file whose end could be missing. */
  truncated = false;
  fileBytes = Infinity;
  info = null;
  #decoder;
  #url;
  #exchange;
  #keep;
  #held = new HeldFrames();
  #wants = wantsOf({});
  #asks = [];  // {frame, view, triangles, isServed} of calls that wait
  #changes = new Set();  // who waits for an answer
  #failure = null;
  #last = 0;  // the frame that was asked for last

  constructor(url, decoder, options) {
    const {request, timeout = TIMEOUT, patience = PATIENCE, keep = KEEP, ...wants} = options;
    checkNumber('timeout', timeout, 1);
    checkNumber('patience', patience, 0);
    checkNumber('keep', keep, 0);
    [this.#decoder, this.#url, this.#keep] = [decoder, String(url), keep];
    this.#wants = wantsOf(wants);
    this.#exchange = new Exchange(decoder, new ControlUrl(url, {request, timeout}), {
      link: this.#wants.link, patience,
      wants: () => this.#wanted(), keeps: () => this.#firstKept(),
      took: (state, wants) => this.#took(state, wants), failed: (error) => this.#failed(error),
    });
  }
  /** Resolves once there is a frame. */
  async begin(signal) {
    this.#exchange.run();
    while (this.#held.isEmpty) await this.changed({signal});
    await this.decode({mesh: false, texture: false, signal});
  }

  get clock() {
    return this.#held.clock;
  }
  get firstFrame() {
    return this.#held.firstFrame;
  }
  get frames() {
    return this.#held.frames;
  }
  get sourceFrames() {
    return this.#held.sourceFrames;
  }
  get times() {
    return this.#held.times;
  }
  get loaded() {
    const bytes = this.#held.groupOf(this.#last)?.bytes ?? 0;
    return {requests: this.#exchange.messages, bytes, ranges: [[0, bytes]]};
  }
  /** Why no more comes; null: it does. */
  get error() {
    return this.#failure;
  }

  /** Says what is wanted from now on; what is not given stays. */
  want(wants) {
    const next = wantsOf({...this.#wants, ...wants});
    if (next.link !== this.#wants.link) this.#exchange.link = next.link;
    this.#wants = next;
    this.#exchange.wake();
  }
  #wanted() {
    const {frame, view, triangles} = {...this.#wants, ...this.#asks.at(-1)};
    return {frame, view, triangles};
  }
  #firstKept() {
    const {frame} = this.#wanted();
    return Math.max((frame ?? this.#held.sourceFrames - 1) - this.#keep, 0);
  }

  #took(state, wants) {
    this.#held.set(state);
    const ask = this.#asks.at(-1);
    if (ask && state.pieces === 0) {
      ask.isServed = ['frame', 'view', 'triangles'].every((name) =>
        JSON.stringify(wants[name]) === JSON.stringify(this.#wanted()[name]));
    }
    this.#tell();
  }
  #failed(error) {
    this.#failure = this.#held.isEmpty && error.code === 'corrupt'
      ? new TksError('corrupt', `${this.#url} answers a control message with something else. ` +
        'Give an address that `tetrakis serve` prints.', {cause: error})
      : error;
    this.#tell();
  }
  #tell() {
    const waiting = [...this.#changes];
    this.#changes.clear();
    for (const tell of waiting) tell();
  }
  /** Resolves once an answer has come. */
  async changed({signal} = {}) {
    if (this.#failure) throw this.#failure;
    let tell;
    const change = new Promise((resolve) => (tell = resolve));
    this.#changes.add(tell);
    try {
      await abortable(change, signal);
    } finally {
      this.#changes.delete(tell);
    }
    if (this.#failure) throw this.#failure;
  }

  /** Asks for a frame, until isDone(ask) holds or `signal` aborts. */
  async #asking({frame, view, globe, triangles, signal}, isDone) {
    // What is newest stays so, while others come.
    const {frames, sourceFrames} = this.#held;
    const isNewest = frame === frames - 1 || frame >= sourceFrames - 1;
    const {view: seen, triangles: drawn} = wantsOf({...this.#wants,
      ...(view && !globe && !this.info?.isObject ? {view} : {}),
      ...(triangles === undefined ? {} : {triangles})});
    const asked = isNewest && this.#wants.frame === null ? null : frame;
    const ask = {frame: asked, view: seen, triangles: drawn, isServed: false};
    if (isDone(ask)) return;
    this.#asks.push(ask);
    this.#exchange.wake();
    try {
      while (!isDone(ask)) await this.changed({signal});
    } finally {
      this.#asks.splice(this.#asks.indexOf(ask), 1);
      this.#exchange.wake();
    }
  }
  /** Waits until a frame can be decoded. */
  async #there(frame, signal) {
    if (!Number.isInteger(frame) || frame < 0) {
      throw new TksError('usage', '`frame` is the number of a frame.');
    }
    this.#last = frame;
    await this.#asking({frame, signal}, ({isServed}) => this.#held.groupOf(frame) || isServed);
    if (this.#held.groupOf(frame)) return;
    throw new TksError('usage', `The server does not have frame ${frame}; it has those before ` +
      `${this.#held.sourceFrames}.`);
  }

  async load(bytes, {frame = this.frames - 1, signal, ...options} = {}) {
    checkBytes(bytes);
    signal?.throwIfAborted();
    await this.#there(frame, signal);
    const have = () => this.#held.groupOf(frame)?.bytes ?? 0;
    const enough = () => have() >= Math.min(bytes, this.#held.groupOf(frame)?.streamBytes ?? 0);
    await this.#asking({...options, frame, signal}, ({isServed}) => isServed || enough());
    return Math.min(bytes, have());
  }

  async decode({frame = this.frames - 1, signal, bytes = 0, ...options} = {}) {
    checkBytes(bytes);
    await this.#there(frame, signal);
    const asked = {...DEFAULTS, ...options};
    if (askedOf(asked.component).length > 0) {
      throw new TksError('usage', 'What a server sends has no `component`.');
    }
    checkSides(asked);
    checkLevels(asked, this.info ?? {});
    const triangles = trianglesOf(asked.triangles), cut = cutOf(asked.view);
    const globe = asked.globe && globeOn(asked.globe, this.info);
    const made = await askDecoder(
      this.#decoder, 'decode', {...asked, globe, view: null, triangles, cut, frame}, signal);
    this.info = made.info;
    return {...made, number: frame, time: this.times[frame]};
  }

  async *refine({frame = this.frames - 1, bytes = Infinity, after = 0, first, ...options} = {}) {
    checkBytes(bytes);
    await this.#there(frame, options.signal);
    let shown = after, isFirst = !after;
    for (;;) {
      const group = () => this.#held.groupOf(frame) ?? {bytes: 0, streamBytes: 0};
      let isLast = false;
      const isGrown = ({isServed}) => {
        const {bytes: here, streamBytes} = group();
        isLast = isServed || here >= Math.min(bytes, streamBytes);
        return isLast || here >= GROWTH * shown;
      };
      if (!isFirst) await this.#asking({...options, frame}, isGrown);
      const {bytes: here} = group();
      if (isFirst || here > shown) {
        shown = here;
        yield await this.decode({...options, ...(isFirst && first), frame});
      }
      if (isLast) return;
      isFirst = false;
    }
  }

  /** The newest frame, again and again: as soon as it can be decoded, and as more of it comes. */
  async *newest(options = {}) {
    for (let number = -1, bytes = 0; ;) {
      const newest = this.frames - 1, here = this.#held.groupOf(newest)?.bytes ?? 0;
      if (newest > number || (newest === number && here > bytes)) {
        [number, bytes] = [newest, here];
        yield await this.decode({...options, frame: newest});
      } else await this.changed(options);
    }
  }

  async at(time) {
    if (typeof time !== 'number' || Number.isNaN(time)) {
      throw new TksError('usage', '`time` is a number of ticks.');
    }
    return this.#held.at(time);
  }
  async group(frame, {signal} = {}) {
    await this.#there(frame, signal);
    const {firstFrame, times, streamBytes} = this.#held.groupOf(frame);
    return {firstFrame, endFrame: firstFrame + times.length, bytes: streamBytes};
  }
  async needed({part = 'heights', window, frame = this.frames - 1} = {}) {
    await this.#there(frame);
    const ranges =
      await askDecoder(this.#decoder, 'needed', {part: PARTS[part], window, frame});
    return ranges.map(({begin, end}) => [begin, end]);
  }

  dispose() {
    const disposed = new TksError('usage', 'This terrain is disposed.');
    this.#failure = disposed;
    this.#exchange.stop(disposed);
    this.#decoder.dispose();
    this.#tell();
  }
  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.dispose();
  }
}
