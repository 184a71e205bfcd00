// SPDX-License-Identifier: Apache-2.0
// What lies beside the ends of a raster.

/** By their numbers: those of tks_domain, and of module/domains.hpp for the cube. */
export const DOMAINS = ['plane', 'cylinder', 'forest', 'cube'];

/** Whether a raster consists of square patches one below the other. */
export const isForest = (domain) => domain === 'forest' || domain === 'cube';
