// SPDX-License-Identifier: Apache-2.0
// The adapter of MapLibre without a map: places on Earth against GDAL's numbers, and tiles against
// the surface they are cut out of.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';

import {Cutter} from '../src/cut.js';
import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {TksProtocol} from '../src/maplibre.js';
import {boundsOf, gridOf, projectionOf} from '../src/place.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);

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
  assert.equal(projectionOf('EPSG:2056'), null);
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
  for (let i = 0; i < 4; ++i) assert.ok(Math.abs(source.bounds[i] - bounds[i]) < 1e-6);
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
    const wanted = (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) +
      v * ((1 - u) * at(0, 1) + u * at(1, 1));
    assert.ok(Math.abs(got - wanted) < 0.01, `${got} is not ${wanted}`);
    ++checked;
  }
  assert.ok(checked > 100);
  const colours = await source.render('texture', {z, x, y});
  assert.ok(new Set(new Uint32Array(colours.buffer)).size > 100);
  assert.equal(await source.render('texture', {z, x: x + 100, y}), null);
  await assert.rejects(protocol.add('alps', input, {bounds}), /taken/);
  protocol.remove('alps');
  await assert.rejects(protocol.add('nowhere', input), /does not say where it lies/);
});

/** 72 x 36 heights of 5 m a column and a texture, both of this geotransform in degrees. */
const inDegrees = (geotransform) => encode({
  heights: {data: Int16Array.from({length: 72 * 36}, (_, i) => 5 * (i % 72)), width: 72, height: 36,
    crs: 'EPSG:4326', geotransform},
  texture: {data: new Uint8Array(3 * 72 * 36).fill(99), width: 72, height: 36},
});

test('a place that goes across 180° has tiles on both sides', async () => {
  const protocol = new TksProtocol();
  for (const [west, across, longitudes] of [[0, 360, [-100, -20, 40, 170]],
    [170, 20, [172, 178, -179, -171]], [-190, 20, [172, 178, -179, -171]],
    [-180, 360, [-170, 100]]]) {
    const name = `from${west}`, columns = across / 72;
    const source = await protocol.add(name, await inDegrees([west, columns, 0, 9, 0, -0.5]));
    const [first, , last] = source.bounds;
    assert.deepEqual([first, last], [-180, 180]);
    for (const longitude of longitudes) {
      const z = 6, place = ((longitude + 180) / 360) * 2 ** z, x = Math.floor(place);
      const tile = {z, x, y: 31};  // just north of the equator
      const heights = await source.render('heights', tile);
      const pixel = Math.floor((place - x) * 256), at = 4 * (256 * 250 + pixel);
      const got = heights[at] * 256 + heights[at + 1] + heights[at + 2] / 256 - 32768;
      const east = ((x + (pixel + 0.5) / 256) / 2 ** z) * 360 - 180;
      const column = ((east - west + 720) % 360) / columns;
      assert.ok(Math.abs(got - 5 * (column - 0.5)) < 0.1, `${longitude}: ${got}, ${column}`);
      assert.equal((await source.render('texture', tile))[at], 99);
    }
    protocol.remove(name);
  }
});

/** Height at a place, as tiles have it: in that of a zoom, the pixel that holds it. */
async function heightOf(source, longitude, latitude, z) {
  const up = Math.asinh(Math.tan((latitude * Math.PI) / 180)) / Math.PI;
  const place = [((longitude + 180) / 360) * 2 ** z, ((1 - up) / 2) * 2 ** z];
  const [x, y] = place.map(Math.floor);
  const [column, row] = [place[0] - x, place[1] - y].map((part) => Math.floor(256 * part));
  const [r, g, b] =
    (await source.render('heights', {z, x, y})).subarray(4 * (256 * row + column));
  return r * 256 + g + b / 256 - 32768;
}

test('beside the ground, and in voids, heights are those of its border', async () => {
  const protocol = new TksProtocol();
  // 1000 m in the west to 1630 m in the east; the outer columns and some in the middle are void.
  const isVoid = (x) => x < 3 || x > 60 || (x >= 30 && x < 34);
  const data = Int16Array.from({length: 64 * 32}, (_, i) =>
    (isVoid(i % 64) ? -9999 : 1000 + 10 * (i % 64)));
  for (const [crs, geotransform, side] of [
    ['EPSG:4326', [7, 0.01, 0, 46, 0, -0.01], 0.01],
    ['EPSG:32632', [4e5, 900, 0, 51e5, 0, -900], 0.01],
    ['EPSG:4326', [179.8, 0.01, 0, 46, 0, -0.01], 0.01],
  ]) {
    const heights = {data, width: 64, height: 32, nodata: -9999, crs, geotransform};
    const source = await protocol.add('edge', await encode({heights}));
    await source.terrain.decode();
    const {bounds: [, south, , north]} = source.texture ?? source, middle = (south + north) / 2;
    const west = crs === 'EPSG:4326' ? geotransform[0] : 7.7, east = west + 64 * side;
    for (const z of [3, 6, source.heights.maxzoom]) {
      for (const latitude of [south - 20, south - 0.2, middle, north + 0.2, north + 20]) {
        for (const [longitude, wanted] of [[west - 50, 1030], [west - 2, 1030], [east + 2, 1600],
          [east + 50, 1600]]) {
          const within = ((longitude + 540) % 360) - 180;
          const got = await heightOf(source, within, latitude, z);
          const most = z > 3 ? 80 : 350;  // a mip level of 2 x 1 samples
          assert.ok(Math.abs(got - wanted) < most, `${crs}: ${got} at ${within} ${latitude}, ${z}`);
        }
      }
    }
    if (crs === 'EPSG:4326' && west < 100) {
      const hole = await heightOf(source, west + 0.315, middle, source.heights.maxzoom);
      assert.ok(Math.abs(hole - 1290) < 1 || Math.abs(hole - 1340) < 1, `${hole}`);
    }
    protocol.remove('edge');
  }
});

test('bounds that are none are refused', async () => {
  const input = await readFile(new URL('regions_joint_index_40x33_50x47.tks', vectors));
  const protocol = new TksProtocol();
  for (const bounds of [[9, 46, 8, 47], [8, 47, 9, 46], [NaN, 0, 1, 1], [1, 2, 3], [0, 0, 0, 1],
    [0, 0, 1, 91], [0, 0, 400, 1], 'abcd', 7]) {
    await assert.rejects(protocol.add('x', input, {bounds}),
      {code: 'usage', message: /`bounds` are \[west, south, east, north\]/}, String(bounds));
  }
  const source = await protocol.add('x', input, {bounds: [170, -10, -170, 10]});
  assert.deepEqual(source.bounds.map(Math.round), [-180, -10, 180, 10]);
  const lost = await encode({heights: {data: new Int16Array(16), width: 4, height: 4,
    crs: 'EPSG:32632', geotransform: [1e150, 1, 0, 0, 0, -1]}});
  await assert.rejects(protocol.add('y', lost), {code: 'unsupported', message: /does not reach/});
});

/** A map that draws when it is told to, with these sources. */
class Drawing {
  #heard = {idle: new Set(), remove: new Set()};
  refreshed = 0;
  constructor(sources, draws = true) {
    Object.assign(this, {sources, draws});
  }
  getStyle() {
    return {sources: this.sources};
  }
  refreshTiles() {
    ++this.refreshed;
  }
  on(name, heard) {
    this.#heard[name].add(heard);
  }
  once(name, heard) {
    this.on(name, heard);
  }
  off(name, heard) {
    this.#heard[name].delete(heard);
  }
  fire(name) {
    for (const heard of this.#heard[name]) heard();
  }
  triggerRepaint() {
    if (this.draws) setTimeout(() => this.fire('idle'));
  }
}

test('refining ends: the map is idle, without the source, removed, never idle', async (t) => {
  const input = await readFile(new URL('regions_joint_index_40x33_50x47.tks', vectors));
  const protocol = new TksProtocol(), bounds = [8, 46, 8.1, 46.07];
  const warn = t.mock.method(console, 'warn', () => {});
  for (const [name, draws] of [
    ['idle', true], ['without', true], ['removed', false], ['never', false],
  ]) {
    const source = await protocol.add(name, input, {bounds});
    const map = new Drawing(name === 'without' ? {} : {dem: source.heights}, draws);
    const refining = source.refine(map);
    if (name === 'removed') setTimeout(() => map.fire('remove'), 50);
    const late = new Promise((_, reject) => setTimeout(reject, 30000, new Error(name)).unref());
    await Promise.race([refining, late]);
    assert.equal(map.refreshed, name === 'without' ? 0 : 1);
    assert.ok(source.terrain.loaded.bytes === input.length, name);
    protocol.remove(name);
  }
  assert.deepEqual(warn.mock.calls.map(({arguments: [said]}) => /setWorkerUrl/.test(said)), [true]);
});

test('a name is taken from the beginning; who removes it ends its opening', async (t) => {
  const input = await readFile(new URL('regions_joint_index_40x33_50x47.tks', vectors));
  const protocol = new TksProtocol(), bounds = [8, 46, 8.1, 46.07];
  const first = protocol.add('alps', input, {bounds});
  await assert.rejects(protocol.add('alps', input, {bounds}), {code: 'usage', message: /taken/});
  const source = await first, dispose = t.mock.method(source.terrain, 'dispose');
  protocol.remove('alps');
  assert.equal(dispose.mock.callCount(), 1);
  const removed = protocol.add('alps', input, {bounds});
  protocol.remove('alps');
  await assert.rejects(removed, {code: 'usage', message: /"alps" was removed while/});
  await assert.rejects(protocol.add('alps', input), /does not say where it lies/);
  await protocol.add('alps', input, {bounds});
});

test('tiles of a part that a stream lacks are refused', async () => {
  const input = await readFile(new URL('geometry_budget_129x97.tks', vectors));
  const protocol = new TksProtocol();
  await protocol.add('bare', input, {bounds: [8, 46, 8.1, 46.07]});
  await assert.rejects(protocol.tile({url: 'tks://bare/texture/3/4/2'}, new AbortController()),
    {code: 'usage', message: 'This stream has no texture.'});
});

test('few places of a tile are projected, and the others lie where they would', async () => {
  const terrain =
    await open(await readFile(new URL('placed_joint_20x15_40x31.tks', vectors)));
  const cutter = new Cutter(terrain), place = cutter.place('heights'), {pixels} = place;
  let projected = 0;
  place.pixels = (...at) => (++projected, pixels(...at));
  const [west, south, east, north] = place.bounds;
  const steps = Array.from({length: 256}, (_, i) => (i + 0.5) / 256);
  const longitudes = steps.map((step) => west + step * (east - west));
  const latitudes = steps.map((step) => north - step * (north - south));
  const heights = await cutter.heights(longitudes, latitudes);
  assert.ok(projected < 256 * 16, `${projected} of ${256 * 256} places`);
  let checked = 0;
  for (let i = 0; i < heights.length; i += 89) {
    const column = i % 256, row = Math.floor(i / 256);
    if (column === 255) continue;
    const alone =
      await cutter.heights(longitudes.slice(column, column + 2), latitudes.slice(row, row + 1));
    if (Number.isNaN(alone[0]) || Number.isNaN(heights[i])) continue;
    assert.ok(Math.abs(alone[0] - heights[i]) < 0.1, `${heights[i]} is not ${alone[0]}`);
    ++checked;
  }
  assert.ok(checked > 500, `${checked} places`);
});

test('a stream that says where it lies needs no bounds', async () => {
  const input = await readFile(new URL('placed_joint_20x15_40x31.tks', vectors));
  const source = await new TksProtocol().add('placed', input);
  const [west, south, east, north] = source.bounds;
  assert.ok(west < east && south < north, String(source.bounds));
  // UTM zone 32 and the texture's own place, which is near.
  for (let i = 0; i < 4; ++i) {
    assert.ok(Math.abs(source.bounds[i] - source.texture.bounds[i]) < 0.1);
  }
  const z = source.heights.maxzoom, tiles = 2 ** z;
  const x = Math.floor((((west + east) / 2 + 180) / 360) * tiles);
  const up = Math.asinh(Math.tan((((south + north) / 2) * Math.PI) / 180));
  const y = Math.floor(((1 - up / Math.PI) / 2) * tiles);
  assert.ok(await source.render('heights', {z, x, y}));
});
