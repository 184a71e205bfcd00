// SPDX-License-Identifier: Apache-2.0
// A texture of longitudes and latitudes over a globe on a cube. Its left border meets its right one
// along a meridian, and its rows shrink to points at the poles: triangles there get corners of
// their own, where the texture goes on beyond its border.
import {isForest} from '../src/domains.js';
import {bodyOf, eccentricityOf} from '../src/body.js';
import {pixelsOf} from '../src/drape.js';

const DEGREE = Math.PI / 180;

/** Whether the texture of a cube lies on other places than its patches. */
export const liesOnDegrees = ({domain, hasTexture, textureDomain}) =>
  domain === 'cube' && hasTexture && !isForest(textureDomain);

/** [longitude, latitude] in degrees of the normal through a point; longitude null at a pole. */
function directionOf([x, y, z], {semiMajor}, eccentricity) {
  const across = Math.hypot(x, y);
  let latitude = Math.atan2(z, across * (1 - eccentricity));
  for (let step = 0; step < 6; ++step) {  // each leaves a hundredth of the error
    const sine = Math.sin(latitude);
    const radius = semiMajor / Math.sqrt(1 - eccentricity * sine * sine);
    latitude = Math.atan2(z + eccentricity * radius * sine, across);
  }
  const isPole = across < 1e-6 * semiMajor;  // positions are floats
  return [isPole ? null : Math.atan2(y, x) / DEGREE, latitude / DEGREE];
}

/** From longitude and latitude to a place, 0 to 1 each. A texture without a place of its own covers
 * the Earth from where the grid of the heights begins. */
function placesOn(info) {
  const {geotransform, textureHasGeotransform, textureWidth, textureHeight} = info;
  const [west = -180, , , north = 90] = info.hasGeotransform ? geotransform : [];
  const across = textureWidth / 360, down = textureHeight / 180;
  const pixels = textureHasGeotransform ? pixelsOf(info.textureGeotransform)
    : (x, y) => [(x - west) * across, (north - y) * down];
  return (longitude, latitude) => {
    const [u, v] = pixels(longitude, latitude);
    return [u / textureWidth, Math.min(Math.max(v / textureHeight, 0), 1)];
  };
}

/** The globe of a frame {positions, normals, heights, triangles} with `places` on the texture and
 * with further vertices where it needs them. */
export function draped(globe, info) {
  const body = bodyOf(info), eccentricity = eccentricityOf(body), place = placesOn(info);
  const count = globe.heights.length, triangles = globe.triangles.slice(), from = [], places = [];
  const directions = Array.from({length: count}, (_, v) =>
    directionOf(globe.positions.subarray(3 * v, 3 * v + 3), body, eccentricity));
  const add = (v, longitude) => {
    places.push(...place(longitude, directions[v][1]));
    return from.push(v) - 1;
  };
  for (let v = 0; v < count; ++v) add(v, directions[v][0] ?? 0);
  const turned = new Map();
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = triangles.subarray(t, t + 3);
    const first = Array.from(corners, (v) => directions[v][0]).find((at) => at !== null);
    if (first === undefined) continue;
    const longitudes = Array.from(corners, (v) => {
      const at = directions[v][0];
      return at === null ? null : at - 360 * Math.round((at - first) / 360);
    });
    const known = longitudes.filter((at) => at !== null);
    const middle = known.reduce((sum, at) => sum + at, 0) / known.length;
    longitudes.forEach((at, i) => {
      const v = corners[i];
      if (at === null) {
        corners[i] = add(v, middle);
      } else if (Math.abs(at - directions[v][0]) > 180) {
        const key = 2 * v + (at > 0 ? 1 : 0);
        if (!turned.has(key)) turned.set(key, add(v, at));
        corners[i] = turned.get(key);
      }
    });
  }
  const taken = (values, size) => {
    const all = new values.constructor(size * from.length);
    from.forEach((v, i) => all.set(values.subarray(size * v, size * (v + 1)), size * i));
    return all;
  };
  return {
    positions: taken(globe.positions, 3), normals: taken(globe.normals, 3),
    heights: taken(globe.heights, 1), places: Float32Array.from(places), triangles,
  };
}
