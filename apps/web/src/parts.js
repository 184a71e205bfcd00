// SPDX-License-Identifier: Apache-2.0

/** The numbers of tks_part. */
export const PARTS = {heights: 0, texture: 2};
