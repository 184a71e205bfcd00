// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a stream come from: memory, a Blob, or a URL. All have the same calls: next()
// brings bytes from a place on, scattered() those of one range of a view's.
import {TksError} from './error.js';
import {gathered, joined} from './pieces.js';
import {UrlSource, checkMagic} from './url_source.js';

class MemorySource {
  requests = 0;
  sequential = false;
  #blob;
  constructor(blob) {
    this.#blob = blob;
    this.size = blob.size ?? blob.length;
  }
  async next(begin, end, take) {
    const bytes = await this.scattered(begin, end);
    if (begin === 0) checkMagic(bytes, 'This file');
    if (bytes.length > 0) await take(bytes);
  }
  async scattered(begin, end) {
    const part = this.#blob.slice(begin, end);
    if (part instanceof Uint8Array) return part;
    const bytes = await part.arrayBuffer().catch((error) => {
      throw new TksError('io', 'This file cannot be read: it has changed or gone since it was ' +
        `chosen, or may not be read (${error.message}). Open it again.`, {cause: error});
    });
    return new Uint8Array(bytes);
  }
  close() {}
}

export function sourceOf(input, request) {
  if (typeof input === 'string' || input instanceof URL) return new UrlSource(input, request);
  if (input instanceof ArrayBuffer) return new MemorySource(new Uint8Array(input));
  if (ArrayBuffer.isView(input)) {
    return new MemorySource(new Uint8Array(input.buffer, input.byteOffset, input.byteLength));
  }
  if (input instanceof Blob) return new MemorySource(input);
  throw new TksError('usage', 'open() takes a URL, bytes or a Blob.');
}

/** A source whose bytes come in any order, of one that began so: of a server without ranges all of
 * them are read. */
export async function anyOrder(source, first, signal) {
  if (!source.sequential) return source;
  const rest = await gathered((take) => source.next(first.length, Infinity, take, signal));
  source.close();
  return Object.assign(new MemorySource(joined([first, rest])), {requests: source.requests});
}
