// SPDX-License-Identifier: Apache-2.0
// Tiles of grids that go round the Earth: those on both sides of the date line, or of wherever the
// grid begins, have the same heights on their common edge, and no step beside it.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {TksTerrainProvider} from '../src/cesium.js';
import {Cutter} from '../src/cut.js';
import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {TksProtocol} from '../src/maplibre.js';

const WIDTH = 360, HEIGHT = 180, TIMEOUT = {timeout: 60000};

/** At so many degrees east, and rows from the north. */
function waveAt(east, row) {
  const turn = (east * Math.PI) / 180;
  return 1000 * Math.sin(turn + 0.7) + 300 * Math.cos(3 * turn) + row;
}

/** Waves of a given height, in metres, that go on behind the last column. */
function around(west, domain, crs = 'EPSG:4326') {
  const data = new Float32Array(WIDTH * HEIGHT), texels = new Uint8Array(3 * WIDTH * HEIGHT);
  for (let i = 0; i < data.length; ++i) {
    const east = (360 * ((i % WIDTH) + 0.5)) / WIDTH + west, turn = (east * Math.PI) / 180;
    data[i] = waveAt(east, Math.floor(i / WIDTH));
    texels.fill(128 + 100 * Math.sin(turn + 0.7), 3 * i, 3 * i + 3);
  }
  // Files often round the width of a column.
  const geotransform = [west, 0.9999999999, 0, 90, 0, -1];
  const place = {width: WIDTH, height: HEIGHT, crs, geotransform, domain};
  return encode({heights: {...place, data, unit: 'm'}, texture: {...place, data: texels},
    lossless: true});
}
const STREAMS = [[-180, 'cylinder'], [-180, 'plane'], [0, 'cylinder'], [0, 'plane']];
/** Of neighbours a tenth of a degree apart. */
const STEEPEST = 8;

test('places on both sides, and those that cross it, join', TIMEOUT, async () => {
  for (const [west, domain] of STREAMS) {
    const terrain = await open(await around(west, domain)), cutter = new Cutter(terrain, {});
    for (const [first, step, count] of [[178, 0.1, 41], [-2, 0.1, 41], [-182, 0.1, 41],
      [170, 0.5, 41], [100, 4, 60]]) {
      const longitudes = Array.from({length: count}, (_, i) => first + i * step);
      const heights = await cutter.heights(longitudes, [10, 0]);
      const again = await cutter.heights(longitudes.map((l) => l - 360), [10, 0]);
      const texels = await cutter.texels(longitudes, [10, 0]);
      heights.forEach((height, i) => {
        assert.ok(Math.abs(height - again[i]) < 0.01, `${longitudes[i % count]}: ${height}`);
        assert.equal(texels[4 * i + 3], 255);
        if (i % count === 0) return;
        const rise = Math.abs(height - heights[i - 1]);
        assert.ok(rise < STEEPEST * 10 * step,
          `${west} ${domain}, ${longitudes[i % count]}: ${rise}`);
        assert.ok(Math.abs(texels[4 * i] - texels[4 * i - 4]) < 2 + 4 * step);
      });
    }
    terrain.dispose();
  }
});

test('tiles of Cesium have the same heights on their common edge, at all levels', TIMEOUT,
  async () => {
    for (const [west, domain] of STREAMS) {
      const provider = await TksTerrainProvider.fromUrl(await around(west, domain));
      for (let level = 0; level < 3; ++level) {
        const tiles = 2 ** level;
        for (const y of [0, tiles >> 1, tiles - 1]) {
          const edges = await Promise.all([[2 * tiles - 1, 64], [0, 0], [tiles - 1, 64],
            [tiles, 0]].map(async ([x, column]) => {
            assert.ok(provider.getTileDataAvailable(x, y, level));
            const {_buffer: heights} = await provider.requestTileGeometry(x, y, level);
            return Array.from({length: 65}, (_, row) => heights[65 * row + column]);
          }));
          for (const [east, other] of [edges.slice(0, 2), edges.slice(2)]) {
            east.forEach((height, i) => {
              assert.ok(height !== 0);
              assert.ok(Math.abs(height - other[i]) < 1e-3,
                `${west} ${domain} ${level}: ${height}`);
            });
          }
        }
      }
      provider.dispose();
    }
  });

test('tiles of MapLibre go on behind the date line as they do elsewhere', TIMEOUT, async () => {
  const protocol = new TksProtocol();
  for (const [west, domain] of STREAMS) {
    const source = await protocol.add('earth', await around(west, domain));
    for (const z of [0, 2, 5]) {
      const y = 2 ** z >> 1, rows = [0, 100, 255];
      const heightsOf = async (x, column) => {
        const rgba = await source.render('heights', {z, x, y});
        return rows.map((row) => {
          const [r, g, b] = rgba.subarray(4 * (256 * row + column));
          return r * 256 + g + b / 256 - 32768;
        });
      };
      const last = await heightsOf(2 ** z - 1, 255), first = await heightsOf(0, 0);
      last.forEach((height, i) => assert.ok(
        Math.abs(height - first[i]) < (STEEPEST * 10 * 360) / 256 / 2 ** z, `${west} ${z}`));
      assert.ok((await source.render('texture', {z, x: 0, y}))[3] === 255);
    }
    protocol.remove('earth');
  }
});

/** No pixel is off by a part of a sample, neither elsewhere nor beside the date line. */
test('tiles of MapLibre have the heights at the middles of their pixels', TIMEOUT, async () => {
  const protocol = new TksProtocol();
  for (const [west, domain] of STREAMS) {
    const source = await protocol.add('earth', await around(west, domain));
    for (const z of [1, 3, 6]) {
      const y = 2 ** z >> 1, row = 77;
      const north = Math.atan(Math.sinh(Math.PI * (1 - (2 * (y + (row + 0.5) / 256)) / 2 ** z)));
      for (const x of [0, 2 ** z >> 1, 2 ** z - 1]) {
        const rgba = await source.render('heights', {z, x, y});
        for (let column = 0; column < 256; ++column) {
          const [r, g, b] = rgba.subarray(4 * (256 * row + column));
          const east = ((x + (column + 0.5) / 256) / 2 ** z) * 360 - 180;
          const wave = waveAt(east, 89.5 - (north * 180) / Math.PI);
          const off = Math.abs(r * 256 + g + b / 256 - 32768 - wave);
          assert.ok(off < 0.7, `${west} ${domain}, ${east}: ${off}`);  // a tenth of a sample: 2
        }
      }
    }
    protocol.remove('earth');
  }
});

test('heights on a cube are no grid that tiles are cut out of', TIMEOUT, async () => {
  const cube = {data: new Int16Array(9 * 54), width: 9, height: 54, domain: 'cube'};
  await assert.rejects(TksTerrainProvider.fromUrl(await encode({heights: cube})),
    {code: 'unsupported'});
});
