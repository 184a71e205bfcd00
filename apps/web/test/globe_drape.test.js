// SPDX-License-Identifier: Apache-2.0
// A texture of longitudes and latitudes over a globe on a cube.
import assert from 'node:assert/strict';
import {before, test} from 'node:test';

import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {draped, liesOnDegrees} from '../viewer/globe_drape.js';
import {colourAt, earth, earthOnCube} from './earth.js';

let terrain;

before(async () => {
  const {heights} = earthOnCube(), {texture} = earth();
  terrain = await open(await encode({heights, texture, bytes: 200000}));
});

const radians = (degrees) => (degrees * Math.PI) / 180;

test('every corner shows the colour of its place, at the poles and at 180 degrees', async () => {
  assert.ok(liesOnDegrees(terrain.info));
  const {globe, texture} = await terrain.decode(
    {triangles: 3000, globe: {}, normals: true, texture: true});
  const {positions, places, triangles, heights, normals} = draped(globe, terrain.info);
  assert.equal(positions.length, normals.length);
  assert.equal(positions.length, 3 * heights.length);
  assert.equal(places.length, 2 * heights.length);
  assert.equal(triangles.length, globe.triangles.length);
  let beyond = 0, error = 0, corners = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const us = [0, 1, 2].map((k) => places[2 * triangles[t + k]]);
    assert.ok(Math.max(...us) - Math.min(...us) < 0.3, `${us}`);
    if (us.some((u) => u < 0 || u > 1)) ++beyond;
    for (let k = 0; k < 3; ++k) {
      const v = triangles[t + k], was = globe.triangles[t + k];
      assert.deepEqual(positions.slice(3 * v, 3 * v + 3),
        globe.positions.slice(3 * was, 3 * was + 3));
      const [u, w] = places.subarray(2 * v, 2 * v + 2);
      const longitude = radians(360 * (u - 0.5)), latitude = radians(180 * (0.5 - w));
      const point = [Math.cos(latitude) * Math.cos(longitude),
        Math.cos(latitude) * Math.sin(longitude), Math.sin(latitude)];
      const [x, y, z] = positions.subarray(3 * v, 3 * v + 3), length = Math.hypot(x, y, z);
      const along = (point[0] * x + point[1] * y + point[2] * z) / length;
      assert.ok(along > Math.cos(radians(0.25)), 'geodetic, not geocentric, and no more off');
      const column = Math.floor(((u % 1) + 1) % 1 * texture.width) % texture.width;
      const row = Math.min(Math.floor(w * texture.height), texture.height - 1);
      const red = texture.data[4 * (row * texture.width + column)];
      error += Math.abs(red - colourAt(point)[0]);
      ++corners;
    }
  }
  assert.ok(beyond > 10 && beyond < triangles.length / 30, `${beyond} triangles go on beyond`);
  assert.ok(error / corners < 4, `${error / corners}`);
});

test('textures of patches and of grids are left alone', () => {
  const {info} = terrain;
  assert.ok(!liesOnDegrees({...info, textureDomain: 'cube'}));
  assert.ok(!liesOnDegrees({...info, domain: 'cylinder'}));
  assert.ok(!liesOnDegrees({...info, hasTexture: false}));
});
