// SPDX-License-Identifier: Apache-2.0
// Numbers that callers give. What is none is refused: no number of bytes would ever reach it.
import {TksError} from './error.js';

/** A rectangle; the decoder counts them by 32 bits. */
const LEAST_TRIANGLES = 2, MOST_TRIANGLES = 2 ** 32 - 1;

function refuse(name, what) {
  throw new TksError('usage', `\`${name}\` is ${what}.`);
}

export function checkNumber(name, value, least) {
  if (typeof value !== 'number' || !(value >= least)) refuse(name, `a number from ${least} on`);
}

export function checkBytes(bytes) {
  checkNumber('bytes', bytes, 0);
}

/** As the decoder takes them. */
export function trianglesOf(triangles) {
  if (triangles !== Infinity && !(Number.isInteger(triangles) && triangles >= LEAST_TRIANGLES)) {
    refuse('triangles', `a whole number from ${LEAST_TRIANGLES} on, or Infinity`);
  }
  return Math.min(triangles, MOST_TRIANGLES);
}

/** A frame, by its number. */
export function checkFrame(frame, first, end) {
  if (Number.isInteger(frame) && frame >= first && frame < end) return;
  refuse('frame', end > first + 1 ? `the number of a frame, from ${first} to ${end - 1}`
    : `${first}, as there is no other frame`);
}

/** Mip levels, where they are given in the place of sides. */
export function checkLevels({textureLevel, surfaceLevel}, info) {
  const check = (name, level, coarsest) => {
    if (level === undefined || level === null) return;
    if (!Number.isInteger(level) || level < 0 || level > coarsest) {
      refuse(name, `a mip level of this stream, a whole number from 0 to ${coarsest}`);
    }
  };
  if (info.hasTexture) check('textureLevel', textureLevel, info.textureCoarsestLevel);
  if (info.hasHeights) check('surfaceLevel', surfaceLevel, info.coarsestLevel);
}

/** Longest sides of rasters. */
export function checkSides({texels, samples}) {
  checkNumber('texels', texels, 0);
  checkNumber('samples', samples, 0);
}
