// SPDX-License-Identifier: Apache-2.0
// Keys of the picture while nobody flies: arrows turn as a drag that way does, + and - zoom.

const TURN = 0.08, NEARER = 0.9;
const KEYS = {
  'ArrowLeft': (orbit, turn) => orbit.rotateLeft(-turn),
  'ArrowRight': (orbit, turn) => orbit.rotateLeft(turn),
  'ArrowUp': (orbit, turn) => orbit.rotateUp(-turn),
  'ArrowDown': (orbit, turn) => orbit.rotateUp(turn),
  '+': (orbit, turn, nearer) => orbit.dollyIn(1 / nearer),
  '=': (orbit, turn, nearer) => orbit.dollyIn(1 / nearer),
  '-': (orbit, turn, nearer) => orbit.dollyOut(1 / nearer),
};

/** Moves as a key says, less where a drag and the wheel do less as well; false: it says nothing. */
export function moveByKey(key, orbit) {
  if (!KEYS[key]) return false;
  KEYS[key](orbit, TURN * orbit.rotateSpeed, NEARER ** orbit.zoomSpeed);
  return true;
}
