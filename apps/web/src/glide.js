// SPDX-License-Identifier: Apache-2.0
// Where the surface of one mesh lies under the vertices of another, so that a renderer can let the
// one glide into the other (geomorphing: Hoppe, Progressive Meshes, 1996, section 3.1). Meshes are
// arrays as three.js has them: x, y, z of each vertex, y up; a normal of each; triples of vertices.

/** Vertices sorted into square cells of the ground, of about one vertex each. */
class Cells {
  constructor(positions) {
    const count = positions.length / 3;
    const bounds = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += 3) {
      bounds[0] = Math.min(bounds[0], positions[i]);
      bounds[1] = Math.min(bounds[1], positions[i + 2]);
      bounds[2] = Math.max(bounds[2], positions[i]);
      bounds[3] = Math.max(bounds[3], positions[i + 2]);
    }
    [this.x, this.z] = bounds;
    const width = bounds[2] - bounds[0], depth = bounds[3] - bounds[1];
    this.size = Math.max(Math.sqrt((width * depth) / count), (width + depth) / count) || 1;
    this.columns = Math.floor(width / this.size) + 1;
    this.rows = Math.floor(depth / this.size) + 1;
    this.#sort(positions, count);
  }
  column(x) {
    return Math.min(this.columns - 1, Math.max(0, Math.floor((x - this.x) / this.size)));
  }
  row(z) {
    return Math.min(this.rows - 1, Math.max(0, Math.floor((z - this.z) / this.size)));
  }
  /** `vertices` of cell c are those from first[c] to first[c + 1]. */
  #sort(positions, count) {
    const cells = Uint32Array.from({length: count},
      (_, i) => this.row(positions[3 * i + 2]) * this.columns + this.column(positions[3 * i]));
    this.first = new Uint32Array(this.columns * this.rows + 1);
    for (const cell of cells) ++this.first[cell + 1];
    for (let c = 1; c < this.first.length; ++c) this.first[c] += this.first[c - 1];
    const next = this.first.slice();
    this.vertices = new Uint32Array(count);
    cells.forEach((cell, i) => (this.vertices[next[cell]++] = i));
  }
}

/** A vertex on an edge belongs to both of its triangles; rounding shall give it to one of them. */
const SLACK = 1e-4;

/** A triangle over the ground, as weights of its corners. */
export class Triangle {
  constructor(positions, corners) {
    this.corners = corners;
    const x = (k) => positions[3 * corners[k]], z = (k) => positions[3 * corners[k] + 2];
    [this.x, this.z] = [x(0), z(0)];
    [this.bx, this.bz] = [x(1) - this.x, z(1) - this.z];
    [this.cx, this.cz] = [x(2) - this.x, z(2) - this.z];
    this.area = this.bx * this.cz - this.cx * this.bz;
    this.left = Math.min(x(0), x(1), x(2));
    this.right = Math.max(x(0), x(1), x(2));
    this.near = Math.min(z(0), z(1), z(2));
    this.far = Math.max(z(0), z(1), z(2));
  }
  /** Three weights into `out`, or false: (x, z) lies outside. */
  weigh(x, z, out) {
    const dx = x - this.x, dz = z - this.z;
    out[1] = (dx * this.cz - this.cx * dz) / this.area;
    out[2] = (this.bx * dz - dx * this.bz) / this.area;
    out[0] = 1 - out[1] - out[2];
    return out[0] >= -SLACK && out[1] >= -SLACK && out[2] >= -SLACK;
  }
}

/** Calls visit(vertex) for those in the cells that a triangle may touch. */
function forEachNear(cells, triangle, visit) {
  const first = cells.column(triangle.left), last = cells.column(triangle.right);
  const lastRow = cells.row(triangle.far);
  for (let row = cells.row(triangle.near); row <= lastRow; ++row) {
    const begin = row * cells.columns, end = cells.first[begin + last + 1];
    for (let k = cells.first[begin + first]; k < end; ++k) visit(cells.vertices[k]);
  }
}

/**
 * The heights and normals of the surface of `from` at the vertices of `to`, as {positions, normals}
 * like those of `to`. Where `from` has no triangle, they are those of `to`.
 */
export function surfaceUnder(from, to) {
  const positions = to.positions.slice(), normals = to.normals.slice();
  const cells = new Cells(positions), weights = [0, 0, 0];
  const mixed = (values, k, [a, b, c]) =>
    weights[0] * values[3 * a + k] + weights[1] * values[3 * b + k] +
    weights[2] * values[3 * c + k];
  for (let t = 0; t < from.triangles.length; t += 3) {
    const triangle = new Triangle(from.positions, from.triangles.subarray(t, t + 3));
    if (triangle.area === 0) continue;
    forEachNear(cells, triangle, (i) => {
      if (!triangle.weigh(positions[3 * i], positions[3 * i + 2], weights)) return;
      positions[3 * i + 1] = mixed(from.positions, 1, triangle.corners);
      for (let k = 0; k < 3; ++k) normals[3 * i + k] = mixed(from.normals, k, triangle.corners);
    });
  }
  return {positions, normals};
}
