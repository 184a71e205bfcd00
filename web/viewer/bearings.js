// SPDX-License-Identifier: Apache-2.0
// Which way is north, and how long a kilometre is in the middle of the picture.
import {$} from './page.js';

/** The longest scale bar, in pixels. */
const LONGEST = 120;

/** The largest of 1, 2 and 5 times a power of ten that is at most `most`. */
export function roundLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].find((times) => times * power <= most) * power;
}

/** A length in metres, in words. */
export function lengthText(metres) {
  const [value, unit] = metres >= 1000 ? [metres / 1000, 'km']
    : metres >= 1 ? [metres, 'm'] : metres >= 0.01 ? [metres * 100, 'cm'] : [metres * 1000, 'mm'];
  return `${Number(value.toPrecision(1)).toLocaleString('en')} ${unit}`;
}

/** `heading`: of the camera, clockwise from north, in radians. `pixelsPerMetre`: 0 is unknown. */
export function drawBearings({heading, pixelsPerMetre}) {
  $('needle').style.transform = `rotate(${-heading}rad)`;
  $('scale').hidden = !(pixelsPerMetre > 0);
  if ($('scale').hidden) return;
  const metres = roundLength(LONGEST / pixelsPerMetre);
  $('scale').style.width = `${metres * pixelsPerMetre}px`;
  $('scale').textContent = lengthText(metres);
}
