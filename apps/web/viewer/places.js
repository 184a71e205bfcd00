// SPDX-License-Identifier: Apache-2.0
// Places that the camera goes to: what somebody types, or the address gives
// (&place=LATITUDE,LONGITUDE behind ?tks=).
import {MathUtils, Vector3} from 'three';

import {groundAxes, placedOn} from '../src/axes.js';
import {bodyOf, eccentricityOf} from '../src/body.js';
import {groundScale} from '../src/ground.js';
import {placeOf, turnsTo} from '../src/place.js';

/** A number of degrees, and the side of the Earth that it lies on. */
const DEGREES = String.raw`([+-]?\d+(?:\.\d*)?)\s*°?\s*`;
const PLACE = new RegExp(`^\\s*${DEGREES}([NS]?)[\\s,;]+${DEGREES}([EW]?)\\s*$`, 'i');

/** [longitude, latitude] of "46.5, 8.2" or "33.9° S 18.4° E"; null: it is no place. */
export function placeIn(text) {
  const [, north, side, east, half] = PLACE.exec(text ?? '') ?? [];
  const latitude = (/s/i.test(side) ? -1 : 1) * Number(north);
  const longitude = (/w/i.test(half) ? -1 : 1) * Number(east);
  const isPlace = Math.abs(latitude) <= 90 && Math.abs(longitude) <= 360;
  return isPlace ? [longitude, latitude] : null;
}

export const placeInAddress = () => placeIn(new URLSearchParams(location.search).get('place'));

/** From the centre of a globe towards a place; latitudes are geodetic. */
function directionTo(info, place) {
  const [longitude, latitude] = place.map(MathUtils.degToRad);
  const along = Math.cos(latitude), up = Math.sin(latitude) * (1 - eccentricityOf(bodyOf(info)));
  return new Vector3(along * Math.cos(longitude), up, -along * Math.sin(longitude)).normalize();
}

/** The point of flat ground, in the coordinates of its object; null: it does not reach there. */
function pointAt(object, info, [longitude, latitude]) {
  const {width, height, pixels, bounds} = placeOf(info, info.hasHeights ? 'heights' : 'texture');
  const [turn] = turnsTo(bounds, [longitude, longitude]);
  const [column, row] = pixels(longitude + (turn ?? 0), latitude);
  const isThere = column >= 0 && row >= 0 && column <= width && row <= height;
  if (turn === undefined || !isThere) return null;
  const scale = info.hasHeights ? groundScale(info) : {x: 1, y: 1};
  const [x, z] = placedOn(groundAxes(info.hasHeights ? info : {}))(
    (column - width / 2) * scale.x, (row - height / 2) * scale.y);
  return new Vector3(x, object.heightAt(x, z) || 0, z);
}

/** Where [longitude, latitude] lies on what is drawn: a point, or of a globe the direction from its
 * centre; null: beside it. */
export function pointOf(object, info, place) {
  if (object.isGlobe) return directionTo(info, place);
  try {
    return pointAt(object, info, place);
  } catch {
    return null;  // nothing says where the ground lies
  }
}
