// SPDX-License-Identifier: Apache-2.0
// From where a camera has all of a flat terrain, or of an object, in the free part of the page.
import {MathUtils, Vector3} from 'three';

import {placeFor} from '../src/fit.js';

/** What the free part shows, as slopes: across and up for one metre ahead. */
function windowOf(camera, {left, right, top, bottom}) {
  const pixel = Math.tan(MathUtils.degToRad(camera.fov) / 2) / (innerHeight / 2);
  const {offsetX, offsetY} = camera.view;
  return {
    left: (left - innerWidth / 2 + offsetX) * pixel,
    right: (right - innerWidth / 2 + offsetX) * pixel,
    low: (innerHeight / 2 - offsetY - bottom) * pixel,
    high: (innerHeight / 2 - offsetY - top) * pixel,
  };
}

/** Of a terrain, from the south. A tall page shows more of what is seen from further above. */
function downOn({left, right, top, bottom}) {
  const steepness = MathUtils.clamp((0.9 * (bottom - top)) / (right - left), 0.62, 1.8);
  return new Vector3(-0.35, -steepness, -1).normalize();
}

/** Moves the camera of a picture; orbits then turn around what lies at the height of `middle`, or
 * as far away as that of an object. `far`: how far away it is where the terrain does not tell. */
export function lookAtAll({camera, orbit, free}, object, {middle, far}) {
  const area = free(), ahead = object.ahead ?? downOn(area);
  const across = new Vector3().crossVectors(ahead, camera.up).normalize();
  const axes = {ahead, right: across, up: new Vector3().crossVectors(across, ahead)};
  const {matrixWorld, geometry} = object, places = geometry.getAttribute('position');
  const point = new Vector3();
  const place = placeFor(axes, windowOf(camera, area), (take) => {
    for (let i = 0; i < places.count; ++i)
      take(point.fromBufferAttribute(places, i).applyMatrix4(matrixWorld));
  });
  if (!isFinite(place.length())) place.copy(middle).addScaledVector(ahead, -far);
  camera.position.copy(place);
  const away = object.isObject ? middle.clone().sub(place).dot(ahead)
    : (middle.y - place.y) / ahead.y;
  orbit.target.copy(place).addScaledVector(ahead, away);
}
