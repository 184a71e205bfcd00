// SPDX-License-Identifier: Apache-2.0
// Unit normals of heights by central differences of their grid: x along the rows, y up, z down the
// rows.

/** Nothing beside voids: cells there count as flat. */
const slope = (a, b, distance) => (distance > 0 && a === a && b === b ? (b - a) / distance : 0);

/** Writes the normal at (x, y) of a surface from normals[at] on. `scale`: that of groundScale(). */
function putNormal({data, width, height, level}, x, y, scale, normals, at) {
  const side = 2 ** level, row = y * width;
  const left = Math.max(x - 1, 0), right = Math.min(x + 1, width - 1);
  const above = Math.max(y - 1, 0), below = Math.min(y + 1, height - 1);
  const dx = slope(data[row + left], data[row + right], (right - left) * side);
  const dz = slope(data[above * width + x], data[below * width + x], (below - above) * side);
  const nx = (-dx * scale.height) / scale.x, nz = (-dz * scale.height) / scale.y;
  const length = Math.sqrt(nx * nx + 1 + nz * nz);
  normals[at] = nx / length;
  normals[at + 1] = 1 / length;
  normals[at + 2] = nz / length;
}

/** Of a mesh's vertices on a grid of `width` columns, by a surface at any level. */
export function meshNormals(mesh, width, surface, scale) {
  const normals = new Float32Array(3 * mesh.gridIndex.length), side = 2 ** surface.level;
  mesh.gridIndex.forEach((index, i) => {
    const x = Math.min(Math.round((index % width) / side), surface.width - 1);
    const y = Math.min(Math.round(Math.floor(index / width) / side), surface.height - 1);
    putNormal(surface, x, y, scale, normals, 3 * i);
  });
  return normals;
}

/** Of all samples of a surface. */
export function gridNormals(surface, scale) {
  const {width, height} = surface, normals = new Float32Array(3 * width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      putNormal(surface, x, y, scale, normals, 3 * (y * width + x));
    }
  }
  return normals;
}
