// SPDX-License-Identifier: Apache-2.0
// The module's calls that read a sequence: heads of groups, and where groups lie in a file.
import {TksError} from './error.js';
import {MESSAGE_BYTES} from './instance.js';

/** web_head: eleven numbers, and the times of up to 32 frames. */
const HEAD_NUMBERS = 11, MOST_FRAMES = 32;
/** web_place. */
const PLACE_NUMBERS = 5;

/** Of tks_status. */
const USAGE = 1;

/** text: epoch and calendar, each with a 0 at its end. */
export function clockOf(numerator, denominator, text) {
  if (numerator === 0) return null;
  const [epoch, calendar] = text.split('\0');
  return {numerator, denominator, epoch, calendar};
}

/**
 * The head of a group that `bytes` begin with: {bytes, firstFrame, times, streamBytes, indexBytes,
 * streamHeaderBytes, clock, number, depth, bytesBack}. It goes on from `depth` groups, which begin
 * `bytesBack` before it. An error of the code `truncated` says how many are `needed`, at least.
 */
export function readHead(instance, bytes) {
  // The texts are parts of the head.
  const numbers = 8 * (HEAD_NUMBERS + MOST_FRAMES), room = bytes.length + MESSAGE_BYTES;
  return instance.with(numbers + room + bytes.length, (out) => {
    const text = out + numbers, data = text + room;
    instance.view(Uint8Array, data, bytes.length).set(bytes);
    const status = instance.calls.web_read_head(data, bytes.length, out, text, room);
    const [needed, firstFrame, frames, streamBytes, indexBytes, streamHeaderBytes, number, depth,
      bytesBack, ...clock] = instance.view(Float64Array, out, HEAD_NUMBERS);
    if (status !== 0) {
      throw Object.assign(TksError.ofStatus(status, instance.text(text)), {needed});
    }
    const written = instance.view(Uint8Array, text, room);
    return {
      bytes: needed, firstFrame, streamBytes, indexBytes, streamHeaderBytes,
      number, depth, bytesBack,
      times: [...instance.view(Float64Array, out + 8 * HEAD_NUMBERS, frames)],
      clock: clockOf(...clock, new TextDecoder().decode(written)),
    };
  });
}

/**
 * Where a frame or, `byTime`, a time lies in the file whose bytes before `end` are `tail`: the
 * range [begin, end) of its group if `found`, else of the end of another group, to be looked
 * through next. `lastEnd` and `frames`: where the last group in `tail` ends, and how many frames
 * there are up to there. null: there is no index in `tail`.
 */
export function locate(instance, {tail, end, byTime, place}) {
  return instance.with(8 * PLACE_NUMBERS + tail.length, (out) => {
    const data = out + 8 * PLACE_NUMBERS;
    instance.view(Uint8Array, data, tail.length).set(tail);
    const status =
      instance.calls.web_locate(data, tail.length, end, Number(byTime), place, out);
    if (status === USAGE) return null;
    if (status !== 0) {
      throw TksError.ofStatus(status, 'Corrupt sequence: an index lists more than there is.');
    }
    const [begin, rangeEnd, found, lastEnd, frames] =
      instance.view(Float64Array, out, PLACE_NUMBERS);
    return {begin, end: rangeEnd, found: found !== 0, lastEnd, frames};
  });
}
