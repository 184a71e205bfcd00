// SPDX-License-Identifier: Apache-2.0
// The page's address keeps where the camera is, so that a copy of it shows the same: behind #, as
// eye, target (metres around the middle of the terrain) and height (the slider's value).

const NAMES = ['eye', 'target'];

/** Three numbers that the address gives under a name, behind # or else behind ?; null: none. */
export function place(name) {
  for (const part of [location.hash, location.search]) {
    const given = new URLSearchParams(part.slice(1)).get(name);
    const numbers = (given ?? '').split(',').map(Number);
    if (given && numbers.length === 3 && numbers.every(isFinite)) return numbers;
  }
  return null;
}

/** The value of the slider of heights that the address gives. */
export function givenHeight() {
  const value = Number(new URLSearchParams(location.hash.slice(1)).get('height'));
  return isFinite(value) ? value : 0;
}

/** Six significant digits are less than a pixel. */
const written = ({x, y, z}) => [x, y, z].map((v) => Number(v.toPrecision(6))).join();

/** Keeps a camera in the address, without an entry in the history; `null`: none. */
export function keep(camera) {
  const {pathname, search} = location;
  const hash = camera
    ? `#${NAMES.map((name) => `${name}=${written(camera[name])}`).join('&')}` +
      (camera.height ? `&height=${camera.height}` : '')
    : '';
  history.replaceState(null, '', pathname + search + hash);
}
