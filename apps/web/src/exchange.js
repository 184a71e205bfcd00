// SPDX-License-Identifier: Apache-2.0
// Exchanges control messages for answers, one after the other, as long as a receiver lives: asks
// for what is wanted, rests where nothing more helps, and goes on behind failures.
import {askDecoder} from './decoders.js';
import {Link} from './link.js';

/** ms between messages that bring nothing: servers of files that do not grow answer at once. */
const LEAST_REST = 100, MOST_REST = 2000;
/** ms behind the first failure of several; each further rest is twice as long, up to the most. */
const FIRST_REST = 100;
/** So many damaged answers one behind the other are not of what came before. */
const MOST_DAMAGED = 2;

const DAMAGES = ['corrupt', 'unsupported'];

/** Resolves after so many ms, or once the signal aborts. */
const pause = (ms, signal) => new Promise((resolve) => {
  const end = () => {
    clearTimeout(timer);
    signal.removeEventListener('abort', end);
    resolve();
  };
  const timer = setTimeout(end, ms);
  signal.addEventListener('abort', end);
  if (signal.aborted) end();
});

export class Exchange {
  /** How many messages went out. */
  messages = 0;
  #decoder;
  #url;
  #patience;
  #told;
  #link;
  #end = new AbortController();
  #quit = new AbortController();  // of a rest, or of a message that waits for frames
  #sourceFrames = 0;
  #kept = 0;  // frames before this one were given up
  #served = '';  // what was wanted when an answer brought nothing
  #idle = LEAST_REST;  // ms of the next rest
  #isAnswered = false;
  #failing = null;  // {since, rest, damaged} while messages fail

  /** `url`: a ControlUrl. `wants()` gives {frame, view, triangles}, as Receiver.control() takes
   * them, and `keeps()` the first frame that is to stay; `took(state, wants)` hears of each answer;
   * `failed(error)` hears why no other one will come. `patience`: ms for which messages may fail,
   * once one was answered; `link`: bytes a second; null: as answers come. */
  constructor(decoder, url, {link, patience, ...told}) {
    [this.#decoder, this.#url, this.#patience, this.#told] = [decoder, url, patience, told];
    this.#link = new Link(link);
  }

  /** Something else may be wanted: what rests goes on. */
  wake() {
    this.#quit.abort();
  }
  stop(reason) {
    this.#end.abort(reason);
    this.wake();
  }
  set link(bytes) {
    this.#link = new Link(bytes);
  }

  async run() {
    try {
      while (!this.#end.signal.aborted) await this.#tryTurn();
    } catch (error) {
      if (!this.#end.signal.aborted) this.#told.failed(error);
    }
  }
  async #tryTurn() {
    this.#quit = new AbortController();
    try {
      await this.#turn();
      this.#failing = null;
    } catch (error) {
      const isOver = this.#end.signal.aborted || !this.#quit.signal.aborted;
      if (isOver) await this.#goOn(error);
    }
  }
  #ask(operation, argument) {
    return askDecoder(this.#decoder, operation, argument);
  }
  /** One message and its answer. */
  async #turn() {
    const wants = this.#told.wants(), key = JSON.stringify(wants);
    if (wants.frame !== null && wants.frame < this.#kept) await this.#renew();
    const isServed = key === this.#served, begun = performance.now();
    const message = await this.#ask('control', {...wants, link: this.#link.bytes});
    ++this.messages;
    const {signal} = this.#end, quit = isServed ? this.#quit.signal : signal;
    const after = isServed ? this.#sourceFrames : null;
    const answer = await this.#url.post(message, {after, quit, signal});
    const took = performance.now() - begun;
    if (!isServed) this.#link.took(answer.length, took);
    const state = await this.#take(answer);
    this.#served = state.pieces === 0 ? key : '';
    this.#told.took(state, wants);
    if (state.pieces === 0 && isServed) await this.#restAfter(took);
  }
  async #take(answer) {
    let state = await this.#ask('take', answer);
    this.#isAnswered = true;
    if (state.sourceFrames > this.#sourceFrames) this.#idle = LEAST_REST;
    this.#sourceFrames = state.sourceFrames;
    const keeps = this.#told.keeps(state);
    if (state.groups.length > 0 && keeps > state.groups[0].firstFrame) {
      state = await this.#ask('forget', keeps);
      this.#kept = state.groups[0]?.firstFrame ?? keeps;
    }
    return state;
  }
  /** Where the server has not waited for frames itself. */
  async #restAfter(took) {
    if (took >= LEAST_REST) return;
    await pause(this.#idle, this.#quit.signal);
    this.#idle = Math.min(2 * this.#idle, MOST_REST);
  }
  async #renew() {
    await this.#ask('renew');
    [this.#kept, this.#served] = [0, ''];
  }

  /** Rests behind a failure, or throws it where no other message is worth while. */
  async #goOn(error) {
    const now = performance.now(), isDamaged = DAMAGES.includes(error.code);
    const failing = (this.#failing ??= {since: now, rest: FIRST_REST, damaged: 0});
    const mayPass = this.#isAnswered && (error.mayPass || isDamaged);
    if (!mayPass || now - failing.since >= this.#patience) throw error;
    failing.damaged += isDamaged;
    if (error.status === 409 || failing.damaged === MOST_DAMAGED) {
      failing.damaged = 0;
      await this.#renew();
    }
    await pause(failing.rest, this.#end.signal);
    failing.rest = Math.min(2 * failing.rest, MOST_REST);
  }
}
