// SPDX-License-Identifier: Apache-2.0
// Meshes of globes by the JS API: closed and smooth at any prefix, and refused where there is none.
import assert from 'node:assert/strict';
import {before, test} from 'node:test';

import {drapeOf} from '../src/drape.js';
import {encode} from '../src/encode.js';
import {goesRound, open} from '../src/index.js';
import {
  WIDTH, colourAt, earth, earthOnCube, pointOfSample, roughEarth,
} from './earth.js';
import {terrainOf} from './terrain.js';

const TIMEOUT = {timeout: 60000};
let stream, cube;

before(async () => {
  stream = await encode({heights: earth().heights, bytes: 60000});
  cube = await encode({...earthOnCube(), bytes: 60000});
});

/** For each vertex the number of its position. */
function welded({positions}) {
  const numbers = new Map();
  return Array.from({length: positions.length / 3}, (_, v) => {
    const key = positions.subarray(3 * v, 3 * v + 3).join();
    if (!numbers.has(key)) numbers.set(key, numbers.size);
    return numbers.get(key);
  });
}

/** Each edge has two triangles, and the globe is a sphere. */
async function assertClosed(terrain) {
  assert.ok(goesRound(terrain.info));
  for (const bytes of [0, 1000, 4096, 20000, Infinity]) {
    const {globe, mesh} = await terrain.decode({bytes, triangles: 5000, globe: {}});
    assert.equal(mesh, undefined);
    const vertex = welded(globe), edges = new Map(), {triangles} = globe;
    for (let t = 0; t < triangles.length; ++t) {
      const a = vertex[triangles[t]], b = vertex[triangles[t % 3 === 2 ? t - 2 : t + 1]];
      assert.notEqual(a, b);
      assert.ok(!edges.has(`${a} ${b}`), 'triangles at an edge are of one orientation');
      edges.set(`${a} ${b}`);
    }
    for (const edge of edges.keys()) assert.ok(edges.has(edge.split(' ').reverse().join(' ')));
    const euler = new Set(vertex).size - edges.size / 2 + triangles.length / 3;
    assert.equal(euler, 2, `${bytes} bytes`);
  }
}

test('at any prefix a globe is closed, on a cylinder and on a cube', TIMEOUT, async () => {
  for (const input of [stream, cube]) {
    const terrain = await open(input);
    await assertClosed(terrain);
    terrain.dispose();
  }
});

test('vertices lie on the ellipsoid, where their pixels are, as high as asked', TIMEOUT,
  async () => {
    const terrain = await open(stream);
    for (const [semiMajor, semiMinor, exaggeration] of [[1e6, 1e6, 1], [2e6, 2e6, 10]]) {
      const {globe} = await terrain.decode({globe: {semiMajor, semiMinor, exaggeration}});
      globe.heights.forEach((height, v) => {
        const [x, y, z] = globe.positions.subarray(3 * v, 3 * v + 3);
        const radius = semiMajor + height * exaggeration;
        assert.ok(Math.abs(Math.hypot(x, y, z) - radius) < 1e-3);
        const [column, row] = globe.pixels.subarray(2 * v, 2 * v + 2);
        const latitude = Math.PI * (0.5 - row / 540);
        const longitude = 2 * Math.PI * (column / 1080 - 0.5);
        if (row < 0.5 || row > 539.5) return;  // a pole, at the edge of its row
        assert.ok(Math.abs(z - radius * Math.sin(latitude)) < 1e-3);
        assert.ok(Math.abs(y - radius * Math.cos(latitude) * Math.sin(longitude)) < 1e-3);
      });
    }
    terrain.dispose();
  });

test('vertices of a cube lie where their samples do, with their heights', TIMEOUT, async () => {
  const input = earthOnCube(4), terrain = await open(await encode(input));
  assert.equal(terrain.info.domain, 'cube');
  assert.equal(terrain.info.textureDomain, 'cube');
  const sphere = {semiMajor: 1e6, semiMinor: 1e6, exaggeration: 10};
  const {globe, texture} = await terrain.decode({globe: sphere});
  const {width} = input.heights, drape = drapeOf(terrain.info);
  globe.heights.forEach((height, v) => {
    const [column, row] = globe.pixels.subarray(2 * v, 2 * v + 2).map((place) => place - 0.5);
    assert.equal(height, input.heights.data[row * width + column]);
    const point = pointOfSample(column, row, width);
    const [x, y, z] = globe.positions.subarray(3 * v, 3 * v + 3);
    const away = Math.hypot(...[x, y, z].map((part, i) => part - point[i] * (1e6 + 10 * height)));
    assert.ok(away < 0.01, `${row}, ${column}: ${away} m`);
    const [u, w] = drape(column, row), {width: texels, height: rows, data} = texture;
    const texel = [u * texels - 0.5, w * rows - 0.5].map((place) => Number(place.toFixed(9)));
    assert.deepEqual([...data.subarray(4 * (texel[1] * texels + texel[0])).subarray(0, 3)],
      colourAt(point));
  });
  await assert.rejects(encode({heights: {...input.heights, height: 85}}), {code: 'usage'});
  terrain.dispose();
});

test('normals are of length 1, point outwards, and are equal at one position', TIMEOUT,
  async () => {
    const terrain = await open(stream);
    const {globe} = await terrain.decode({globe: {exaggeration: 10}, normals: true});
    const vertex = welded(globe), seen = new Map();
    let shared = 0;
    for (let v = 0; v < vertex.length; ++v) {
      const normal = globe.normals.subarray(3 * v, 3 * v + 3);
      assert.ok(Math.abs(Math.hypot(...normal) - 1) < 1e-6);
      const up = normal.reduce((sum, part, i) => sum + part * globe.positions[3 * v + i], 0);
      assert.ok(up > 0, 'outwards');
      if (seen.has(vertex[v])) ++shared;
      assert.deepEqual(seen.get(vertex[v]) ?? normal, normal);
      seen.set(vertex[v], normal);
    }
    assert.ok(shared > 20, 'there is a seam');
    terrain.dispose();
  });

test('heights that go round no globe say so', TIMEOUT, async () => {
  const terrain = await open(await encode({heights: terrainOf(33).heights}));
  assert.equal(goesRound(terrain.info), false);
  await assert.rejects(terrain.decode({globe: {}}),
    (error) => error.code === 'usage' && /do not go once round a globe/.test(error.message));
  terrain.dispose();
  const {heights} = earth(), {info} = await open(stream);
  for (const change of [{width: 1079}, {crs: ''}, {hasGeotransform: false},
    {geotransform: heights.geotransform.map((v, i) => (i === 3 ? v + 10 : v))}]) {
    assert.equal(goesRound({...info, ...change}), false, JSON.stringify(change));
  }
});

/** From 10 000 km above the equator, at longitude 0 or, `side` -1, at 180. */
function viewFrom(side) {
  const wide = 1 / Math.tan(Math.PI / 8);
  return {
    clip: [0, 0.6 * side * wide, 0, 0, 0, 0, wide, 0, 0, 0, 0, 0, -side, 0, 0, 1e7],
    width: 1000, height: 600,
  };
}

test('of a globe bytes come for the side that a view sees', TIMEOUT, async () => {
  const rough = roughEarth(), {data} = rough.texture;
  const indexed = await encode({...rough, bytes: 800000, regions: 128, index: true});
  const terrain = await open(indexed, {requestBytes: 0});
  /** Root of the mean square of texels about a column, by the equator. */
  const errorAt = ({texture}, column) => {
    let sum = 0;
    for (let i = 0; i < 60 * 140; ++i) {
      const x = (column - 30 + (i % 60) + WIDTH) % WIDTH, y = 200 + Math.floor(i / 60);
      const at = y * WIDTH + x;
      for (let c = 0; c < 3; ++c) sum += (texture.data[4 * at + c] - data[3 * at + c]) ** 2;
    }
    return Math.sqrt(sum / (3 * 60 * 140));
  };
  let before = 0;
  for (const [side, middle, other] of [[-1, 0, WIDTH / 2], [1, WIDTH / 2, 0]]) {
    const bytes = await terrain.load(Infinity, {view: viewFrom(side), globe: {exaggeration: 15}});
    assert.ok(bytes > before + 0.05 * indexed.length, `${before} bytes, then ${bytes}`);
    assert.ok(bytes < 0.5 * indexed.length, `${bytes} of ${indexed.length} bytes`);
    const frame = await terrain.decode({bytes, mesh: false});
    assert.ok(errorAt(frame, middle) < 7, `${errorAt(frame, middle)} where it is seen`);
    if (side < 0) assert.ok(errorAt(frame, other) > 14, `${errorAt(frame, other)} behind`);
    before = bytes;
  }
  terrain.dispose();
});
