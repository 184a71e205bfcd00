// SPDX-License-Identifier: Apache-2.0
// Globes: which heights have one.
import {unitOfPlace} from './ground.js';

/** Of a column: the decoder's own. Files write its width with some seven digits or more. */
const TOLERANCE = 0.01;

/** Whether heights lie on a cube, or else columns go once round 360 degrees, and rows end at the
 * poles or before them. */
export function goesRound(info) {
  if (info.hasHeights && info.domain === 'cube') return true;
  if (!info.hasHeights || !info.hasGeotransform || unitOfPlace(info) !== 'degree') return false;
  const {geotransform: [, a, b, y0, c, d], width, height} = info;
  if (a === 0 || d === 0 || b !== 0 || c !== 0) return false;
  const isOnGlobe = [0.5, height - 0.5].every((row) => Math.abs(y0 + row * d) < 90 + 1e-6);
  return isOnGlobe && Math.abs(width - Math.abs(360 / a)) < TOLERANCE;
}
