// SPDX-License-Identifier: Apache-2.0
// The loader for deck.gl without a screen: meshes of streams and of what has come of them.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';
import {load, loadInBatches, selectLoaderSync} from '@loaders.gl/core';

import {TksLoader} from '../src/deck.js';
import {encode} from '../src/encode.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);
const bytesOf = async (name) => {
  const file = await readFile(new URL(name, vectors));
  return file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
};

test('loaders.gl finds the loader, which says what it is', async () => {
  const stream = await bytesOf('joint_budget_97x97_128x128.tks');
  assert.equal(selectLoaderSync(stream, [TksLoader]), TksLoader);
  assert.equal(selectLoaderSync('https://x/alps.tks', [TksLoader]), TksLoader);
  const about = JSON.parse(await readFile(new URL('../package.json', import.meta.url)));
  assert.equal(TksLoader.version, about.version);
  assert.equal(TksLoader.module, about.name);
});

test('bounds of a TerrainLayer say where the samples lie', async () => {
  const stream = await bytesOf('joint_budget_97x97_128x128.tks'), bounds = [8, 46, 9, 47];
  const mesh = await load(stream, [TksLoader], {terrain: {bounds}, tks: {triangles: 3000}});
  const [[west, south, low], [east, north, high]] = mesh.header.boundingBox;
  const half = 0.5 / 97;  // of a sample, in degrees
  for (const [got, wanted] of [
    [west, 8 + half], [south, 46 + half], [east, 9 - half], [north, 47 - half],
  ]) assert.ok(Math.abs(got - wanted) < 1e-6, `${got} is not ${wanted}`);
  assert.ok(low < high);
  const {POSITION, NORMAL, TEXCOORD_0} = mesh.attributes, count = mesh.header.vertexCount;
  assert.equal(POSITION.value.length, 3 * count);
  assert.equal(TEXCOORD_0.value.length, 2 * count);
  const {value: indices} = mesh.indices;
  assert.ok(indices.length <= 9000 && indices.every((index) => index < count));
  assert.equal(mesh.texture.width, 128);
  for (let i = 0; i < count; i += 7) {
    assert.ok(NORMAL.value[3 * i + 2] > 0);  // up
    const [x, y] = POSITION.value.subarray(3 * i);
    assert.ok(Math.abs(TEXCOORD_0.value[2 * i] - (x - 8)) < 1e-5);
    assert.ok(Math.abs(TEXCOORD_0.value[2 * i + 1] - (47 - y)) < 1e-5);
  }
});

test('a stream that says where it lies needs no bounds; origins keep numbers small', async () => {
  const stream = await bytesOf('placed_joint_20x15_40x31.tks');
  const at = await load(stream, [TksLoader]);
  const [west, south] = at.header.boundingBox[0];
  const near = await load(stream, [TksLoader], {tks: {origin: [west, south]}});
  assert.ok(west > 5 && west < 12 && south > 47 && south < 49);
  for (const value of near.header.boundingBox.map(([x, y]) => [x, y]).flat()) {
    assert.ok(value > -1e-5 && value < 0.01);
  }
});

test('a texture that counts longitudes another way than the heights lies on them', async () => {
  const placed = (west) => ({width: 72, height: 36, crs: 'EPSG:4326',
    geotransform: [west, 0.25, 0, 9, 0, -0.5]});
  const stream = await encode({
    heights: {...placed(180), data: new Int16Array(72 * 36)},
    texture: {...placed(-180), data: new Uint8Array(3 * 72 * 36)},
  });
  const {attributes} = await load(stream.buffer, [TksLoader]);
  assert.ok(attributes.TEXCOORD_0.value.every((value) => value >= 0 && value <= 1));
});

test('of a stream without a place metres are counted from the middle', async () => {
  const {attributes, header} =
    await load(await bytesOf('joint_budget_97x97_128x128.tks'), [TksLoader]);
  // Its spacing is unknown, too: 30 m.
  assert.deepEqual(header.boundingBox.map(([x, y]) => [x, y]), [[-1440, -1440], [1440, 1440]]);
  assert.ok(attributes.TEXCOORD_0.value.every((value) => value >= 0 && value <= 1));
});

test('batches are meshes of prefixes that grow; the last one is that of the stream', async () => {
  const stream = await bytesOf('joint_budget_97x97_128x128.tks'), options = {tks: {triangles: 500}};
  const chunks = [];
  for (let at = 0; at < stream.byteLength; at += 1000) chunks.push(stream.slice(at, at + 1000));
  const batches = [];
  for await (const batch of TksLoader.parseInBatches(chunks, options)) batches.push(batch);
  assert.deepEqual(batches.map(({bytesUsed}) => bytesUsed), [5000, 12000]);
  const whole = await TksLoader.parse(stream, options);
  assert.deepEqual(batches.at(-1).data.attributes, whole.attributes);
  assert.notDeepEqual(batches[0].data.attributes, whole.attributes);
  const loaded = await loadInBatches(new Blob([stream]), TksLoader, options);
  let last;
  for await (const batch of loaded) last = batch;
  assert.deepEqual(last.data.attributes, whole.attributes);
  const few = [];
  for await (const batch of TksLoader.parseInBatches(chunks, {tks: {bytes: 2500}})) few.push(batch);
  assert.equal(few.length, 1);
  assert.equal(few[0].data.loaderData.availableBytes, 2500);
});

test('images and foreign files are refused', async () => {
  await assert.rejects(TksLoader.parse(await bytesOf('rgb_50x37.tks')), /is an image/);
  const text = new TextEncoder().encode('nothing').buffer;
  await assert.rejects(TksLoader.parse(text), {code: 'corrupt'});
  const cut = (await bytesOf('joint_budget_97x97_128x128.tks')).slice(0, 30);
  const batches = (async () => {
    for await (const batch of TksLoader.parseInBatches([cut])) assert.fail(String(batch));
  })();
  await assert.rejects(batches, {code: 'truncated'});
});
