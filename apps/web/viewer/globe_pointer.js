// SPDX-License-Identifier: Apache-2.0
// What lies under the pointer on a globe.
import {MathUtils} from 'three';

import {bodyOf, eccentricityOf} from '../src/body.js';
import {degreesText} from './pointer.js';
import {hitOn} from './ray.js';

/** The point at a place of the page, {x, y, z, height}; null: none. */
export function placeOnGlobe(globe, camera, x, y) {
  const hit = hitOn(globe, camera, x, y);
  if (!hit) return null;
  const {face: {a, b, c}, barycoord} = hit, tall = globe.geometry.getAttribute('tall');
  const height = barycoord.x * tall.getX(a) + barycoord.y * tall.getX(b) +
    barycoord.z * tall.getX(c);
  return {...hit.point, height};
}

/** Gives the text of such a point. */
export function globeDescriber(info) {
  const {unit} = info, eccentricity = eccentricityOf(bodyOf(info));
  return ({x, y, z, height}) => {
    const latitude = Math.atan2(y, Math.hypot(x, z) * (1 - eccentricity));
    const degrees = [Math.atan2(-z, x), latitude].map(MathUtils.radToDeg);
    return `${height.toFixed(0)} ${unit}`.trim() + ` · ${degreesText(degrees)}`;
  };
}
