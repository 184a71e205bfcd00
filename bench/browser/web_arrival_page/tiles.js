// SPDX-License-Identifier: Apache-2.0
// Tiles: quantized-mesh terrain under JPEG pictures, level by level, each level asked for at once.
// All pictures are drawn into one texture, so that terrain tiles need not know theirs.
import {
  BufferAttribute, BufferGeometry, CanvasTexture, Group, Mesh, Plane, Vector3,
} from 'three';

import {gridOf, projectionOf} from '../../../apps/web/src/place.js';
import {material, measure, query} from './scene.js';

const HEADER = 88;
/** Of HTTP/1.1, which browsers open to one host. */
const CONNECTIONS = 6;

/** u, v, h of 0 to 32767 each, and triangles. */
function decodeTile(buffer) {
  const view = new DataView(buffer);
  const low = view.getFloat32(24, true), high = view.getFloat32(28, true);
  const count = view.getUint32(HEADER, true), wide = count > 65536;
  let at = HEADER + 4;
  const [u, v, h] = [0, 1, 2].map(() => {
    let value = 0;
    const values = Array.from({length: count}, (_, i) => {
      const code = view.getUint16(at + 2 * i, true);
      return (value += (code >> 1) ^ -(code & 1));
    });
    at += 2 * count;
    return values;
  });
  if (wide) at = 4 * Math.ceil(at / 4);
  const indices = new Uint32Array(3 * view.getUint32(at, true));
  at += 4;
  let highest = 0;
  for (let i = 0; i < indices.length; ++i) {
    const code = wide ? view.getUint32(at + 4 * i, true) : view.getUint16(at + 2 * i, true);
    indices[i] = highest - code;
    if (code === 0) ++highest;
  }
  return {u, v, heights: h.map((value) => low + ((high - low) * value) / 32767), indices};
}

/** The mesh of a tile in metres around the middle. */
function geometryOf(tile, {z, x, y}, {grid, width, height, spacing}) {
  const side = 180 / 2 ** z, count = tile.u.length;
  const positions = new Float32Array(3 * count), places = new Float32Array(2 * count);
  for (let i = 0; i < count; ++i) {
    const [column, row] = grid.pixels(
      (x + tile.u[i] / 32767) * side - 180, (y + tile.v[i] / 32767) * side - 90)
      .map((pixel) => pixel - 0.5);
    positions.set([(column - (width - 1) / 2) * spacing[0], tile.heights[i],
      (row - (height - 1) / 2) * spacing[1]], 3 * i);
    places.set([column / (width - 1), row / (height - 1)], 2 * i);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('uv', new BufferAttribute(places, 2));
  geometry.setIndex(new BufferAttribute(tile.indices, 1));
  return geometry;
}

measure(async function* () {
  const set = await (await fetch(query.data)).json();
  const ground = {...set, grid: gridOf(set.transform, projectionOf(set.crs))};
  let bytes = 0, rounds = 1;
  const get = async (path) => {
    const answer = await fetch(path);
    bytes += Number(answer.headers.get('content-length'));  // as they are on the wire
    return answer.arrayBuffer();
  };
  const [columns, rows] = set.texture;
  const drawn = new OffscreenCanvas(columns, rows), context = drawn.getContext('2d');
  // Tiles reach beyond the ground.
  const sides = [(set.width - 1) * set.spacing[0] / 2, (set.height - 1) * set.spacing[1] / 2];
  const border = [[1, 0], [-1, 0], [0, 1], [0, -1]].map(([x, z]) =>
    new Plane(new Vector3(x, 0, z), sides[x === 0 ? 1 : 0]));
  const steps = Math.max(set.terrain.length, set.pictures.length);
  for (let step = 0; step < steps; ++step) {
    // Both end with their finest level.
    const terrain = set.terrain[Math.max(0, step - steps + set.terrain.length)];
    const pictures = set.pictures[Math.max(0, step - steps + set.pictures.length)];
    const [meshes] = await Promise.all([
      Promise.all(terrain.map(async (tile) =>
        geometryOf(decodeTile(await get(tile.path)), tile, ground))),
      Promise.all(pictures.map(async ({path, x, y, width, height}) => {
        const image = await createImageBitmap(new Blob([await get(path)]));
        context.drawImage(image, x, y, width, height);
      })),
    ]);
    const copy = new OffscreenCanvas(columns, rows);
    copy.getContext('2d').drawImage(drawn, 0, 0);
    const texture = new CanvasTexture(copy);
    texture.flipY = false;
    const skin = Object.assign(material(texture), {clippingPlanes: border}), group = new Group();
    group.add(...meshes.map((mesh) => new Mesh(mesh, skin)));
    rounds += Math.ceil((terrain.length + pictures.length) / CONNECTIONS);
    yield {bytes, rounds, show: () => group};
  }
});
