// SPDX-License-Identifier: Apache-2.0
// Streams in national grids: placed by the positions that they take along, or by the page.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';

import {open} from '../src/index.js';
import {placeOf, projectionOf} from '../src/place.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);
const RADIANS = Math.PI / 180;

/** What info says of heights of this size with a place. */
const infoOf = (crs, geotransform, width, height) => ({
  hasHeights: true, hasGeotransform: true, geotransform, crs, width, height, positions: null,
  textureHasGeotransform: false, texturePositions: null,
});

/** A spherical polar stereographic map of the south, as polar CRSs are. */
const SOUTH = {
  project(x, y) {
    const away = 2 * Math.atan(Math.hypot(x, y) / (2 * 6371000));
    return [Math.atan2(x, y) / RADIANS, away / RADIANS - 90];
  },
};

test('positions of a stream are those of PROJ', async () => {
  const terrain = await open(await readFile(new URL('positions_33x17.tks', vectors)));
  const {info} = terrain;
  assert.equal(info.crs, 'EPSG:2056');
  const {degrees, pixels, bounds} = placeOf(info, 'heights');
  // By PROJ's cs2cs EPSG:2056 EPSG:4326, of samples of 1 km from 2 600 000, 1 200 000 on.
  const places = [
    [0, 0, 7.4386324, 46.9510828], [33, 0, 7.87212, 46.9502658], [0, 17, 7.4386351, 46.798163],
    [33, 17, 7.8708916, 46.7973483], [16.5, 8.5, 7.655071, 46.8744203],
    [20.5, 3.25, 7.7077758, 46.9215341],
  ];
  for (const [column, row, longitude, latitude] of places) {
    const [east, north] = degrees(column, row);
    assert.ok(Math.hypot(pixels(longitude, latitude)[0] - column,
      pixels(longitude, latitude)[1] - row) < 0.1, `${pixels(longitude, latitude)}`);
    assert.ok(Math.abs(east - longitude) < 0.0014 && Math.abs(north - latitude) < 0.001);
  }
  assert.ok(bounds[0] > 7 && bounds[2] < 8 && bounds[1] > 46 && bounds[3] < 47.1);
  terrain.dispose();
});

test('project places what no one else knows, as the formulas do', () => {
  const {inverse} = projectionOf('EPSG:32632');
  const transform = [380000, 20, 5, 5200000, 5, -20];
  const known = placeOf(infoOf('EPSG:32632', transform, 500, 400), 'heights');
  const asked = [];
  const project = (x, y, crs) => (asked.push(crs), inverse(x, y));
  const given = placeOf(infoOf('my grid', transform, 500, 400), 'heights', {project});
  assert.deepEqual(given.bounds.map((v) => v.toFixed(6)), known.bounds.map((v) => v.toFixed(6)));
  for (const [column, row] of [[0, 0], [500, 400], [250.5, 10], [3, 399], [600, -50]]) {
    const [longitude, latitude] = given.degrees(column, row);
    const [x, y] = known.degrees(column, row), back = given.pixels(x, y);
    assert.ok(Math.hypot(longitude - x, latitude - y) < 1e-9);
    assert.ok(Math.hypot(back[0] - column, back[1] - row) < 1e-3, `${back}`);
  }
  assert.ok(asked.every((crs) => crs === 'my grid'));
});

test('places far from a raster are outside of it', () => {
  const {inverse: project} = projectionOf('EPSG:32632');
  const info = infoOf('my grid', [500000, 20, 0, 5200000, 0, -20], 500, 400);
  const {pixels} = placeOf(info, 'heights', {project});
  const isInside = ([x, y]) => x >= 0 && y >= 0 && x <= 500 && y <= 400;
  for (let longitude = -180; longitude <= 180; longitude += 7.3) {
    for (let latitude = -90; latitude <= 90; latitude += 4.9) {
      const at = pixels(longitude, latitude);
      assert.ok(at.every((value) => !Number.isNaN(value)), `${longitude} ${latitude}: ${at}`);
      assert.ok(!isInside(at), `${longitude} ${latitude}: ${at}`);
    }
  }
  assert.ok(isInside(pixels(9.05, 46.93)));
});

test('a raster around a pole has all longitudes', () => {
  const info = infoOf('pole', [-1000000, 10000, 0, 1000000, 0, -10000], 200, 200);
  const {bounds, pixels, degrees} = placeOf(info, 'heights', SOUTH);
  assert.deepEqual([bounds[0], bounds[1], bounds[2]], [-180, -90, 180]);
  for (const longitude of [-179.9, -90, 0, 45, 179.9]) {
    const [column, row] = pixels(longitude, -85), [, latitude] = degrees(column, row);
    assert.ok(column > 0 && column < 200 && row > 0 && row < 200);
    assert.ok(Math.abs(latitude + 85) < 1e-6);
  }
  const beside = infoOf('pole', [500000, 10000, 0, 1000000, 0, -10000], 100, 100);
  assert.ok(placeOf(beside, 'heights', SOUTH).bounds[1] > -86);
});

test('longitudes go on behind 180 degrees', () => {
  const project = (x, y) => [((x + 540) % 360) - 180, y];
  const {bounds, degrees} = placeOf(infoOf('degrees', [178, 0.01, 0, 1, 0, -0.01], 400, 200),
    'heights', {project});
  assert.ok(Math.abs(bounds[0] - 178) < 1e-6 && Math.abs(bounds[2] - 182) < 1e-6, `${bounds}`);
  assert.ok(Math.abs(degrees(400, 0)[0] - 182) < 1e-6);
});

test('who knows no place says what to give', () => {
  const info = infoOf('EPSG:2056', [2600000, 1, 0, 1200000, 0, -1], 9, 9);
  assert.throws(() => placeOf(info, 'heights'),
    {code: 'unsupported', message: /EPSG:2056.*`project`.*`bounds`/});
});
