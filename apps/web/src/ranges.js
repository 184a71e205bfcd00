// SPDX-License-Identifier: Apache-2.0
// Which bytes of a stream are here, and which requests bring others of them.

/** What is missing of [begin, end) among ranges in their order. */
export function gapsIn(ranges, begin, end) {
  const gaps = [];
  for (const [b, e] of ranges) {
    if (e <= begin) continue;
    if (b >= end) break;
    if (b > begin) gaps.push([begin, b]);
    begin = e;
  }
  if (begin < end) gaps.push([begin, end]);
  return gaps;
}

/** Places of bytes that are here, as [begin, end) in their order, none of which touch. */
export class Held {
  ranges = [];
  bytes = 0;

  add(begin, end) {
    if (begin >= end) return;
    const before = this.ranges.filter((range) => range[1] < begin);
    const behind = this.ranges.filter((range) => range[0] > end);
    const met = this.ranges.slice(before.length, this.ranges.length - behind.length);
    const joined =
      [Math.min(begin, ...met.map(([b]) => b)), Math.max(end, ...met.map(([, e]) => e))];
    this.ranges = [...before, joined, ...behind];
    this.bytes = this.ranges.reduce((sum, [b, e]) => sum + e - b, 0);
  }
  /** What is missing of [begin, end). */
  gaps(begin, end) {
    return gapsIn(this.ranges, begin, end);
  }
}

/** At a time: browsers keep six connections to a server of HTTP/1.1. */
const MOST_REQUESTS = 12;

/**
 * Requests [begin, end) for the first of the ranges {begin, end, gain} of a plan that help, of a
 * file of `size` bytes; for at most `most` bytes.
 */
export function requestsFor(plan, size, most = Infinity) {
  const requests = [];
  for (const {begin, end, gain} of plan) {
    if (requests.length === MOST_REQUESTS || most <= 0) break;
    if (gain <= 0 || begin >= size) continue;
    const last = Math.min(end, size, begin + most);
    requests.push([begin, last]);
    most -= last - begin;
  }
  return requests;
}
