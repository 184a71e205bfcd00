// SPDX-License-Identifier: Apache-2.0
// The adapter of MapLibre without a map: places on Earth against GDAL's numbers, and tiles against
// the surface they are cut out of.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';

import {TksProtocol} from '../src/maplibre.js';
import {boundsOf, gridOf, projectionOf} from '../src/place.js';

const vectors = new URL('../../conformance/vectors/', import.meta.url);

test('projections are those of GDAL', () => {
  // By gdaltransform of GDAL 3.6.
  for (const [crs, longitude, latitude, x, y] of [
    ['EPSG:32611', -118.3, 34.3, 380367.7233, 3796185.0838],
    ['EPSG:32733+5773', 18.42, -33.92, 816196.7118, 6241444.3144],
    ['EPSG:3857', 7.5, 46.2, 834896.1809, 5812457.4913],
    ['EPSG:4326', 7.5, 46.2, 7.5, 46.2],
  ]) {
    const {forward, inverse} = projectionOf(crs);
    const [gotX, gotY] = forward(longitude, latitude);
    assert.ok(Math.hypot(gotX - x, gotY - y) < 2e-3, `${crs}: ${gotX} ${gotY}`);
    const [east, north] = inverse(gotX, gotY);
    assert.ok(Math.hypot(east - longitude, north - latitude) < 1e-8, `${crs}: ${east} ${north}`);
  }
  assert.throws(() => projectionOf('EPSG:2056'), /does not know the CRS "EPSG:2056".*bounds/);
});

test('bounds of a raster turned in its zone contain its corners', () => {
  const {pixels, degrees} =
    gridOf([380000, 20, 5, 3800000, 5, -20], projectionOf('EPSG:32611'));
  const [west, south, east, north] = boundsOf(degrees, 500, 400);
  const distance = (place, corner) => {
    const [x, y] = pixels(...place);
    return Math.hypot(x - corner[0], y - corner[1]);
  };
  assert.ok(west < east && south < north && east - west < 0.2 && west < -118 && west > -118.6);
  assert.ok(distance([(west + east) / 2, (south + north) / 2], [250, 200]) < 60);
});

test('tiles hold the heights of the surface and its colours', async () => {
  const protocol = new TksProtocol();
  const input = await readFile(new URL('regions_joint_index_40x33_50x47.tks', vectors));
  const bounds = [8, 46, 8.1, 46.07];
  const source = await protocol.add('alps', input, {bounds});
  assert.equal(source.heights.type, 'raster-dem');
  assert.equal(source.heights.encoding, 'terrarium');
  for (let i = 0; i < 4; ++i) assert.ok(Math.abs(source.heights.bounds[i] - bounds[i]) < 1e-6);
  const {surface} = await source.terrain.decode({bytes: 4096, surface: true});

  const z = source.heights.maxzoom, tiles = 2 ** z;
  const x = Math.floor(((8.05 + 180) / 360) * tiles);
  const mercator = (latitude) => Math.asinh(Math.tan((latitude * Math.PI) / 180));
  const y = Math.floor(((1 - mercator(46.035) / Math.PI) / 2) * tiles);
  const rgba = await source.render('heights', {z, x, y});
  let checked = 0;
  for (let i = 0; i < 256 * 256; i += 7) {
    const longitude = ((x + ((i % 256) + 0.5) / 256) / tiles) * 360 - 180;
    const up = Math.PI * (1 - (2 * (y + (Math.floor(i / 256) + 0.5) / 256)) / tiles);
    const latitude = (Math.atan(Math.sinh(up)) * 180) / Math.PI;
    const column = ((longitude - 8) / 0.1) * 40 - 0.5, row = ((46.07 - latitude) / 0.07) * 33 - 0.5;
    if (column < 0 || row < 0 || column > 38 || row > 31) continue;
    const [r, g, b] = rgba.subarray(4 * i);
    const got = r * 256 + g + b / 256 - 32768;
    const at = (dx, dy) => surface.data[(Math.floor(row) + dy) * 40 + Math.floor(column) + dx];
    const u = column % 1, v = row % 1;
    const wanted = (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
    assert.ok(Math.abs(got - wanted) < 0.01, `${got} is not ${wanted}`);
    ++checked;
  }
  assert.ok(checked > 100);
  const colours = await source.render('texture', {z, x, y});
  assert.ok(new Set(new Uint32Array(colours.buffer)).size > 100);
  assert.equal(await source.render('heights', {z, x: x + 100, y}), null);
  await assert.rejects(protocol.add('alps', input, {bounds}), /taken/);
  protocol.remove('alps');
  await assert.rejects(protocol.add('nowhere', input), /does not say where it lies/);
});

test('a stream that says where it lies needs no bounds', async () => {
  const input = await readFile(new URL('placed_joint_20x15_40x31.tks', vectors));
  const source = await new TksProtocol().add('placed', input);
  const [west, south, east, north] = source.heights.bounds;
  assert.ok(west < east && south < north, String(source.heights.bounds));
  // UTM zone 32 and the texture's own place, which is near.
  for (let i = 0; i < 4; ++i) {
    assert.ok(Math.abs(source.heights.bounds[i] - source.texture.bounds[i]) < 0.1);
  }
  const z = source.heights.maxzoom, tiles = 2 ** z;
  const x = Math.floor((((west + east) / 2 + 180) / 360) * tiles);
  const up = Math.asinh(Math.tan((((south + north) / 2) * Math.PI) / 180));
  const y = Math.floor(((1 - up / Math.PI) / 2) * tiles);
  assert.ok(await source.render('heights', {z, x, y}));
});
