// SPDX-License-Identifier: Apache-2.0
// Whether a stream is shown as a globe, and how high its relief is drawn: the address says it.
import {EARTH, bodyOf} from '../src/body.js';
import {goesRound} from '../src/globe.js';
import {givenHeight} from './camera_link.js';

/** Relief is seen from afar. That of smaller bodies is as high, and needs less. */
const USUAL_EXAGGERATION = 15;

/** How many times as high as it is, by the value of the slider of heights. */
export const exaggerationOf = (value, info) =>
  USUAL_EXAGGERATION * (bodyOf(info).semiMajor / EARTH.semiMajor) * 10 ** (value / 20);

const isFlat = () => new URLSearchParams(location.search).get('view') === 'flat';

/** `globe` of decode(): null where the stream is shown flat. */
export function globeFor(info, height = givenHeight()) {
  return goesRound(info) && !isFlat() ? {exaggeration: exaggerationOf(height, info)} : null;
}

/** Keeps in the address what is wanted, and the frame, without the camera, which is that of the
 * other one. */
export function keepFlat(flat) {
  const address = new URL(location.href);
  const frame = new URLSearchParams(address.hash.slice(1)).get('frame');
  if (flat) address.searchParams.set('view', 'flat');
  else address.searchParams.delete('view');
  for (const name of ['eye', 'target']) address.searchParams.delete(name);
  address.hash = frame ? `frame=${frame}` : '';
  history.replaceState(null, '', address);
}
