// SPDX-License-Identifier: Apache-2.0
// The page's address keeps where the camera is and which frame is shown, so that a copy of it shows
// the same: behind #, as eye, target (metres around the middle of the terrain), height (the
// slider's value) and frame (its number).

import {framesOf} from './frame_time.js';

const NAMES = ['eye', 'target'];

/** What the address gives under a name, behind # or else behind ?; null: nothing. */
function given(name) {
  const parts = [location.hash, location.search];
  return parts.map((part) => new URLSearchParams(part.slice(1)).get(name)).find(Boolean) ?? null;
}

/** Three numbers of the address; null: none. */
function place(name) {
  const numbers = (given(name) ?? '').split(',').map(Number);
  return numbers.length === 3 && numbers.every(isFinite) ? numbers : null;
}

/** The frame of a terrain that the address gives; null: none. */
export function linkedFrame(terrain) {
  const {first, end} = framesOf(terrain), number = Number(given('frame') ?? NaN);
  return Number.isInteger(number) && number >= first && number < end ? number : null;
}
/** The same, else the first one, or of a server the newest. */
export const givenFrame = (terrain) =>
  linkedFrame(terrain) ?? (terrain.isLive ? terrain.frames - 1 : terrain.firstFrame);

/** The value of the slider of heights that the address gives. */
export function givenHeight() {
  const value = Number(new URLSearchParams(location.hash.slice(1)).get('height'));
  return isFinite(value) ? value : 0;
}

/** Looks from where the address says; false: it does not. */
export function followLink(picture) {
  const [eye, target] = NAMES.map(place);
  if (!eye || !target) return false;
  picture.look(eye, target);
  return true;
}

/** Six significant digits are less than a pixel. */
const written = ({x, y, z}) => [x, y, z].map((v) => Number(v.toPrecision(6))).join();

/** Keeps in the address, without an entry in the history, where somebody has moved the camera of a
 * picture, `height` and the number of a frame; null: none. */
export function keepLook({isMoved, camera, orbit}, height, frame) {
  const {pathname, search} = location, look = {eye: camera.position, target: orbit.target};
  const parts = isMoved ? NAMES.map((name) => `${name}=${written(look[name])}`) : [];
  if (isMoved && height) parts.push(`height=${height}`);
  if (frame !== null) parts.push(`frame=${frame}`);
  history.replaceState(null, '', pathname + search + (parts.length ? `#${parts.join('&')}` : ''));
}
