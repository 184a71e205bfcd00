// SPDX-License-Identifier: Apache-2.0
// The adapter of Cesium without a screen: which tiles there are, and what heights they hold.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {TksTerrainProvider} from '../src/cesium.js';
import {encode} from '../src/encode.js';

/** 72 x 36 heights of 5 m a column from `west` on, around the equator. */
const inDegrees = (west, columns) => encode({
  heights: {data: Int16Array.from({length: 72 * 36}, (_, i) => 5 * (i % 72)), width: 72, height: 36,
    crs: 'EPSG:4326', geotransform: [west, columns, 0, 9, 0, -0.5]},
});

test('a place that goes across 180° has tiles and heights on both sides', async () => {
  for (const [west, columns, level, here, away] of [[0, 5, 0, [-100, -20, 40, 170], []],
    [170, 20 / 72, 4, [172, 178, -179, -171], [-100, 100]]]) {
    const provider = await TksTerrainProvider.fromUrl(await inDegrees(west, columns));
    const side = 180 / 2 ** level, row = Math.max(0, 90 / side - 1);  // north of the equator
    const tileOf = (longitude) => [Math.floor((longitude + 180) / side), row, level];
    for (const longitude of away) {
      assert.equal(provider.getTileDataAvailable(...tileOf(longitude)), false, `${longitude}`);
    }
    for (const longitude of here) {
      const tile = tileOf(longitude);
      assert.equal(provider.getTileDataAvailable(...tile), true, `${longitude}`);
      const data = await provider.requestTileGeometry(...tile);
      const rectangle = provider.tilingScheme.tileXYToRectangle(...tile);
      const east = Math.round((longitude - tile[0] * side + 180) / side * 64) / 64;
      const at = rectangle.west + east * (rectangle.east - rectangle.west);
      const got = data.interpolateHeight(rectangle, at, 0.05);
      const column = (((at * 180) / Math.PI - west + 720) % 360) / columns;
      assert.ok(Math.abs(got - 5 * (column - 0.5)) < 0.1, `${longitude}: ${got}, ${column}`);
    }
    provider.dispose();
  }
});
