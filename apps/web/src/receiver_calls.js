// SPDX-License-Identifier: Apache-2.0
// A receiver of a served sequence (tks_receiver) in the decoder's module, and its calls.
import {TksError} from './error.js';
import {clockOf} from './group_calls.js';
import {Opened} from './opened.js';

/** TKS_MOST_CONTROL_BYTES, behind the size of a message. */
const CONTROL_BYTES = 4 + 100;
/** Width, height and 16 numbers. */
const VIEW_NUMBERS = 18;
/** What web_receiver_info() writes ahead of groups, and of each ahead of its times. */
const INFO_NUMBERS = 6, GROUP_NUMBERS = 4;

/** Groups {firstFrame, bytes, streamBytes, times}, as putGroup() writes them. */
function groupsOf(numbers) {
  const groups = [];
  for (let at = 0; at < numbers.length; ) {
    const [firstFrame, frames, bytes, streamBytes] = numbers.subarray(at, at + GROUP_NUMBERS);
    at += GROUP_NUMBERS;
    groups.push({firstFrame, bytes, streamBytes, times: [...numbers.subarray(at, at + frames)]});
    at += frames;
  }
  return groups;
}

export class Receiver {
  #instance;
  #address;
  /** With a number that no other receiver has. */
  constructor(instance, memory) {
    const [low, high] = crypto.getRandomValues(new Uint32Array(2));
    this.#instance = instance;
    this.#address = instance.calls.web_receiver_open(low, high, memory);
    if (this.#address === 0) throw new TksError('memory', 'There is no memory for a receiver.');
  }
  close() {
    this.#instance.calls.tks_receiver_close(this.#address);
  }
  #check(status) {
    if (status === 0) return;
    const {calls} = this.#instance;
    const message = calls.tks_receiver_message(this.#address);
    throw TksError.ofStatus(status, this.#instance.text(message));
  }

  /** A control message. `frame`: null: the newest one; `view`: as plannedView() gives it. */
  control({frame, link, triangles, view}) {
    const instance = this.#instance, {calls} = instance;
    return instance.with(8 * VIEW_NUMBERS + CONTROL_BYTES, (room) => {
      const out = room + 8 * VIEW_NUMBERS;
      const seen = view ? [view.width, view.height, ...view.clip] : [];
      instance.view(Float64Array, room, VIEW_NUMBERS).set(seen);
      this.#check(calls.web_receiver_control(
        this.#address, frame ?? -1, link, triangles, view ? room : 0, out));
      const [size] = instance.view(Uint32Array, out, 1);
      return instance.copy(Uint8Array, out + 4, size);
    });
  }
  take(answer) {
    const instance = this.#instance;
    instance.with(answer.length, (data) => {
      instance.view(Uint8Array, data, answer.length).set(answer);
      this.#check(instance.calls.tks_receiver_take(this.#address, data, answer.length));
    });
  }
  forget(frame) {
    this.#instance.calls.web_receiver_forget(this.#address, frame);
  }

  /** What came: {sourceFrames, answers, pieces, bytes, clock, groups}; `pieces` of the last answer;
   * `groups`: those that can be decoded. */
  state() {
    const instance = this.#instance, {calls} = instance;
    const numbers = instance.with(8, (out) => {
      calls.web_receiver_info(this.#address, out);
      const [count, address] = instance.copy(Uint32Array, out, 2);
      if (address === 0) throw new TksError('memory', 'There is no memory for what came.');
      const all = instance.copy(Float64Array, address, count);
      calls.free(address);
      return all;
    });
    const [sourceFrames, answers, pieces, bytes, ...clock] = numbers.subarray(0, INFO_NUMBERS);
    const texts = [0, 1].map((i) => instance.text(calls.web_receiver_text(this.#address, i)));
    return {
      sourceFrames, answers, pieces, bytes, clock: clockOf(...clock, texts.join('\0')),
      groups: groupsOf(numbers.subarray(INFO_NUMBERS)),
    };
  }

  /** The stream of the group of a frame, with that frame set, until the next call. */
  opened(frame) {
    const instance = this.#instance;
    const decoder = instance.with(4, (out) => {
      this.#check(instance.calls.web_receiver_frame(this.#address, frame, out));
      return instance.view(Uint32Array, out, 1)[0];
    });
    const opened = new Opened(instance, decoder, 0);
    opened.setLevels(0, 0);
    opened.size = opened.info().availableBytes;
    return opened;
  }
}
