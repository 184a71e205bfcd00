// SPDX-License-Identifier: Apache-2.0
// A stream whose bytes are handed over to the decoder's module. Close it.
import {choiceOf} from './components.js';
import {TksError} from './error.js';
import {MESSAGE_BYTES} from './instance.js';
import {Opened} from './opened.js';

/** Magic, version, profile, level and some varints: these tell how many bytes the header takes, or
 * where a sketch begins. */
const MOST_BEFORE_BODY = 40;
/** A choice of no others. */
const FIRST = {heights: -1, texture: -1};

export class OpenedStream extends Opened {
  #header;  // a copy, which the decoder reads until it gets more bytes
  #pages = 0;  // of the index, which the decoder has
  /** first: gives so many of the first bytes, as far as they are here; chain: the address of what
   * the stream goes on from; component: as choiceOf() takes it. */
  constructor(instance, first, chain, component) {
    const needed = OpenedStream.#leastBytes(instance, first);
    const header = first(needed), copy = instance.allocate(header.length);
    instance.view(Uint8Array, copy, header.length).set(header);
    let decoder;
    try {
      decoder = OpenedStream.#open(instance, chain, [copy, header.length], FIRST);
    } catch (error) {
      // An instance that aborted does no more.
      if (error instanceof TksError) instance.calls.free(copy);
      throw Object.assign(error, {needed});
    }
    super(instance, decoder, header.length);
    this.#header = copy;
    if (component.length > 0) this.#choose(chain, component, first);
  }
  /** The address of a decoder of a header, [address, size]. */
  static #open(instance, chain, header, {heights, texture}) {
    return instance.with(4 + MESSAGE_BYTES, (out) => {
      const status = instance.calls.web_open(
        chain, ...header, heights, texture, out, out + 4, MESSAGE_BYTES);
      if (status !== 0) throw TksError.ofStatus(status, instance.text(out + 4));
      return instance.view(Uint32Array, out, 1)[0];
    });
  }
  /** Takes others than the first components. */
  #choose(chain, component, first) {
    const {instance} = this;
    try {
      this.#passSketch(chain, first);
      const {size} = this;
      const choice = choiceOf(component, this.info().components);
      const chosen = OpenedStream.#open(instance, chain, [this.#header, size], choice);
      instance.calls.tks_close(this.decoder);
      this.decoder = chosen;
    } catch (error) {
      if (error instanceof TksError) this.close();
      throw error;
    }
  }
  /** A sketch has components of its own: the choice is among those of the header, if it is here. */
  #passSketch(chain, first) {
    const {instance} = this, {showsSketch, headerBytes} = this.info();
    const header = showsSketch ? first(headerBytes) : [];
    if (!showsSketch || header.length < headerBytes) return;
    const copy = instance.allocate(header.length);
    instance.view(Uint8Array, copy, header.length).set(header);
    const whole = OpenedStream.#open(instance, chain, [copy, header.length], FIRST);
    this.close();
    [this.decoder, this.#header, this.size] = [whole, copy, header.length];
  }
  /** How many bytes a decoder opens, as far as those that are here tell. */
  static #leastBytes(instance, first) {
    for (let known = first(MOST_BEFORE_BODY);;) {
      const needed = OpenedStream.#headerBytes(instance, known), more = first(needed);
      if (more.length <= known.length) return needed;
      known = more;
    }
  }
  /** Of what is no header so many bytes that decoders refuse them. */
  static #headerBytes(instance, first) {
    return instance.with(8 + first.length, (out) => {
      instance.view(Uint8Array, out + 8, first.length).set(first);
      instance.calls.tks_header_bytes(out + 8, first.length, out);
      return instance.view(Uint32Array, out, 1)[0] || first.length;  // below 2^21
    });
  }
  /** Of pages {place, bytes} of the index those that were not taken before. */
  putPages(pages) {
    for (; this.#pages < pages.length; ++this.#pages) {
      const {place, bytes} = pages[this.#pages];
      this.#put(place, [bytes]);
    }
  }
  /** More bytes, in parts one behind the other, from this place of the stream on. */
  put(place, parts) {
    this.size += this.#put(place, parts);
  }
  #put(place, parts) {
    const {instance} = this, size = parts.reduce((sum, {length}) => sum + length, 0);
    instance.with(size, (address) => {
      const all = instance.view(Uint8Array, address, size);
      let at = 0;
      for (const part of parts) {
        all.set(part, at);
        at += part.length;
      }
      this.check(instance.calls.web_put(this.decoder, place, address, size));
    });
    return size;
  }
  close() {
    this.instance.calls.tks_close(this.decoder);
    this.instance.calls.free(this.#header);
  }
}
