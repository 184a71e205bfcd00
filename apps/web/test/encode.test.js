// SPDX-License-Identifier: Apache-2.0
// The encoder as a module: its promises, its words, what it refuses; bytes as of the native one.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';

import {encode} from '../src/encode.js';
import {TksError, open} from '../src/index.js';
import {placeOf, projectionOf} from '../src/place.js';
import {Decoder} from '../src/stream_decoder.js';
import {terrainOf, tiffOf} from './terrain.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;

async function samplesOf(stream) {
  const file = await readFile(new URL('../dist/tetrakis.wasm', import.meta.url));
  const decoder = new Decoder(await WebAssembly.compile(file), 2 ** 30);
  decoder.append(stream);
  return decoder.samples(stream.length, 0);
}

test('lossless comes back bit for bit, with its place', async () => {
  const {heights, texture} = terrainOf(48);
  heights.data[77] = heights.nodata = -32768;
  const stream = await encode({heights, texture});
  const {info} = await open(stream);
  assert.deepEqual(await samplesOf(stream), {heights: heights.data, texture: texture.data});
  assert.equal(info.lossless, true);
  assert.deepEqual(info.geotransform, heights.geotransform);
  assert.deepEqual(
    [info.crs, info.unit, info.spacingX, info.nodata], ['EPSG:32611', 'm', 30, -32768]);
});

/** Places of a raster at its corners, its middle and beside it. */
const places = (size) => [[0, 0], [size, 0], [0, size], [size, size], [size / 2, size / 2],
  [size / 3, size * 0.9]];

test('what `project` gives goes along, so that others place the stream', async () => {
  const {heights, texture} = terrainOf(48);
  const known = placeOf((await open(await encode({heights}))).info, 'heights');
  const asked = new Set(), {inverse} = projectionOf(heights.crs);
  const project = (x, y, crs) => (asked.add(crs), inverse(x, y));
  const own = {...texture, crs: 'another', geotransform: heights.geotransform, project};
  for (const worker of [true, false]) {
    const stream = await encode(
      {heights: {...heights, crs: 'my grid', project}, texture: own}, {worker});
    const {info} = await open(stream);
    assert.ok(info.positions.length <= 200 && info.texturePositions.length <= 200);
    const place = placeOf(info, 'heights');
    for (const [column, row] of places(48)) {
      const [x, y] = place.pixels(...known.degrees(column, row));
      assert.ok(Math.hypot(x - column, y - row) < 0.1, `${column}, ${row}: ${x}, ${y}`);
    }
  }
  assert.deepEqual([...asked], ['my grid', 'another']);
});

test('what `project` does not know is no position', async () => {
  const {heights} = terrainOf(16);
  const {geotransform, ...nowhere} = heights;
  const thrown = new RangeError('outside of the grid');
  const fails = (given, error) => assert.rejects(encode({heights: given}), error);
  await fails({...nowhere, project: () => [0, 0]}, {code: 'usage', message: /geotransform/});
  await fails({...heights, project: () => undefined}, {code: 'unsupported', message: /project/});
  await fails({...heights, project: (x) => [Math.abs(Math.sin(7919 * x)), 1]},
    {code: 'unsupported'});
  await fails({...heights, project: () => {
    throw thrown;
  }}, thrown);
});

test('undeclared nodata is found where that is asked for', async () => {
  const {heights} = terrainOf(48);
  for (let i = 0; i < heights.data.length; i += 7) heights.data[i] = -9999;
  for (const [nodata, declared] of [['auto', -9999], [undefined, null], [5, 5]]) {
    const stream = await encode({heights: {...heights, nodata}});
    const {info} = await open(stream);
    assert.equal(info.hasNodata ? info.nodata : null, declared);
    assert.deepEqual((await samplesOf(stream)).heights, heights.data);
  }
});

test('targets are kept: bytes, largest error, dB', async () => {
  const {heights, texture} = terrainOf(64);
  let last = 0;
  const budget = await encode({heights, texture, bytes: 3000, index: true, regions: 16},
    {progress: (done) => (last = done)});
  assert.ok(budget.length <= 3000 && budget.length > 2700);
  assert.ok(last > 0.5 && last <= 1);
  assert.equal((await open(budget)).info.hasIndex, true);
  const floats = {...heights, data: Float32Array.from(heights.data, (v) => v + 0.25)};
  const bounded = (await samplesOf(await encode({heights: floats, maxError: 2}))).heights;
  assert.ok(bounded.every((v, i) => Math.abs(v - floats.data[i]) <= 2));
  const {info} = await open(await encode({texture, psnr: 40}));
  assert.ok(info.hasTexture && !info.hasHeights);
});

test('a spacing of null is unknown, as none at all', async () => {
  const {heights} = terrainOf(16);
  const [unknown, none] = await Promise.all([null, undefined].map((spacing) =>
    encode({heights: {...heights, spacing}})));
  assert.deepEqual(unknown, none);
});

test('a target of null is none', async () => {
  const {heights} = terrainOf(16);
  assert.deepEqual(await encode({heights, bytes: null, maxError: undefined}),
    await encode({heights}));
});

test('enormous limits are none', async () => {
  const {heights} = terrainOf(16);
  assert.deepEqual(await encode({heights, bytes: 1e300}), await encode({heights, bytes: 1e9}));
  assert.deepEqual(await encode({heights, triangles: 2 ** 32}),
    await encode({heights, triangles: 2 ** 32 - 1}));
});

test('an ImageData is a texture', async () => {
  const data = new Uint8ClampedArray(4 * 30).fill(255);
  const {info} = await open(await encode({texture: {data, width: 6, height: 5}}));
  assert.equal(info.textureChannels, 4);
});

test('columns that go round are coded as a cylinder', async () => {
  const {heights} = terrainOf(16);
  const texture = {data: Uint8Array.from({length: 30}, (_, i) => i * 7), width: 6, height: 5};
  for (const domain of ['plane', 'cylinder']) {
    const stream = await encode({heights: {...heights, domain}, texture: {...texture, domain}});
    const {info} = await open(stream);
    assert.equal(info.domain, domain);
    assert.equal(info.textureDomain, domain);
    assert.deepEqual(await samplesOf(stream), {heights: heights.data, texture: texture.data});
  }
  await assert.rejects(encode({heights: {...heights, domain: 'ball'}}), /domain/);
});

test('a further colour is no alpha', async () => {
  const data = Uint8Array.from({length: 4 * 30}, (_, i) => (i * 7) % 200);
  for (const opaque of [false, true]) {
    const terrain = await open(await encode({texture: {data, width: 6, height: 5, opaque}}));
    assert.equal(terrain.info.textureOpaque, opaque);
    const {texture} = await terrain.decode();
    const expected = data.map((value, i) => (opaque && i % 4 === 3 ? 255 : value));
    assert.deepEqual([...texture.data], [...expected]);
  }
});

test('textures of 16 bits are shown from black to their white level', async () => {
  const data = Uint16Array.from({length: 30}, (_, i) => (i * 500) % 4000);
  for (const whiteLevel of [undefined, 2000, 65535]) {
    const terrain = await open(await encode({texture: {data, width: 6, height: 5, whiteLevel}}));
    const white = terrain.info.textureWhiteLevel;
    if (whiteLevel) assert.equal(white, whiteLevel);
    else assert.ok(white > 2000 && white < 4000, `found ${white}`);
    const {texture} = await terrain.decode();
    const shown = [...texture.data].filter((_, i) => i % 4 === 0);
    assert.deepEqual(shown, [...data].map((v) => Math.min(255, Math.round((v * 255) / white))));
  }
  for (const whiteLevel of [-1, 0.5, NaN, 65536]) {
    await assert.rejects(encode({texture: {data, width: 6, height: 5, whiteLevel}}), /whiteLevel/);
  }
});

test('what makes no sense is refused by code and sentence', async () => {
  const {heights, texture} = terrainOf(16);
  const refused = (input, pattern) => assert.rejects(encode(input), (error) => {
    assert.ok(error instanceof TksError);
    assert.equal(error.code, 'usage', error.message);
    assert.match(error.message, pattern);
    return true;
  });
  await refused({}, /./);
  await refused({heights, bytes: 100, psnr: 30}, /one of bytes, psnr, maxError and lossless/);
  for (const value of [-1, 0, NaN, '']) {
    await refused({heights, bytes: value}, /bytes is a number above 0.*lossless: true/);
    await refused({heights, psnr: value}, /psnr is a number above 0/);
    await refused({heights, maxError: value}, /maxError is a number above 0/);
  }
  await refused({heights, regions: -1}, /regions is a number that is not negative/);
  await refused({heights, byte: 2000, level: 3}, /cannot have byte, level: it knows heights,/);
  await refused({heights: {...heights, noData: 0}}, /`heights` cannot have noData/);
  await refused({texture: {...texture, alpha: true}}, /`texture` cannot have alpha/);
  await assert.rejects(encode({heights}, {onProgress() {}}), /cannot have onProgress/);
  await refused({heights, bytes: Infinity}, /bytes is a number .* finite/);
  await refused({heights: {...heights, spacing: [30]}}, /spacing is a number of metres, or two/);
  await refused({heights: {...heights, data: [1, 2]}}, /one of these typed arrays: Uint8Array, /);
  await refused({heights: {...heights, width: 17}}, /17 x 16 samples/);
  await refused({heights: {...heights, geotransform: [1, 2]}}, /six numbers/);
  await refused({heights: {...heights, registration: 'pixel'}}, /one of unknown, area, point/);
  await refused({texture: {...texture, channels: 5}}, /1, 2, 3 or 4 channels/);
  for (const values of [0, 16 * 8, 16 * 24, 16 * 16 * 5]) {
    await refused({texture: {...texture, data: new Uint8Array(values)}},
      /16 x 16 texels of 1, 2, 3 or 4 channels are not the \d+ values of its data/);
  }
  await refused({heights, index: 'regions'}, /one of false, true, windows/);
  await refused({heights, index: 'windows', bytes: 900}, /lossless/);
  await assert.rejects(encode({heights}, {signal: AbortSignal.abort(new Error('gone'))}), /gone/);
});

test('what progress throws comes back', async () => {
  const {heights} = terrainOf(48);
  const own = new RangeError('the page is wrong');
  await assert.rejects(
    encode({heights}, {progress: () => { throw own; }}), (error) => error === own);
});

test('in Node a thread encodes: others go on meanwhile, and a signal ends it', async () => {
  const {heights} = terrainOf(513), input = {heights, bytes: 20000};
  let beats = 0;
  const beat = setInterval(() => ++beats, 5);
  const stream = await encode(input);
  clearInterval(beat);
  assert.ok(beats > 3, `${beats}`);
  assert.deepEqual(await encode(input, {worker: false}), stream);
  const stop = new AbortController(), begun = [];
  const progress = (done) => {
    begun.push(done);
    stop.abort(new Error('enough'));
  };
  await assert.rejects(encode(input, {signal: stop.signal, progress}), /enough/);
  assert.equal(begun.length, 1);
});

test('the bytes are those of the native encoder', {skip: !existsSync(CLI)}, async () => {
  const folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  const {data, width, height} = terrainOf(65).heights;
  const name = join(folder, 'height.tif'), out = join(folder, 'out.tks');
  await writeFile(name, tiffOf({data, width, height}));
  const targets = [[{}, ['--lossless']], [{bytes: 2000}, ['--bytes', '2000']],
    [{maxError: 3}, ['--max-error', '3']],
    [{index: 'windows', regions: 16}, ['--lossless', '--windows', '--regions', '16']]];
  for (const [target, options] of targets) {
    const {status, stderr} = spawnSync(CLI, ['encode', name, ...options, '-f', '-o', out]);
    assert.equal(status, 0, String(stderr));
    const native = new Uint8Array(await readFile(out));
    const info = await open(native).then((terrain) => terrain.info);
    const stream = await encode({...target, heights: {data, width, height,
      spacing: [info.spacingX, info.spacingY], unit: info.unit || undefined,
      crs: info.crs || undefined,
      geotransform: info.hasGeotransform ? info.geotransform : undefined}});
    assert.deepEqual(await samplesOf(stream), await samplesOf(native));
    assert.deepEqual(stream, native);
  }
  await rm(folder, {recursive: true});
});
