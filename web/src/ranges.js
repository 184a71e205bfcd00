// SPDX-License-Identifier: Apache-2.0
// Which bytes of a stream are here, and which requests bring others of them.

/** Places of bytes that are here, as [begin, end) in their order, none of which touch. */
export class Held {
  ranges = [];
  bytes = 0;

  add(begin, end) {
    if (begin >= end) return;
    const before = this.ranges.filter((range) => range[1] < begin);
    const behind = this.ranges.filter((range) => range[0] > end);
    const met = this.ranges.slice(before.length, this.ranges.length - behind.length);
    const joined = [Math.min(begin, ...met.map(([b]) => b)), Math.max(end, ...met.map(([, e]) => e))];
    this.ranges = [...before, joined, ...behind];
    this.bytes = this.ranges.reduce((sum, [b, e]) => sum + e - b, 0);
  }
  /** What is missing of [begin, end). */
  gaps(begin, end) {
    const gaps = [];
    for (const [b, e] of this.ranges) {
      if (e <= begin) continue;
      if (b >= end) break;
      if (b > begin) gaps.push([begin, b]);
      begin = e;
    }
    if (begin < end) gaps.push([begin, end]);
    return gaps;
  }
}

/** So few bytes between two ranges, or a larger share of all: each is a request. */
const MOST_GAP = 4096, GAP_SHARE = 1 / 8;
/** At a time: browsers keep six connections to a server of HTTP/1.1. */
const MOST_REQUESTS = 12;

/**
 * Requests [begin, end) for the first of these ranges [begin, end, ...], in their order, of at most
 * `bytes` bytes together.
 */
export function requestsFor(ranges, bytes) {
  const all = ranges.reduce((sum, [b, e]) => sum + e - b, 0);
  const gap = Math.min(GAP_SHARE * Math.min(all, bytes), MOST_GAP);
  let requests = [], left = bytes;
  for (let [begin, end] of ranges) {
    end = Math.min(end, begin + bytes);
    const isNear = ([b, e]) => b <= end + gap && begin <= e + gap;
    const near = requests.filter(isNear);
    const joined = near.reduce(([b, e], [b2, e2]) => [Math.min(b, b2), Math.max(e, e2)], [begin, end]);
    const more = joined[1] - joined[0] - near.reduce((sum, [b, e]) => sum + e - b, 0);
    if (more > left) break;
    if (near.length === 0 && requests.length === MOST_REQUESTS) continue;
    requests = [...requests.filter((range) => !isNear(range)), joined];
    left -= more;
  }
  return requests;
}
