// SPDX-License-Identifier: Apache-2.0
// Heights of a mesh anywhere on the ground: its triangles are sorted into square cells of about one
// each, so that a place asks few of them.
import {Triangle} from './glide.js';

/** Cells that more triangles meet than this times their number would take too much memory. */
const MOST_CELLS_PER_TRIANGLE = 2;

export class HeightLookup {
  #positions;
  #triangles;
  #columns;
  #rows;
  #size;
  #x;
  #z;
  #first;
  #members;

  /** x, y, z of each vertex, y up, and triples of vertices. */
  constructor(positions, triangles) {
    this.#positions = positions;
    this.#triangles = triangles;
    const least = [Infinity, Infinity], most = [-Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += 3) {
      for (const [k, value] of [positions[i], positions[i + 2]].entries()) {
        least[k] = Math.min(least[k], value);
        most[k] = Math.max(most[k], value);
      }
    }
    [this.#x, this.#z] = least;
    const [width, depth] = [most[0] - least[0], most[1] - least[1]];
    const count = Math.max(1, (MOST_CELLS_PER_TRIANGLE * triangles.length) / 3);
    this.#size = Math.max(Math.sqrt((width * depth) / count), (width + depth) / count) || 1;
    this.#columns = Math.floor(width / this.#size) + 1 || 1;
    this.#rows = Math.floor(depth / this.#size) + 1 || 1;
    this.#sort();
  }
  #column(x) {
    return Math.min(this.#columns - 1, Math.max(0, Math.floor((x - this.#x) / this.#size)));
  }
  #row(z) {
    return Math.min(this.#rows - 1, Math.max(0, Math.floor((z - this.#z) / this.#size)));
  }
  /** Calls visit(cell) for those that the box of a triangle meets. */
  #eachCell(t, visit) {
    const p = this.#positions, [a, b, c] = this.#triangles.subarray(t, t + 3);
    const xs = [p[3 * a], p[3 * b], p[3 * c]], zs = [p[3 * a + 2], p[3 * b + 2], p[3 * c + 2]];
    const last = this.#column(Math.max(...xs)), lastRow = this.#row(Math.max(...zs));
    const first = this.#column(Math.min(...xs));
    for (let row = this.#row(Math.min(...zs)); row <= lastRow; ++row) {
      for (let column = first; column <= last; ++column) visit(row * this.#columns + column);
    }
  }
  /** `members` of cell c are those from first[c] to first[c + 1]. */
  #sort() {
    const {length} = this.#triangles, first = new Uint32Array(this.#columns * this.#rows + 1);
    for (let t = 0; t < length; t += 3) this.#eachCell(t, (cell) => ++first[cell + 1]);
    for (let c = 1; c < first.length; ++c) first[c] += first[c - 1];
    const next = first.slice();
    this.#members = new Uint32Array(first.at(-1));
    for (let t = 0; t < length; t += 3) {
      this.#eachCell(t, (cell) => (this.#members[next[cell]++] = t));
    }
    this.#first = first;
  }

  /** NaN where there is no triangle. */
  at(x, z) {
    const p = this.#positions, weights = [0, 0, 0];
    if (!(Number.isFinite(x) && Number.isFinite(z))) return NaN;
    const cell = this.#row(z) * this.#columns + this.#column(x);
    for (let k = this.#first[cell]; k < this.#first[cell + 1]; ++k) {
      const t = this.#members[k], corners = this.#triangles.subarray(t, t + 3);
      const triangle = new Triangle(p, corners);
      if (triangle.area === 0 || !triangle.weigh(x, z, weights)) continue;
      return corners.reduce((sum, corner, i) => sum + weights[i] * p[3 * corner + 1], 0);
    }
    return NaN;
  }
}
