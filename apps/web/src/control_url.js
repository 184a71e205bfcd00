// SPDX-License-Identifier: Apache-2.0
// The URL that control messages of a receiver go to (docs/CONTROL.md), by POST. Each failure says
// by `mayPass` whether another message may be answered.
import {stoppedBy} from './abort.js';
import {TksError} from './error.js';
import {joined} from './pieces.js';
import {BROKE, hasBroken, refusalOf} from './refusal.js';

/** No server sends more at a time (tks_transmitter_options.answer_bytes: 2^20 unless it was told
 * more). */
const MOST_ANSWER = 2 ** 26;
/** Statuses below 500 of servers that are busy, and of a message that does not fit to theirs. */
const PASSING = [408, 409, 425, 429];
/** Characters of a refusal that are shown. */
const MOST_TEXT = 200;

const failure = (code, message, {mayPass, status, cause}) =>
  Object.assign(new TksError(code, message, {cause}), {mayPass, status});

export class ControlUrl {
  #url;
  #request;
  #timeout;

  /** `request`: headers and credentials, as fetch() takes them; `timeout`: so many ms without a
   * byte are too long. */
  constructor(url, {request = {}, timeout}) {
    [this.#url, this.#request, this.#timeout] = [String(url), request, timeout];
  }

  /**
   * The answer to a message. `after`: the server may wait until it has a frame of that number;
   * null: it does not wait. `quit`: a signal that ends the call as long as nothing comes; `signal`:
   * one that ends it in any case.
   */
  async post(message, {after, quit, signal}) {
    const stop = new AbortController();
    const late = failure('io', `${this.#url} sends nothing for ${this.#timeout / 1000} s.`,
      {mayPass: true});
    let timer = 0;
    const wait = () => {
      clearTimeout(timer);
      timer = setTimeout(() => stop.abort(late), this.#timeout);
    };
    const leave = () => stop.abort(quit.reason);
    quit.addEventListener('abort', leave);
    if (quit.aborted) leave();
    wait();
    try {
      return await stoppedBy(signal, stop, async () => {
        const answer = await this.#fetch(message, after, stop.signal);
        quit.removeEventListener('abort', leave);
        return this.#bytesOf(answer, wait);
      });
    } catch (error) {
      throw stop.signal.aborted ? stop.signal.reason : error;
    } finally {
      clearTimeout(timer);
      quit.removeEventListener('abort', leave);
      stop.abort();  // of an answer that is not read
    }
  }
  async #fetch(message, after, signal) {
    const {headers, credentials} = this.#request;
    const waits = after === null ? '' : `${this.#url.includes('?') ? '&' : '?'}after=${after}`;
    try {
      return await fetch(this.#url + waits,
        {method: 'POST', body: message, headers, credentials, cache: 'no-store', signal});
    } catch (error) {
      signal.throwIfAborted();
      const why = hasBroken(error) ? BROKE : await refusalOf(this.#url, signal);
      throw failure('io', this.#url + why, {mayPass: true, cause: error});
    }
  }
  /** `came()` is called with each piece. */
  async #bytesOf(answer, came) {
    const {status} = answer;
    if (!answer.ok || !answer.body) throw await this.#refused(answer);
    const parts = [], reader = answer.body.getReader();
    for (let length = 0; ;) {
      const {done, value} = await reader.read().catch((error) => {
        throw failure('io', this.#url + BROKE, {mayPass: true, cause: error});
      });
      if (done) return joined(parts);
      came();
      parts.push(value);
      length += value.length;
      if (length > MOST_ANSWER) {
        throw failure('limit', `${this.#url} answers with more than 64 MB.`, {status});
      }
    }
  }
  async #refused(answer) {
    const {status, statusText} = answer, text = await answer.text().catch(() => '');
    const isText = answer.headers.get('content-type')?.startsWith('text/plain');
    const why = isText ? `: ${text.slice(0, MOST_TEXT).trim()}` : '.';
    const mayPass = status >= 500 || PASSING.includes(status);
    return failure('io',
      `${this.#url}: the server answered ${`${status} ${statusText}`.trimEnd()}${why}`,
      {mayPass, status});
  }
}
