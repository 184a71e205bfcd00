// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a stream come from: memory, a Blob, or a URL. From a URL they come by range
// requests; where a server answers with the whole file instead (200), that one answer is read as far
// as its bytes are asked for.
import {TksError} from './error.js';

const MAGIC = [0x54, 0x4b, 0x53, 0x1a];

/** The promise, or the signal's reason once it aborts. */
export function abortable(promise, signal) {
  if (!signal) return promise;
  return new Promise((resolve, reject) => {
    const stop = () => reject(signal.reason);
    // First of all the promise has a handler: one that fails without ends a Node process.
    promise.then(resolve, reject).finally(() => signal.removeEventListener('abort', stop));
    if (signal.aborted) stop();
    else signal.addEventListener('abort', stop, {once: true});
  });
}

/** Refuses what is no stream, as far as its first bytes tell. `what` says where it is from. */
function checkMagic(bytes, what) {
  if (MAGIC.every((byte, i) => i >= bytes.length || bytes[i] === byte)) return;
  const text = String.fromCharCode(...bytes.subarray(0, 16)).replace(/[^ -~]/g, '.');
  throw new TksError('corrupt', `${what} is not a Tetrakis stream: it begins with "${text}".`);
}

class MemorySource {
  requests = 0;
  sequential = false;
  #blob;
  constructor(blob) {
    this.#blob = blob;
    this.size = blob.size ?? blob.length;
  }
  async next(begin, end) {
    const part = this.#blob.slice(begin, end);
    const bytes = part instanceof Uint8Array ? part : new Uint8Array(await part.arrayBuffer());
    if (begin === 0) checkMagic(bytes, 'This file');
    return bytes;
  }
  scattered(begin, end) {
    return this.next(begin, end);
  }
  close() {}
}

class UrlSource {
  requests = 0;
  /** Of the file, as far as it is known. */
  size = Infinity;
  #url;
  #stop = new AbortController();
  #version = null;
  #reader = null;
  #place = 0;  // of the reader
  #left = [];

  constructor(url) {
    this.#url = String(url);
  }

  /** The server knows no ranges: its one answer is read as far as bytes are asked for. */
  get sequential() {
    return this.#reader !== null;
  }
  /** Bytes from `begin` on, fewer at the end of the file. Nothing before them is asked for again. */
  async next(begin, end) {
    if (end <= begin || begin >= this.size) return new Uint8Array(0);
    const bytes = (!this.#reader && (await this.#request(begin, end))) || (await this.#read(begin, end));
    if (begin === 0 && bytes.length > 0) checkMagic(bytes, this.#what);
    return bytes;
  }
  /** The same from anywhere; nothing where the server answers with the whole file. */
  async scattered(begin, end) {
    return (!this.#reader && (await this.#request(begin, end))) || new Uint8Array(0);
  }
  close(reason = new TksError('usage', 'This terrain is disposed.')) {
    this.#stop.abort(reason);
  }

  /** Of a request: why it was stopped, or else this sentence. */
  #failure(sentence, cause) {
    const {aborted, reason} = this.#stop.signal;
    return aborted ? reason : new TksError('io', `${this.#url}${sentence}`, {cause});
  }
  get #what() {
    return `${this.#url}${this.type ? ` (${this.type})` : ''}`;
  }
  async #fetch(begin, end) {
    ++this.requests;
    try {
      return await fetch(this.#url, {
        headers: {Range: `bytes=${begin}-${end - 1}`},
        signal: this.#stop.signal,
      });
    } catch (error) {
      throw this.#failure(' cannot be fetched: there is no connection, or that server does not ' +
        'allow this page to read it (CORS: Access-Control-Allow-Origin).', error);
    }
  }

  /** null: the answer is the whole file, which is now read from its beginning. */
  async #request(begin, end) {
    const answer = await this.#fetch(begin, end);
    if (answer.status === 416 && begin > 0) {
      this.size = Math.min(this.size, begin);
      return new Uint8Array(0);
    }
    if (!answer.ok) {
      throw new TksError('io', `${this.#url}: the server answered ${answer.status} ` +
        `${answer.statusText}.`.replace(' .', '.'));
    }
    this.#checkVersion(answer);
    this.type = answer.headers.get('content-type')?.split(';')[0];
    if (answer.status === 206) return this.#part(answer, begin, end);
    if (this.#reader) answer.body.cancel().catch(() => {});
    else this.#reader = answer.body.getReader();
    return null;
  }

  #checkVersion(answer) {
    const version = answer.headers.get('etag') ?? answer.headers.get('last-modified');
    this.#version ??= version;
    if (version === null || version === this.#version) return;
    this.close(new TksError('changed', `${this.#url} has changed on the server since its first ` +
      'bytes were read. Open it again.'));
    throw this.#stop.signal.reason;
  }

  async #part(answer, begin, end) {
    // Servers of other origins show this field only where they say so.
    const range = /bytes (\d+)-(\d+)\/(\d+|\*)/.exec(answer.headers.get('content-range') ?? '');
    if (range && Number(range[1]) !== begin) {
      throw new TksError('io', `${this.#url}: the server was asked for byte ${begin} and sent byte ` +
        `${range[1]}.`);
    }
    let bytes;
    try {
      bytes = new Uint8Array(await answer.arrayBuffer());
    } catch (error) {
      throw this.#failure(': the connection broke.', error);
    }
    const sent = range ? Number(range[2]) + 1 - begin : bytes.length;
    if (bytes.length > end - begin || bytes.length !== sent) {
      throw new TksError('io', `${this.#url}: the server sent ${bytes.length} bytes where ` +
        `${Math.min(sent, end - begin)} were announced. Does it compress streams ` +
        '(Content-Encoding)? It should send them as they are.');
    }
    // Servers may send less than was asked for (RFC 9110, section 15.3.7): only where no size is
    // stated does a short answer tell the end.
    if (range && range[3] !== '*') this.size = Number(range[3]);
    else if (bytes.length < end - begin) this.size = begin + bytes.length;
    return bytes;
  }

  /** Bytes of the one answer; those before `begin` are left out. */
  async #read(begin, end) {
    const parts = this.#left;
    let length = parts.reduce((sum, part) => sum + part.length, 0);
    while (this.#place + length < end) {
      const {done, value} = await this.#reader.read().catch((error) => {
        throw this.#failure(': the connection broke.', error);
      });
      if (done) {
        this.size = this.#place + length;
        break;
      }
      parts.push(value);
      length += value.length;
    }
    const all = new Uint8Array(length);
    let place = 0;
    for (const part of parts) {
      all.set(part, place);
      place += part.length;
    }
    const first = begin - this.#place, last = Math.min(end - this.#place, length);
    const rest = all.subarray(last);
    this.#left = rest.length ? [rest] : [];
    this.#place += last;
    return all.subarray(first, last);
  }
}

export function sourceOf(input) {
  if (typeof input === 'string' || input instanceof URL) return new UrlSource(input);
  if (input instanceof ArrayBuffer) return new MemorySource(new Uint8Array(input));
  if (ArrayBuffer.isView(input)) {
    return new MemorySource(new Uint8Array(input.buffer, input.byteOffset, input.byteLength));
  }
  if (input instanceof Blob) return new MemorySource(input);
  throw new TksError('usage', 'open() takes a URL, bytes or a Blob.');
}
