// SPDX-License-Identifier: Apache-2.0
// Normals of meshes that are cut open for their texture, as globes and objects are: vertices at one
// position have one normal, so that no seam is seen.

/** Four bytes of a hash of the six words of a position. */
function hashOf(words, at) {
  let hash = 0;
  for (let k = 0; k < 6; ++k) {
    hash = Math.imul(hash ^ words[at + k], 0x9e3779b1);
    hash ^= hash >>> 15;
  }
  return hash;
}

function isSame(words, a, b) {
  for (let k = 0; k < 6; ++k) if (words[a + k] !== words[b + k]) return false;
  return true;
}

/** For each vertex the first one at its very position (Float64Array). */
export function firstAtPosition(positions) {
  const count = positions.length / 3, first = new Uint32Array(count);
  const words = new Uint32Array(positions.map((value) => value + 0).buffer);  // -0 is 0
  const last = 2 ** Math.ceil(Math.log2(2 * count + 2)) - 1;
  const table = new Int32Array(last + 1).fill(-1);
  for (let v = 0; v < count; ++v) {
    let slot = hashOf(words, 6 * v) & last;
    while (table[slot] >= 0 && !isSame(words, 6 * table[slot], 6 * v)) slot = (slot + 1) & last;
    if (table[slot] < 0) table[slot] = v;
    first[v] = table[slot];
  }
  return first;
}

/** For each triangle a vector along its normal, of twice its area. */
export function areasOf({positions, triangles}) {
  const areas = new Float64Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    for (let axis = 0; axis < 3; ++axis) {
      const next = (axis + 1) % 3, last = (axis + 2) % 3;
      areas[t + axis] =
        (positions[b + next] - positions[a + next]) * (positions[c + last] - positions[a + last]) -
        (positions[b + last] - positions[a + last]) * (positions[c + next] - positions[a + next]);
    }
  }
  return areas;
}

/** Unit normals of `count` groups of corners: of each the mean of its triangles', by their areas.
 * groups: for each corner of a triangle its group. */
export function meansOf(areas, groups, count) {
  const sums = new Float64Array(3 * count), means = new Float32Array(3 * count);
  groups.forEach((group, corner) => {
    const triangle = corner - (corner % 3);
    for (let axis = 0; axis < 3; ++axis) sums[3 * group + axis] += areas[triangle + axis];
  });
  for (let at = 0; at < sums.length; at += 3) {
    const length = Math.hypot(sums[at], sums[at + 1], sums[at + 2]) || 1;
    for (let axis = 0; axis < 3; ++axis) means[at + axis] = sums[at + axis] / length;
  }
  return means;
}

/** Unit normals of vertices, of which those at one position are a group. */
export function joinedNormals(mesh) {
  const first = firstAtPosition(mesh.positions);
  const means = meansOf(areasOf(mesh), mesh.triangles.map((v) => first[v]), first.length);
  return means.map((_, i) => means[3 * first[Math.floor(i / 3)] + (i % 3)]);
}
