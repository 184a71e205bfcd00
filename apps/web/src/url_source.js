// SPDX-License-Identifier: Apache-2.0
// A stream at a URL. Its bytes come by range requests; where a server answers with the whole file
// instead (200), that one answer is read as far as its bytes are asked for.
import {stoppedBy} from './abort.js';
import {TksError} from './error.js';
import {gathered, inLarger} from './pieces.js';
import {BROKE, hasBroken, refusalOf} from './refusal.js';
import {Version} from './version.js';
import {WholeAnswer} from './whole_answer.js';

const MAGICS = ['TKS\x1a', 'TKG\x1a'];

const textOf = (bytes) => String.fromCharCode(...bytes);

/** Whether a file that begins so is a sequence of groups of frames. */
export const isSequence = (bytes) => textOf(bytes.subarray(0, 4)) === MAGICS[1];

/** Refuses what is neither a stream nor a sequence of them, as far as its first bytes tell. `what`
 * says where it is from. */
export function checkMagic(bytes, what) {
  const first = textOf(bytes.subarray(0, 4));
  if (MAGICS.some((magic) => magic.startsWith(first))) return;
  const text = textOf(bytes.subarray(0, 16)).replace(/[^ -~]/g, '.');
  throw new TksError('corrupt', `${what} is not a Tetrakis stream: it begins with "${text}".`);
}

export class UrlSource {
  requests = 0;
  /** Of the file, as far as it is known. */
  size = Infinity;
  #url;
  #request;
  #running = new Set();  // an AbortController for each request
  #closed = null;
  #version = new Version();
  #whole = null;

  /** `request`: headers and credentials of its requests, as fetch() takes them. */
  constructor(url, request = {}) {
    this.#url = String(url);
    this.#request = request;
  }

  /** The server knows no ranges: its one answer is read as far as bytes are asked for. */
  get sequential() {
    return this.#whole !== null;
  }
  /**
   * Gives `take` the bytes [begin, end) in pieces as they come, fewer at the end of the file.
   * Nothing before them is asked for again. The signal ends the request, also that of a whole file,
   * which then begins anew.
   */
  async next(begin, end, take, signal) {
    if (end <= begin || begin >= this.size) return;
    const bring = async (piece) => {
      if (this.#whole || !(await this.#ask(begin, end, piece, signal))) {
        await this.#read(begin, end, piece, signal);
      }
    };
    if (begin > 0) return inLarger(take, bring);
    // What is no stream at all, or was compressed on its way, is refused before any of it is taken.
    const bytes = await gathered(bring);
    checkMagic(bytes, `${this.#url}${this.type ? ` (${this.type})` : ''}`);
    if (bytes.length > 0) await take(bytes);
  }
  /** The same from anywhere; nothing where the server answers with the whole file. */
  async scattered(begin, end, signal) {
    return gathered(async (take) => this.#whole || this.#ask(begin, end, take, signal));
  }
  close(reason = new TksError('usage', 'This terrain is disposed.')) {
    this.#closed ??= reason;
    for (const stop of this.#running) stop.abort(reason);
  }

  #error(sentence, cause) {
    return new TksError('io', `${this.#url}${sentence}`, {cause});
  }
  /** Of a request: why it was stopped, or else this sentence. */
  #failure({signal: {aborted, reason}}, sentence, cause) {
    return aborted ? reason : this.#error(sentence, cause);
  }

  async #fetch(begin, end, stop) {
    ++this.requests;
    try {
      const headers = new Headers(this.#request.headers);
      headers.set('Range', `bytes=${begin}-${end - 1}`);
      const {credentials} = this.#request, {signal} = stop;
      return await fetch(this.#url, {headers, credentials, signal});
    } catch (error) {
      const why = hasBroken(error) ? BROKE : await refusalOf(this.#url, stop.signal);
      throw this.#failure(stop, why, error);
    }
  }

  /** false: the answer is the whole file, which is now read from its beginning. */
  async #ask(begin, end, take, signal) {
    if (this.#closed) throw this.#closed;
    const stop = new AbortController();
    this.#running.add(stop);
    try {
      return await stoppedBy(signal, stop, () => this.#answered(begin, end, take, stop));
    } finally {
      if (this.#whole?.stop !== stop) {
        this.#running.delete(stop);
        stop.abort();  // of an answer that is not read
      }
    }
  }
  async #answered(begin, end, take, stop) {
    const answer = await this.#fetch(begin, end, stop);
    if (answer.ok || answer.status === 416) this.#checkVersion(answer);
    if (answer.status === 416) {
      this.size = Math.min(this.size, begin);
      return true;
    }
    if (!answer.ok || !answer.body) {  // 204 has no body
      const status = `${answer.status} ${answer.statusText}`.trimEnd();
      throw this.#error(`: the server answered ${status}.`);
    }
    this.type = answer.headers.get('content-type')?.split(';')[0];
    if (answer.status === 206) {
      await this.#part(answer, {begin, end}, take, stop);
      return true;
    }
    this.#whole ??= new WholeAnswer(answer, stop);
    return false;
  }

  #checkVersion(answer) {
    if (this.#version.agrees(answer)) return;
    this.close(new TksError('changed', `${this.#url} has changed on the server since its first ` +
      'bytes were read. Open it again.'));
    throw this.#closed;
  }

  async #part(answer, {begin, end}, take, stop) {
    // Servers of other origins show this field only where they say so.
    const range = /bytes (\d+)-(\d+)\/(\d+|\*)/.exec(answer.headers.get('content-range') ?? '');
    if (range && Number(range[1]) !== begin) {
      throw this.#error(`: the server was asked for byte ${begin} and sent byte ${range[1]}.`);
    }
    const size = range && range[3] !== '*' ? Number(range[3]) : Infinity;
    // Some servers repeat the end that they were asked for, be it behind that of the file.
    const announced = range ? Math.min(Number(range[2]) + 1, size) - begin : end - begin;
    const most = Math.min(announced, end - begin), reader = answer.body.getReader();
    let length = 0;
    for (;;) {
      const {done, value} = await reader.read().catch((error) => {
        throw this.#failure(stop, BROKE, error);
      });
      if (!done) length += value.length;
      if (length > most || (done && range && length !== announced)) {
        throw this.#error(`: the server sent ${length} bytes where ${most} were announced. Does ` +
          'it compress streams (Content-Encoding)? It should send them as they are.');
      }
      if (done) break;
      await take(value);
    }
    // Servers may send less than was asked for (RFC 9110, section 15.3.7): only where no size is
    // stated does a short answer tell the end.
    if (size < Infinity) this.size = size;
    else if (length < end - begin) this.size = begin + length;
  }

  async #read(begin, end, take, signal) {
    const whole = this.#whole, {stop} = whole;
    try {
      const last = await stoppedBy(signal, stop, () => whole.read(begin, end, take));
      if (last < end) this.size = last;
    } catch (error) {
      this.#running.delete(stop);
      this.#whole = null;
      throw this.#failure(stop, BROKE, error);
    }
  }
}
