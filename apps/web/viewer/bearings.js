// SPDX-License-Identifier: Apache-2.0
// Which way is north, and how long a kilometre is in the middle of the picture.
import {MathUtils, Vector3} from 'three';

import {$} from './page.js';

/** The longest scale bar, in pixels. */
const LONGEST = 120;

/** The largest of 1, 2 and 5 times a power of ten that is at most `most`. */
function roundLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].find((times) => times * power <= most) * power;
}

/** A length in metres, in words. */
function lengthText(metres) {
  const [value, unit] = metres >= 1000 ? [metres / 1000, 'km']
    : metres >= 1 ? [metres, 'm'] : metres >= 0.01 ? [metres * 100, 'cm'] : [metres * 1000, 'mm'];
  return `${Number(value.toPrecision(1)).toLocaleString('en')} ${unit}`;
}

/** The direction of a camera, clockwise from north, in radians. */
function headingOf(camera) {
  const ahead = camera.getWorldDirection(new Vector3());
  // Straight down, what is above in the picture tells it.
  if (Math.abs(ahead.y) > 0.999) ahead.set(0, 1, 0).transformDirection(camera.matrixWorld);
  return Math.atan2(ahead.x, -ahead.z);
}

/** Of the ground across, at a place that a camera looks at. */
function pixelsPerMetre(camera, place) {
  const distance = camera.position.distanceTo(place);
  return innerHeight / (2 * distance * Math.tan(MathUtils.degToRad(camera.fov) / 2));
}

/** `place`: where the scale is that of the bar; null: there is none. North of a globe is above. */
export function drawBearings(camera, place, isGlobe) {
  $('needle').style.transform = `rotate(${isGlobe ? 0 : -headingOf(camera)}rad)`;
  $('scale').hidden = place === null;
  if ($('scale').hidden) return;
  const pixels = pixelsPerMetre(camera, place), metres = roundLength(LONGEST / pixels);
  $('scale').style.width = `${metres * pixels}px`;
  $('scale').textContent = lengthText(metres);
}
