// SPDX-License-Identifier: Apache-2.0
// Decodes what a receiver of a served sequence has got. Nothing here waits: workers run it, too.
import {TksError} from './error.js';
import {partsOf} from './frame.js';
import {Instance, failureOf} from './instance.js';
import {Receiver} from './receiver_calls.js';
import {EXHAUSTED} from './stream_decoder.js';

export class ReceivingDecoder {
  #instance = null;
  #receiver = null;
  #before = null;  // the receiver that began anew, until frames came to the new one

  constructor(module, memory) {
    [this.module, this.memory] = [module, memory];
  }

  /** What `use` gives. An instance that aborted does no more, and what came is lost with it. */
  #called(use) {
    try {
      this.#instance ??= new Instance(this.module);
      return use((this.#receiver ??= new Receiver(this.#instance, this.memory)));
    } catch (error) {
      throw this.#failure(error);
    }
  }
  #failure(error) {
    if (!(error instanceof TksError)) this.#instance = this.#receiver = this.#before = null;
    return failureOf(error, EXHAUSTED);
  }
  /** The receiver whose frames are shown. */
  get #shown() {
    return this.#before ?? this.#receiver;
  }

  /** A control message, as Receiver has it. */
  control(wants) {
    return this.#called((receiver) => receiver.control(wants));
  }
  /** Takes an answer, and gives what there is: of groups those that can be shown. */
  take(answer) {
    return this.#called((receiver) => {
      receiver.take(answer);
      const state = receiver.state();
      if (state.groups.length > 0) this.#leaveBefore();
      return this.#before ? {...state, groups: this.#before.state().groups} : state;
    });
  }
  #leaveBefore() {
    this.#before?.close();
    this.#before = null;
  }
  /** The transmitter knows nothing of this receiver any more, or has become another one. */
  renew() {
    this.#called((receiver) => {
      if (this.#before) receiver.close();
      else this.#before = receiver;
      this.#receiver = null;
    });
  }
  /** Gives up groups that end before a frame; gives what is left. */
  forget(frame) {
    return this.#called((receiver) => {
      this.#shown.forget(frame);
      return {...receiver.state(), groups: this.#shown.state().groups};
    });
  }

  /** Makes a frame of what came, a part of it at each step. Until it returns it no other call may
   * be made, or it has to be given up. */
  *parts(request) {
    try {
      yield;
      const opened = this.#called(() => this.#shown.opened(request.frame));
      const info = opened.info();
      const parts = yield* partsOf(opened, info, request);
      return {bytes: opened.size, complete: opened.size >= info.streamBytes, info, ...parts};
    } catch (error) {
      throw this.#failure(error);
    }
  }

  /** Which bytes of its group a window of a frame takes. */
  needed({frame, part, window}) {
    return this.#called(() => this.#shown.opened(frame).needed(part, window));
  }
}
