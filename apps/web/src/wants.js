// SPDX-License-Identifier: Apache-2.0
// What a receiver tells a server that it wants, in the ranges of control messages
// (docs/CONTROL.md).
import {TksError} from './error.js';
import {plannedView} from './view.js';

const MOST_RATE = 2 ** 28 - 1, MOST_FRAME = 32 * 2 ** 32;

function wholeNumber(name, value, least, most) {
  if (Number.isInteger(value) && value >= least && value <= most) return value;
  throw new TksError('usage', `\`${name}\` is a whole number from ${least} to ${most}.`);
}

/** {frame, link, triangles, view}: frame: null: the newest; link, in bytes a second: null: as it
 * proves; triangles: 0: any number; view: null: all ground counts alike. */
export function wantsOf({frame = null, link = null, triangles = 0, view = null}) {
  return {
    frame: frame === null || frame === 'newest' ? null : wholeNumber('frame', frame, 0, MOST_FRAME),
    link: link === null ? null
      : wholeNumber('link', Math.min(Math.round(link), MOST_RATE), 1, MOST_RATE),
    triangles: triangles === Infinity ? 0 : wholeNumber('triangles', triangles, 0, MOST_RATE),
    view: plannedView(view),
  };
}
