// SPDX-License-Identifier: Apache-2.0
// The frames that a receiver can decode, as the last answer left them: groups, between which others
// may be missing.

export class HeldFrames {
  clock = null;
  /** How many frames the server has. */
  sourceFrames = 0;
  /** By the numbers of frames, in ticks. */
  times = [];
  #groups = [];  // {firstFrame, bytes, streamBytes, times}, in their order

  /** `state`: as Receiver gives it. */
  set({clock, sourceFrames, groups}) {
    [this.clock, this.sourceFrames, this.#groups] = [clock, sourceFrames, groups];
    this.times = [];
    for (const {firstFrame, times} of groups) {
      times.forEach((time, i) => (this.times[firstFrame + i] = time));
    }
  }
  get isEmpty() {
    return this.#groups.length === 0;
  }
  get firstFrame() {
    return this.#groups[0]?.firstFrame ?? 0;
  }
  /** The number of the last frame, and one. */
  get frames() {
    const last = this.#groups.at(-1);
    return last ? last.firstFrame + last.times.length : 0;
  }
  /** The group of a frame, if that is there. */
  groupOf(frame) {
    return this.#groups.find(({firstFrame, times}) =>
      firstFrame <= frame && frame < firstFrame + times.length);
  }
  /** The last frame whose time is not after this one, or the first one. */
  at(time) {
    const group = this.#groups.findLast(({times}) => times[0] <= time) ?? this.#groups[0];
    return group.firstFrame + Math.max(group.times.findLastIndex((each) => each <= time), 0);
  }
}
