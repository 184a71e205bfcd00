// SPDX-License-Identifier: Apache-2.0
// Numbers that callers give. What is none is refused: no number of bytes would ever reach it.
import {TksError} from './error.js';

/** A rectangle; the decoder counts them by 32 bits. */
const LEAST_TRIANGLES = 2, MOST_TRIANGLES = 2 ** 32 - 1;

function checkNumber(name, value, least) {
  if (typeof value === 'number' && value >= least) return;
  const from = least > -Infinity ? ` from ${least} on` : '';
  throw new TksError('usage', `\`${name}\` is a number${from}.`);
}

export function checkBytes(bytes) {
  checkNumber('bytes', bytes, -Infinity);
}

/** As the decoder takes them. */
export function trianglesOf(triangles) {
  checkNumber('triangles', triangles, LEAST_TRIANGLES);
  return Math.min(triangles, MOST_TRIANGLES);
}

/** Longest sides of rasters. */
export function checkSides({texels, samples}) {
  checkNumber('texels', texels, 0);
  checkNumber('samples', samples, 0);
}
