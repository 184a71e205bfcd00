// SPDX-License-Identifier: Apache-2.0
// Which way the rows and columns of the heights run on the ground. Most begin in the north-west;
// others are south-up (their first row is the southern one), mirrored, turned or sheared. The rule
// is that of the command line (apps/tools/files/place/ground_axes.hpp).
import {isForest} from './domains.js';
import {metresPerUnit} from './ground.js';

/** Of the angle between rows and columns: below it a transform has no inverse. */
const LEAST_SINE = 1e-6;

const sineOf = ({along, down}) => along[0] * down[1] - along[1] * down[0];

/**
 * Directions of length 1, each as its part to the east and its part to the south: `along` a row,
 * from its first sample on, and `down` a column. Where nothing says them, and on forests, rows run
 * east.
 */
export function groundAxes(info) {
  const unknown = {along: [1, 0], down: [0, 1]};
  if (!info.hasGeotransform || isForest(info.domain)) return unknown;
  const [metresEast, metresNorth] = metresPerUnit(info), [, a, b, , c, d] = info.geotransform;
  const direction = (east, north) => {
    const x = east * metresEast, y = north * metresNorth, length = Math.hypot(x, y);
    return [x / length, -y / length];
  };
  const axes = {along: direction(a, c), down: direction(b, d)};
  return Math.abs(sineOf(axes)) >= LEAST_SINE ? axes : unknown;
}

/** From metres along rows and down columns to metres east and south. */
export const placedOn = ({along, down}) => (x, z) =>
  [x * along[0] + z * down[0], x * along[1] + z * down[1]];

/** The inverse of placedOn(). */
export function unplacedOn(axes) {
  const {along, down} = axes, sine = sineOf(axes);
  return (east, south) => [
    (east * down[1] - south * down[0]) / sine, (south * along[0] - east * along[1]) / sine,
  ];
}

/** Normals (x along rows, y up, z down columns) with x to the east and z to the south. */
export function normalsOn(axes, normals) {
  const {along, down} = axes, sine = sineOf(axes);
  if (along[0] === 1 && down[1] === 1) return normals;
  const placed = new Float32Array(normals.length);
  for (let i = 0; i < normals.length; i += 3) {
    const [x, y, z] = normals.subarray(i, i + 3);
    const east = (x * down[1] - z * along[1]) / sine, south = (z * along[0] - x * down[0]) / sine;
    const length = Math.hypot(east, y, south);
    placed.set([east / length, y / length, south / length], i);
  }
  return placed;
}

/** Triangles that run counter-clockwise on the ground: mirrored rasters turn them over. */
export function trianglesOn(axes, triangles) {
  if (sineOf(axes) > 0) return triangles;
  return triangles.map((_, i, all) => all[i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1]);
}

/** Those of a raster that is laid straight between bounds. */
export function straightAxes(info) {
  const {along, down} = groundAxes(info);
  return {along: [along[0] < 0 ? -1 : 1, 0], down: [0, down[1] < 0 ? -1 : 1]};
}
