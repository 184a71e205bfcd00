// SPDX-License-Identifier: Apache-2.0
// Whether a stream is shown as a globe, and how high its relief is drawn: the address says it.
import {goesRound} from '../src/globe.js';
import {givenHeight} from './camera_link.js';

/** Relief is seen from afar. */
const USUAL_EXAGGERATION = 15;

/** How many times as high as it is, by the value of the slider of heights. */
export const exaggerationOf = (value) => USUAL_EXAGGERATION * 10 ** (value / 20);

const isFlat = () => new URLSearchParams(location.search).get('view') === 'flat';

/** `globe` of decode(): null where the stream is shown flat. */
export function globeFor(info, height = givenHeight()) {
  return goesRound(info) && !isFlat() ? {exaggeration: exaggerationOf(height)} : null;
}

/** Keeps in the address what is wanted, without the camera, which is that of the other one. */
export function keepFlat(flat) {
  const address = new URL(location.href);
  if (flat) address.searchParams.set('view', 'flat');
  else address.searchParams.delete('view');
  for (const name of ['eye', 'target']) address.searchParams.delete(name);
  address.hash = '';
  history.replaceState(null, '', address);
}
