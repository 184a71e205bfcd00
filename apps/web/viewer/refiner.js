// SPDX-License-Identifier: Apache-2.0
// Draws a stream: a rough first frame, then what more bytes bring, until what is shown is what is
// wanted, or all that this view needs.
import {FIRST_FRAME} from '../src/three.js';
import {globeFor} from './globe_view.js';
import {tell} from './page.js';
import {formatBytes} from './read_out.js';
import {hasTint} from './tint.js';

export class Refiner {
  #picture;
  #show;
  #fail;
  #signal;
  #terrain = null;
  #object = null;
  #first = null;  // a promise of the first frame, where that is being made already
  #wanted = {};
  #isPumping = false;
  #hold = new AbortController();  // of what is being made; it is aborted while frames play
  /** Bytes, triangles and texels of the frame that is shown, of a globe its exaggeration, and
   * whether it has all texels that are wanted. */
  shown = {};

  /** Calls show(frame) with each frame, and fail(error) if one cannot be made. signal(): ends what
   * is being made once something else is opened; where that fails, another one has come. */
  constructor(picture, {show, fail, signal}) {
    this.#picture = picture;
    [this.#show, this.#fail, this.#signal] = [show, fail, signal];
  }
  /** `object` is what draws frames of `terrain`. */
  begin({terrain, object, first = null}) {
    this.shown = {};
    [this.#terrain, this.#object, this.#first] = [terrain, object, first];
  }
  /** {bytes, triangles, height, frame}: as the sliders say. */
  want(wanted) {
    this.#wanted = {...wanted, texels: this.#texels};
    this.pump();
  }
  /** Makes nothing until release(): frames play. */
  hold() {
    this.#hold.abort();
    this.shown.isWhole = false;
    document.body.dataset.state = 'playing';
  }
  release() {
    if (this.#hold.signal.aborted) this.#hold = new AbortController();
  }
  /** A frame that somebody else has drawn, roughly. */
  took({number, bytes}) {
    this.shown = {...this.#wanted, frame: number, bytes, isWhole: false};
  }
  /** As many a side as the card takes, of an object as it is seen. */
  get #texels() {
    const {renderer: {capabilities}, camera, pixels} = this.#picture, object = this.#object;
    const most = Math.min(4096, capabilities.maxTextureSize);
    if (!object.isObject || !object.frame) return most;
    return Math.min(most, object.needs(camera, pixels, this.shown.texels ?? 0).texels);
  }
  /** For another view other bytes may help. */
  replan() {
    const {bytes} = this.#terrain?.loaded ?? {};
    if (!this.shown.bytes || !this.#isPlanned || bytes >= this.#wanted.bytes) return;
    this.shown.bytes = bytes;
    this.pump();
  }
  /** Of ground with an index bytes come for what is looked at. */
  get #isPlanned() {
    const {frame, isObject} = this.#object;
    return this.#terrain.info.hasIndex && frame !== null && !isObject;
  }
  get #isSameFrame() {
    return this.#wanted.frame === this.shown.frame;
  }
  get #lacksBytes() {
    return this.#isSameFrame && this.#wanted.bytes > this.shown.bytes;
  }
  /** Whether it is what is wanted. */
  get isShown() {
    const {shown} = this, wanted = this.#wanted;
    return shown.isWhole &&
      ['bytes', 'triangles', 'height', 'texels', 'frame']
        .every((name) => shown[name] === wanted[name]);
  }

  async pump() {
    if (this.#isPumping || !this.#terrain || this.#hold.signal.aborted) return;
    this.#isPumping = true;
    const current = this.#terrain, held = this.#hold, signal = this.#ended();
    document.body.dataset.state = 'refining';
    try {
      while (current === this.#terrain && !this.isShown) {
        if (!this.shown.bytes) await this.#drawFirst(current);
        else if (this.#lacksBytes) await this.#refine(current);
        else await this.#redraw(current);
      }
      if (!signal.aborted) document.body.dataset.state = 'done';
    } catch (error) {
      if (current === this.#terrain && !signal.aborted) this.#fail(error);
    } finally {
      this.#isPumping = false;
      if (current !== this.#terrain || held !== this.#hold) this.pump();
    }
  }
  /** Aborts once something else is opened, or frames play. */
  #ended() {
    return AbortSignal.any([this.#signal(), this.#hold.signal]);
  }

  /** What frames are made of, but for bytes. */
  #options(triangles) {
    const {info} = this.#terrain, {texels, height} = this.#wanted;
    return {
      // Those that are coded as they are have no slider.
      triangles: info.objectTriangles || triangles, texels, mesh: !this.#object.hasFinalMesh,
      normals: true,
      surface: hasTint(info), samples: 1024,
      signal: this.#ended(), globe: globeFor(info, Number(height)), frame: this.#wanted.frame,
    };
  }
  /** Shows what opening brought, roughly; other bytes come meanwhile. */
  async #drawFirst(current) {
    const {info} = current, {texels} = FIRST_FRAME, wanted = this.#wanted, signal = this.#ended();
    const bytes = Math.min(wanted.bytes, current.loaded.bytes);
    const triangles = Math.min(wanted.triangles, FIRST_FRAME.triangles);
    const options = this.#options(triangles);
    if (!info.hasIndex) current.load(wanted.bytes, options).catch(() => {});
    const frame = await (this.#first ?? current.decode({...options, texels, bytes}));
    // The camera is placed for its size, and for what is seen bytes come.
    await this.#picture.sized();
    if (current !== this.#terrain || signal.aborted) return;
    this.#first = null;
    this.#show(frame);
    const isWhole = Math.max(info.textureWidth, info.textureHeight) <= texels;
    this.shown = {...wanted, bytes: frame.bytes, triangles, isWhole};
  }
  /** Frames of more bytes, until others are wanted. */
  async #refine(current) {
    const goal = this.#wanted, {camera, pixels} = this.#picture;
    const view = this.#isPlanned ? this.#object.viewOf(camera, pixels) : null;
    const options = this.#options(goal.triangles), after = this.shown.bytes;
    for await (const frame of current.refine({...options, bytes: goal.bytes, after, view})) {
      if (current !== this.#terrain || options.signal.aborted) return;
      this.#show(frame);
      this.shown = {...goal, bytes: frame.bytes, isWhole: true};
      if (goal !== this.#wanted) return;
    }
    const {fileBytes, truncated, info} = current;
    if (truncated && goal.bytes > fileBytes) {
      goal.bytes = fileBytes;
      tell(`The file is cut short: ${formatBytes(fileBytes)} of ` +
        `${formatBytes(info.streamBytes)} are there.`, true);
    }
    this.shown.bytes = goal.bytes;  // this view needs no more
  }
  /** One frame of bytes that are here. */
  async #redraw(current) {
    const wanted = this.#wanted, {bytes, triangles, texels} = wanted;
    const {shown} = this;
    const isSame = this.#isSameFrame;
    const kept = isSame && bytes === shown.bytes && shown.isWhole && texels === shown.texels
      ? {texture: false, surface: false} : {};
    const here = isSame ? Math.min(bytes, current.loaded.bytes) : bytes;
    const options = {...this.#options(triangles), bytes: here, ...kept};
    const frame = await current.decode(options);
    if (current !== this.#terrain || options.signal.aborted) return;
    this.#show(frame);
    this.shown = {...wanted, isWhole: true};
  }
}
