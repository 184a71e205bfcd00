// SPDX-License-Identifier: Apache-2.0
// The grid of heights that frames are drawn with while they play: a geometry of three.js whose
// buffers stay, and of which each frame changes heights and normals alone. Coordinates are those of
// three_frame.js.
import {Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere, Vector3} from 'three';

import {groundAxes, normalsOn, placedOn, trianglesOn, unplacedOn} from './axes.js';
import {drapeOf} from './drape.js';
import {groundScale} from './ground.js';

/** Two triangles of each cell, counter-clockwise seen from above. */
function cellsOf(width, height) {
  const triangles = new Uint32Array(6 * (width - 1) * (height - 1));
  let at = 0;
  for (let y = 0; y < height - 1; ++y) {
    for (let x = 0; x < width - 1; ++x) {
      const first = y * width + x, below = first + width;
      triangles.set([first, below, first + 1, first + 1, below, below + 1], at);
      at += 6;
    }
  }
  return triangles;
}

export class Grid {
  #info;
  #surface;
  #axes;
  #scale;
  #cells;
  #positions;
  #normals;
  #isVoid;

  /** Of the surface of a frame, with normals. */
  constructor({info, surface}) {
    const {width, height} = surface;
    [this.#info, this.#axes, this.#scale] = [info, groundAxes(info), groundScale(info)];
    this.#cells = trianglesOn(this.#axes, cellsOf(width, height));
    this.#isVoid = new Uint8Array(width * height);
    this.geometry = new BufferGeometry();
    const [positions, uvs] = this.#placed(surface);
    const attribute = (name, array, size, changes) => {
      const made = new BufferAttribute(array, size);
      if (changes) made.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute(name, made);
      return made;
    };
    this.#positions = attribute('position', positions, 3, true);
    this.#normals = attribute('normal', new Float32Array(positions.length), 3, true);
    attribute('uv', uvs, 2, false);
    this.geometry.setIndex(new BufferAttribute(this.#cells.slice(), 1));
    this.geometry.boundingBox = new Box3();
    this.geometry.boundingSphere = new Sphere();
    this.#bound(positions);
    this.put(surface);
  }

  /** Whether a frame is drawn on these vertices. */
  fits({info, surface}) {
    const before = this.#surface, {geotransform} = this.#info;
    return surface.width === before.width && surface.height === before.height &&
      surface.level === before.level && info.width === this.#info.width &&
      info.height === this.#info.height && String(info.geotransform) === String(geotransform);
  }

  /** Positions without heights, and places on the texture. Sample (x, y) of a mip level lies on
   * sample (x 2^level, y 2^level). */
  #placed({width, height, level}) {
    const info = this.#info, scale = this.#scale, drape = drapeOf(info);
    const placed = placedOn(this.#axes), side = 2 ** level;
    const count = width * height;
    const positions = new Float32Array(3 * count), uvs = new Float32Array(2 * count);
    for (let i = 0; i < count; ++i) {
      const column = side * (i % width), row = side * Math.floor(i / width);
      const [east, south] = placed(
        (column - (info.width - 1) / 2) * scale.x, (row - (info.height - 1) / 2) * scale.y);
      [positions[3 * i], positions[3 * i + 2]] = [east, south];
      uvs.set(drape(column, row), 2 * i);
    }
    return [positions, uvs];
  }
  #bound(positions) {
    const {min, max} = this.geometry.boundingBox.makeEmpty();
    for (let i = 0; i < positions.length; i += 3) {
      min.x = Math.min(min.x, positions[i]);
      max.x = Math.max(max.x, positions[i]);
      min.z = Math.min(min.z, positions[i + 2]);
      max.z = Math.max(max.z, positions[i + 2]);
    }
  }

  /** Moves the vertices to the heights of another frame. */
  put(surface) {
    this.#surface = surface;
    const {data, normals} = surface, metres = this.#scale.height, {array} = this.#positions;
    const {geometry} = this, {min, max} = geometry.boundingBox;
    const first = data.find((height) => height === height) ?? 0;
    let [least, most, moved] = [first, first, false];
    for (let i = 0; i < data.length; ++i) {
      const height = data[i], isVoid = height === height ? 0 : 1;
      if (isVoid !== this.#isVoid[i]) [this.#isVoid[i], moved] = [isVoid, true];
      array[3 * i + 1] = metres * (isVoid ? first : height);
      if (height < least) least = height;
      if (height > most) most = height;
    }
    [min.y, max.y] = [metres * least, metres * most];
    geometry.boundingBox.getBoundingSphere(geometry.boundingSphere);
    this.#normals.array.set(normalsOn(this.#axes, normals));
    this.#positions.needsUpdate = this.#normals.needsUpdate = true;
    if (moved) this.#leaveOutVoids();
  }
  /** Draws the triangles whose corners are no voids, and no others. */
  #leaveOutVoids() {
    const {index} = this.geometry, {array} = index, isVoid = this.#isVoid, cells = this.#cells;
    let count = 0;
    for (let t = 0; t < cells.length; t += 3) {
      if (isVoid[cells[t]] || isVoid[cells[t + 1]] || isVoid[cells[t + 2]]) continue;
      for (let k = 0; k < 3; ++k) array[count++] = cells[t + k];
    }
    index.needsUpdate = true;
    this.geometry.setDrawRange(0, count);
  }

  /** As that of TksTerrain: on the triangle of the cell. */
  heightAt(x, z) {
    const {width, height, level, data} = this.#surface, info = this.#info, scale = this.#scale;
    const [along, down] = unplacedOn(this.#axes)(x, z), side = 2 ** level;
    const column = (along / scale.x + (info.width - 1) / 2) / side;
    const row = (down / scale.y + (info.height - 1) / 2) / side;
    if (!(column >= 0 && row >= 0 && column <= width - 1 && row <= height - 1)) return NaN;
    const left = Math.min(Math.floor(column), width - 2);
    const above = Math.min(Math.floor(row), height - 2);
    const i = above * width + left, u = column - left, v = row - above;
    const [a, b, c, d] = [data[i], data[i + 1], data[i + width], data[i + width + 1]];
    const mixed = u + v <= 1 ? a + u * (b - a) + v * (c - a)
      : d + (1 - u) * (c - d) + (1 - v) * (b - d);
    return scale.height * mixed;
  }
}
