// SPDX-License-Identifier: Apache-2.0
// How fast prefixes grow, for all that refine.

/** The first request: a picture of most terrains. */
export const FIRST_BYTES = 4096;
/** The first frame is to be soon, and so many bytes tell no more than this. */
export const FIRST_FRAME = {bytes: FIRST_BYTES, triangles: 5000, texels: 512};
/**
 * How many times as long each following prefix is, at least. A frame takes an inverse transform and
 * a mesh anew: with this growth they are few.
 */
export const GROWTH = 4;
/** So many bytes cost no more than the transform that a frame takes in any case. */
const CHEAP_BYTES = 2 ** 18;

/** What comes so soon, in ms, is waited for, as is what comes in a quarter of the time so far. */
const SOON = 150, NOT_SO_SOON = 1000;
/** Foretells when the last bytes of a request come, by how fast the first ones did. */
export class Flow {
  #begin = 0;
  #bytes = 0;  // behind the first ones, whose time is that of the request
  request() {
    this.#begin = this.#bytes = 0;
  }
  take(bytes) {
    if (this.#begin) this.#bytes += bytes;
    else this.#begin = performance.now();
  }
  /**
   * How many ms to wait for the `rest`, if it comes soon: a frame without it would only delay the
   * last one. `took`: ms of the last frame.
   */
  patience(rest, took) {
    if (rest <= 0) return 0;
    const elapsed = this.#begin ? performance.now() - this.#begin : 0;
    const most = Math.max(SOON, took, Math.min(elapsed / 4, NOT_SO_SOON));
    return !this.#bytes || rest * elapsed <= most * this.#bytes ? most : 0;
  }
}

/** How many of the `here` bytes the frame behind one of `shown` takes. */
export const nextBytes = (shown, here) =>
  Math.min(here, Math.max(CHEAP_BYTES, GROWTH ** 2 * shown));
