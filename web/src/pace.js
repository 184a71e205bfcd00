// SPDX-License-Identifier: Apache-2.0
// How fast prefixes grow, for all that refine.

/** The first request: a picture of most terrains. */
export const FIRST_BYTES = 4096;
/**
 * How many times as long each following prefix is. A frame takes an inverse transform and a mesh
 * anew: with this growth they are few.
 */
export const GROWTH = 4;
