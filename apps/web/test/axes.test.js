// SPDX-License-Identifier: Apache-2.0
// Rasters that do not begin in the north-west lie on the ground as the others do.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {PerspectiveCamera, Vector3} from 'three';

import {meshOf} from '../src/deck.js';
import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {TksTerrain} from '../src/three.js';

const WIDTH = 24, HEIGHT = 17, STEP = 30;
/** North-up. Both sides are unlike each other, in both directions. */
const northUp = Int16Array.from({length: WIDTH * HEIGHT}, (_, i) => {
  const column = i % WIDTH, row = Math.floor(i / WIDTH);
  return 9 * column + row * row + 40 * Math.sin(column / 3) * Math.cos(row / 4);
});
const colours = Uint8Array.from({length: 3 * WIDTH * HEIGHT}, (_, i) => northUp[i / 3 | 0] >> 1);

/** The same ground, its rows or its columns in the other order. */
function turned(rowsBack, columnsBack, inDegrees) {
  const step = inDegrees ? 2.5e-4 : STEP, [west, north] = inDegrees ? [8, 46] : [5e5, 4e6];
  const from = (i) => {
    const column = i % WIDTH, row = Math.floor(i / WIDTH);
    return (rowsBack ? HEIGHT - 1 - row : row) * WIDTH +
      (columnsBack ? WIDTH - 1 - column : column);
  };
  const geotransform = [
    columnsBack ? west + WIDTH * step : west, columnsBack ? -step : step, 0,
    rowsBack ? north - HEIGHT * step : north, 0, rowsBack ? step : -step,
  ];
  return encode({
    heights: {width: WIDTH, height: HEIGHT, data: northUp.map((_, i) => northUp[from(i)]),
      crs: inDegrees ? 'EPSG:4326' : 'EPSG:32611', geotransform},
    texture: {width: WIDTH, height: HEIGHT,
      data: colours.map((_, i) => colours[3 * from(Math.floor(i / 3)) + i % 3])},
    index: true,
  });
}

const cases = [];
for (const inDegrees of [false, true]) {
  for (const [rows, columns] of [[false, false], [true, false], [false, true], [true, true]]) {
    cases.push([rows, columns, inDegrees]);
  }
}

/** Vertices by their place on the ground: height, normal, and place on the picture. */
function verticesOf({position, normal, uv}, [rowsBack, columnsBack], round) {
  const vertices = new Map();
  for (let i = 0; i < position.length / 3; ++i) {
    const [x, y, z] = position.subarray(3 * i, 3 * i + 3), [u, v] = uv.subarray(2 * i, 2 * i + 2);
    vertices.set(round(x, y, z), [x, y, z, ...normal.subarray(3 * i, 3 * i + 3),
      columnsBack ? 1 - u : u, rowsBack ? 1 - v : v]);
  }
  return vertices;
}
function assertAlike(found, expected) {
  assert.equal(found.size, expected.size);
  for (const [place, numbers] of expected) {
    assert.ok(found.has(place), place);
    found.get(place).forEach((number, k) =>
      assert.ok(Math.abs(number - numbers[k]) < 2e-4, `${place}: ${found.get(place)}; ${numbers}`));
  }
}

/** The least upward part of the normals of triangles, and of their products with the vertices'. */
function leastUp({position, normal, triangles}, up) {
  const corner = (i) => new Vector3().fromArray(position, 3 * i);
  let least = Infinity;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = Array.from(triangles.subarray(i, i + 3), corner);
    const across = new Vector3().crossVectors(b.sub(a), c.sub(a)).normalize();
    least = Math.min(least, across.getComponent(up),
      across.dot(new Vector3().fromArray(normal, 3 * triangles[i])));
  }
  return least;
}

async function objectOf(stream) {
  const object = new TksTerrain(await open(stream));
  object.show(await object.terrain.decode({triangles: 1e4, normals: true}));
  return object;
}
const arraysOf = ({attributes: {position, normal, uv}, index}) =>
  ({position: position.array, normal: normal.array, uv: uv.array, triangles: index.array});

test('a terrain of three.js has x in the east and z in the south', async () => {
  const round = (x, y, z) => `${Math.round(x)} ${Math.round(z)}`;
  for (const inDegrees of [false, true]) {
    const straight = await objectOf(await turned(false, false, inDegrees));
    const expected = verticesOf(arraysOf(straight.geometry), [], round);
    assert.equal(expected.size, WIDTH * HEIGHT);
    for (const [rows, columns] of [[true, false], [false, true], [true, true]]) {
      const object = await objectOf(await turned(rows, columns, inDegrees));
      const arrays = arraysOf(object.geometry);
      assertAlike(verticesOf(arrays, [rows, columns], round), expected);
      assert.ok(leastUp(arrays, 1) > 0.3, `${leastUp(arrays, 1)}`);
      object.dispose();
    }
    straight.dispose();
  }
});

test('a raster that is turned and sheared lies as its geotransform says', async () => {
  const geotransform = [5e5, 20, 8, 4e6, 12, -25];
  const object = await objectOf(await encode({heights: {width: WIDTH, height: HEIGHT,
    data: northUp, crs: 'EPSG:32611', geotransform}}));
  const {position, normal, triangles} = arraysOf(object.geometry);
  object.frame.mesh.gridIndex.forEach((index, i) => {
    const column = index % WIDTH - (WIDTH - 1) / 2;
    const row = Math.floor(index / WIDTH) - (HEIGHT - 1) / 2;
    assert.ok(Math.abs(position[3 * i] - (20 * column + 8 * row)) < 1e-3);
    assert.ok(Math.abs(position[3 * i + 2] + 12 * column - 25 * row) < 1e-3);
  });
  assert.ok(leastUp({position, normal, triangles}, 1) > 0.3);
  object.dispose();
});

test('what a camera sees is asked for where it lies in the raster', async () => {
  const camera = new PerspectiveCamera(40, 1.6, 1, 1e5);
  camera.position.set(120, 700, 300);
  camera.lookAt(-200, 0, 100);
  camera.updateMatrixWorld();
  for (const turns of cases) {
    const object = await objectOf(await turned(...turns)), {mesh} = object.frame;
    const {clip} = object.viewOf(camera, 400), {position} = arraysOf(object.geometry);
    for (let i = 0; i < mesh.gridIndex.length; i += 11) {
      const place = [mesh.gridIndex[i] % WIDTH, Math.floor(mesh.gridIndex[i] / WIDTH),
        mesh.heights[i], 1];
      const row = (k) => place.reduce((sum, value, j) => sum + clip[4 * k + j] * value, 0);
      const seen = new Vector3().fromArray(position, 3 * i).project(camera);
      assert.ok(Math.hypot(row(0) / row(3) - seen.x, row(1) / row(3) - seen.y) < 1e-4, `${turns}`);
    }
    object.dispose();
  }
});

test('meshes for deck.gl face up, and their normals too', async () => {
  const round = (x, y) => `${Math.round(x * 1e6)} ${Math.round(y * 1e6)}`;
  const origin = [8, 46];
  const meshFor = async (turns, bounds) => {
    const terrain = await open(await turned(...turns, true));
    const frame = await terrain.decode({triangles: 1e4, normals: true});
    const {attributes: {POSITION, NORMAL, TEXCOORD_0}, indices} = meshOf(frame, {origin, bounds});
    terrain.dispose();
    const position = POSITION.value.map((v, i) => (i % 3 === 2 ? v : v * 1e5));
    return {position: POSITION.value, normal: NORMAL.value, uv: TEXCOORD_0.value,
      up: leastUp({position, normal: NORMAL.value, triangles: indices.value}, 2)};
  };
  for (const bounds of [undefined, [8, 45.5, 9, 46]]) {
    const straight = await meshFor([false, false], bounds);
    for (const turns of [[true, false], [false, true], [true, true]]) {
      const mesh = await meshFor(turns, bounds);
      assertAlike(verticesOf(mesh, turns, round), verticesOf(straight, [], round));
      assert.ok(Math.abs(mesh.up - straight.up) < 0.2 && mesh.up > 0, `${mesh.up}`);
    }
  }
});
