// SPDX-License-Identifier: Apache-2.0
// Globes: which heights have one, and the normals of their meshes.
import {unitOfPlace} from './ground.js';

/** Of a column: the decoder's own. Files write its width with some seven digits or more. */
const TOLERANCE = 0.01;

/** Whether heights lie on a cube, or else columns go once round 360 degrees, and rows end at the
 * poles or before them. */
export function goesRound(info) {
  if (info.hasHeights && info.domain === 'cube') return true;
  if (!info.hasHeights || !info.hasGeotransform || unitOfPlace(info) !== 'degree') return false;
  const {geotransform: [, a, b, y0, c, d], width, height} = info;
  if (a === 0 || d === 0 || b !== 0 || c !== 0) return false;
  const isOnGlobe = [0.5, height - 0.5].every((row) => Math.abs(y0 + row * d) < 90 + 1e-6);
  return isOnGlobe && Math.abs(width - Math.abs(360 / a)) < TOLERANCE;
}

/** For each vertex the first one at its very position. */
function firstAtPosition(positions) {
  const firsts = new Map(), count = positions.length / 3, first = new Uint32Array(count);
  for (let v = 0; v < count; ++v) {
    const [x, y, z] = positions.subarray(3 * v, 3 * v + 3);
    let key = x + 1.37 * y + 2.71 * z;
    for (;; ++key) {  // on where another position has this key
      const other = firsts.get(key);
      if (other === undefined) firsts.set(key, v);
      else if ([x, y, z].some((value, i) => value !== positions[3 * other + i])) continue;
      first[v] = other ?? v;
      break;
    }
  }
  return first;
}

/** Unit normals: of each position the mean of its triangles', by their areas. */
export function normalsOfGlobe({positions, triangles}) {
  const first = firstAtPosition(positions), sums = new Float64Array(positions.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => 3 * triangles[t + corner]);
    const side = (to, axis) => positions[to + axis] - positions[a + axis];
    for (let axis = 0; axis < 3; ++axis) {
      const next = (axis + 1) % 3, last = (axis + 2) % 3;
      const part = side(b, next) * side(c, last) - side(b, last) * side(c, next);
      for (const corner of [a, b, c]) sums[3 * first[corner / 3] + axis] += part;
    }
  }
  const normals = new Float32Array(positions.length);
  first.forEach((vertex, v) => {
    const sum = sums.subarray(3 * vertex, 3 * vertex + 3), length = Math.hypot(...sum) || 1;
    normals.set(sum.map((value) => value / length), 3 * v);
  });
  return normals;
}
