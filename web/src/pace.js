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

/** What comes so soon, in ms, is waited for; so is what comes within a quarter of the time so far. */
const SOON = 150, NOT_SO_SOON = 1000;
/** Foretells when bytes come, by how fast those before did. */
export class Arrival {
  #begin = performance.now();
  #from;
  constructor(here) {
    this.#from = here;
  }
  /**
   * How many ms to wait for the `rest` behind the `here` bytes, if it comes soon: a frame without it
   * would only delay the last one. `took`: ms of the last frame.
   */
  patience(here, rest, took) {
    if (rest <= 0) return 0;
    const elapsed = performance.now() - this.#begin;
    const most = Math.max(SOON, took, Math.min(elapsed / 4, NOT_SO_SOON));
    return rest * elapsed <= most * (here - this.#from) ? most : 0;
  }
}

/** How many of the `here` bytes the frame behind one of `shown` takes. */
export const nextBytes = (shown, here) =>
  Math.min(here, Math.max(CHEAP_BYTES, GROWTH ** 2 * shown));
