// SPDX-License-Identifier: Apache-2.0
// What a link brings, in bytes a second, as control messages say it: what the caller knows, or what
// answers take.

/** Of a link of which nothing came yet; the most that a message can say. */
const FIRST = 2 ** 18, MOST = 2 ** 28 - 1, LEAST = 1024;
/** An answer takes at most what the link brings in half a second (docs/CONTROL.md), and 2^20 bytes
 * of usual servers. This share of the link, or so many bytes, tell of it; shorter answers tell how
 * little there was to send. */
const FILLED = 0.4, FILLED_BYTES = 2 ** 18;
/** Of the last answer in the estimate. */
const SHARE = 0.5;

export class Link {
  /** `bytes`: null: nobody knows. */
  constructor(bytes) {
    this.bytes = bytes ?? FIRST;
    this.isKnown = bytes !== null;
  }
  /** An answer of so many bytes took so many ms. */
  took(bytes, ms) {
    if (this.isKnown || bytes < Math.min(FILLED * this.bytes, FILLED_BYTES)) return;
    const rate = (1000 * bytes) / Math.max(ms, 1);
    const next = (1 - SHARE) * this.bytes + SHARE * rate;
    this.bytes = Math.round(Math.min(Math.max(next, LEAST), MOST));
  }
}
