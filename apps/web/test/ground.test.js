// SPDX-License-Identifier: Apache-2.0
// Metres on the ground, of streams that state a place alone.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';

import {encode} from '../src/encode.js';
import {groundScale, open} from '../src/index.js';
import {terrainOf} from './terrain.js';

async function scaleOf(change) {
  const {heights} = terrainOf(33);
  const terrain = await open(await encode({heights: {...heights, spacing: 0, ...change}}));
  const scale = groundScale(terrain.info);
  terrain.dispose();
  return scale;
}

const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-3 * b, `${a} beside ${b}`);

test('what is stated counts, whatever the place says', async () => {
  const {x, y} = await scaleOf({spacing: [30, 20]});
  assert.deepEqual([x, y], [30, 20]);
});

test('a place in metres tells the spacing, turned or not', async () => {
  const place = {crs: 'EPSG:2056', geotransform: [2600000, 25, 0, 1200000, 0, -20]};
  const straight = await scaleOf(place);
  assert.deepEqual([straight.x, straight.y], [25, 20]);
  const turned = await scaleOf({...place, geotransform: [2600000, 3, 8, 1200000, 4, -6]});
  assert.deepEqual([turned.x, turned.y], [5, 10]);
});

test('degrees are as long as in the middle of the ground', async () => {
  const geotransform = [7, 0.001, 0, 60.0165, 0, -0.001];  // the middle lies at 60 degrees north
  const wkt = 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],' +
    'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]';
  // 6318 is NAD83 (2011), as of the United States' elevation programme.
  for (const crs of ['EPSG:4326', 'EPSG:4326+5773', 'EPSG:6318', wkt]) {
    const {x, y} = await scaleOf({crs, geotransform});
    near(x, 55.8), near(y, 111.412);
  }
});

test('metres of web Mercator are as long as on the ground, whatever it is called', async () => {
  // The middle lies at 60 degrees north, where they are half as long.
  const geotransform = [7e5, 40, 0, 8399737.89 + 330, 0, -20];
  const wkt = 'PROJCS["WGS 84 / Pseudo-Mercator",GEOGCS["WGS 84"],' +
    'PROJECTION["Mercator_1SP"],UNIT["metre",1]]';
  for (const crs of ['EPSG:3857', 'EPSG:900913', 'EPSG:3785', 'EPSG:102100', 'ESRI:102113', wkt]) {
    const {x, y} = await scaleOf({crs, geotransform});
    near(x, 20), near(y, 10);
  }
  const {x} = await scaleOf({crs: 'EPSG:3857', geotransform, spacing: 40});
  assert.equal(x, 40);
});

test('metres whose code looks like degrees are metres', async () => {
  const geotransform = [500000, 25, 0, 4400000, 0, -25];
  for (const crs of ['EPSG:4547', 'PROJCS["CGCS2000 / 3-degree Gauss-Kruger CM 114E"]']) {
    const {x, y} = await scaleOf({crs, geotransform});
    assert.deepEqual([x, y], [25, 25]);
  }
});

test('the unit of a grid is that of its keys, or of its WKT', async () => {
  // So near to the origin that numbers alone look like degrees.
  const geotransform = [0, 10, 0, 80, 0, -5], foot = 1200 / 3937;
  const projected = 'PROJCS["a",GEOGCS["b",UNIT["degree",0.0174532925199433]],UNIT["foot",0.3048]]';
  for (const [crs, geoKeys, metres] of [
    ['site grid', '1026="site grid" 3076=9001', 1],
    ['site grid', '1024=32767 1026="site grid" 3076=9002', 0.3048],
    ['site grid', '1026="site ""3076=9001" 3076=9003', foot],
    ['site grid', '1026="site grid" 3076=32767 3077=20.1168', 20.1168],
    ['LOCAL_CS["site grid",UNIT["metre",1]]', undefined, 1],
    [`LOCAL_CS["site grid",UNIT["US survey foot",${foot}]]`, undefined, foot],
    ['ENGCRS["site grid",EDATUM[""],CS[Cartesian,2],AXIS["(E)",east,LENGTHUNIT["foot",0.3048]]]',
      undefined, 0.3048],
    [projected, undefined, 0.3048],
    [`COMPD_CS["c",${projected},VERT_CS["d",UNIT["metre",1]]]`, undefined, 0.3048],
  ]) {
    const {x, y} = await scaleOf({crs, geoKeys, geotransform});
    assert.deepEqual([x, y], [10 * metres, 5 * metres], geoKeys ?? crs);
  }
});

test('without a CRS, an area or a latitude, nothing is known: 30 m, as for cameras', async () => {
  for (const place of [
    {crs: '', geotransform: [0, 25, 0, 0, 0, -25]}, {crs: 'EPSG:2056', geotransform: undefined},
    {crs: 'EPSG:2056', geotransform: [0, 0, 0, 0, 0, 0]},
    {crs: 'EPSG:4326', geotransform: [0, 1e-3, 0, 91, 0, -1e-3]},
  ]) {
    const {x, y} = await scaleOf(place);
    assert.deepEqual([x, y], [30, 30]);
  }
});

test('a unit of heights is as long as for the command line, by any of its names', () => {
  const names = new URL('../../../tests/tools/length_names.txt', import.meta.url);
  const table = readFileSync(names, 'utf8');
  const lines = table.trim().split('\n').filter((line) => !line.startsWith('#'));
  assert.ok(lines.length > 25);
  for (const line of lines) {
    const [metres] = line.split(' '), unit = line.slice(metres.length + 1);
    const {height} = groundScale({unit, spacingX: 30, spacingY: 30});
    assert.equal(height, metres === 'none' ? 1 : Number(metres), unit);
  }
});
