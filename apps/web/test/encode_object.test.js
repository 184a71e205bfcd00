// SPDX-License-Identifier: Apache-2.0
// Meshes through the encoder of objects: its promises, its words, what it refuses.
import assert from 'node:assert/strict';
import {stat} from 'node:fs/promises';
import {test} from 'node:test';
import {build} from 'esbuild';

import {TksError, encodeObject} from '../src/encode.js';
import {open} from '../src/index.js';
import {ballOf, volumeOf} from './meshes.js';

const ball = ballOf(10), {texcoords, ...bare} = ball;
/** Red from west to east, green from north to south. */
const texture = {width: 64, height: 32, channels: 3, data: Uint8Array.from({length: 64 * 32 * 3},
  (_, i) => [4 * (Math.floor(i / 3) % 64), 8 * Math.floor(i / 192), 40][i % 3])};

/** The distance of a point to the nearest of others. */
function distanceTo(positions, [x, y, z]) {
  let least = Infinity;
  for (let i = 0; i < positions.length; i += 3) {
    least = Math.min(least,
      Math.hypot(positions[i] - x, positions[i + 1] - y, positions[i + 2] - z));
  }
  return least;
}
const pointsOf = ({positions}) => Array.from({length: positions.length / 3},
  (_, i) => [...positions.subarray(3 * i, 3 * i + 3)]);

test('triangles come back within the largest error, with unit and name', async () => {
  const {stream, report} = await encodeObject(
    {...bare, kind: 'triangles', maxError: 0.01, unit: 'mm', description: 'a ball'});
  const decoded = await open(stream), {info} = decoded;
  assert.equal(info.objectTriangles, ball.triangles.length / 3);
  assert.equal(info.unit, 'mm');
  assert.ok(Buffer.from(stream).includes('a ball'));
  const {object} = await decoded.decode();
  for (const point of pointsOf(object)) assert.ok(distanceTo(ball.positions, point) < 0.011);
  assert.deepEqual([report.kind, report.codedTriangles], ['triangles', info.objectTriangles]);
  assert.ok(report.largest < 0.011 && report.error <= report.largest, JSON.stringify(report));
  assert.deepEqual([report.triangles, report.components, report.borders], [360, 1, 0]);
});

test('a surface that is resampled keeps its bytes and its shape', async () => {
  const told = [];
  const {stream, report} = await encodeObject(
    {...bare, kind: 'resampled', bytes: 3000}, {progress: (done) => told.push(done)});
  assert.ok(stream.length <= 3000 && stream.length > 2000, `${stream.length}`);
  assert.ok(told.length > 0 && told.every((done) => done >= 0 && done <= 1));
  assert.deepEqual([report.kind, report.codedTriangles], ['resampled', 0]);
  assert.ok(report.patches > 0 && report.psnr > 40, JSON.stringify(report));
  const decoded = await open(stream);
  assert.equal(decoded.info.objectTriangles, 0);
  const {object} = await decoded.decode({triangles: 2000});
  const share = volumeOf(object) / volumeOf(ball);
  assert.ok(Math.abs(share - 1) < 0.01, `${share}`);
});

test('the texture comes back where texcoords lay it, of either kind', async () => {
  for (const kind of ['resampled', 'triangles']) {
    const {stream} = await encodeObject({...ball, texture, kind, bytes: 20000});
    const {object, texture: shown} = await (await open(stream)).decode({texels: 4096});
    const {positions, texcoords: places} = object;
    let checked = 0;
    for (let i = 0; i < positions.length / 3; ++i) {
      const [x, y, z] = positions.subarray(3 * i, 3 * i + 3);
      const down = Math.acos(y / Math.hypot(x, y, z)) / Math.PI;
      const round = (Math.atan2(-z, x) / (2 * Math.PI) + 1) % 1;
      if (down < 0.2 || down > 0.8 || round < 0.1 || round > 0.9) continue;
      const at = (place, count) => Math.min(count - 1, Math.max(0, Math.floor(place * count)));
      const texel = 4 * (at(places[2 * i + 1], shown.height) * shown.width +
        at(places[2 * i], shown.width));
      const [red, green] = shown.data.subarray(texel, texel + 2);
      assert.ok(Math.abs(red - 256 * round) < 24 && Math.abs(green - 256 * down) < 24,
        `${kind}: ${red}, ${green} at ${round}, ${down}`);
      ++checked;
    }
    assert.ok(checked > 50, `${checked}`);
  }
});

test('any list of numbers is a mesh, and a thread encodes as the caller does', async () => {
  const typed = {positions: Float32Array.from(ball.positions),
    triangles: Uint16Array.from(ball.triangles)};
  const listed = {positions: [...typed.positions], triangles: ball.triangles};
  const [{stream}, other] = await Promise.all([encodeObject({...typed, bytes: 900}),
    encodeObject({...listed, bytes: 900}, {worker: false})]);
  assert.deepEqual(other.stream, stream);
});

test('a signal ends it', async () => {
  const stop = new AbortController();
  const progress = () => stop.abort(new Error('enough'));
  const {positions, triangles} = ballOf(40);
  await assert.rejects(encodeObject({positions, triangles, bytes: 9000},
    {signal: stop.signal, progress}), /enough/);
});

test('maps and factors come along, of either kind', async () => {
  const grey = {width: 32, height: 16,
    data: Uint8Array.from({length: 512}, (_, i) => 8 * (i % 32))};
  const lights = {...texture, data: texture.data.map((value) => 255 - value)};
  const material = {pbrMetallicRoughness: {metallicFactor: 0.25}, emissiveFactor: [1, 1, 1]};
  for (const kind of ['resampled', 'triangles']) {
    const maps = {normal: texture, occlusion: grey, emissive: lights};
    const {stream} =
      await encodeObject({...ball, texture, maps, material, kind, bytes: 30000});
    assert.ok(stream.length <= 30000);
    const decoded = await open(stream);
    assert.deepEqual(JSON.parse(decoded.info.material), material);
    const frame = await decoded.decode({triangles: 2000});
    const names = kind === 'triangles' ? ['emissive', 'normal', 'occlusion']
      : ['emissive', 'occlusion'];  // normals count from texcoords, which patches have others of
    assert.deepEqual(Object.keys(frame.maps).sort(), names);
    const {emissive, occlusion} = frame.maps, {data, width, height} = frame.texture;
    assert.deepEqual([emissive.width, emissive.height], [width, height]);
    if (kind === 'triangles') continue;
    assert.deepEqual([occlusion.width, occlusion.height], [width, height]);
    let off = 0;
    for (let i = 0; i < data.length; i += 4) {
      off += Math.abs(data[i] - (255 - emissive.data[i]));
      off += Math.abs(data[i] - 2 * (occlusion.data[i] / 2));
    }
    assert.ok(off / (data.length / 2) < 24, `${off / data.length}`);
  }
});

test('what makes no sense is refused by code and sentence', async () => {
  const refused = (mesh, pattern) => assert.rejects(encodeObject(mesh), (error) => {
    assert.ok(error instanceof TksError);
    assert.equal(error.code, 'usage', error.message);
    assert.match(error.message, pattern);
    return true;
  });
  const bytes = 900;
  await refused({}, /positions are a list of 3 numbers each/);
  await refused(bare, /exactly one of bytes, psnr and maxError/);
  await refused({...bare, bytes, psnr: 40}, /exactly one of bytes, psnr and maxError/);
  for (const value of [-1, 0, NaN, Infinity]) {
    await refused({...bare, bytes: value}, /bytes is a number above 0, and finite\.$/);
  }
  await refused({...bare, bytes, lossless: true}, /A mesh cannot have lossless: it knows pos/);
  await refused({...bare, bytes, kind: 'quads'}, /kind is one of auto, resampled, triangles/);
  await refused({...bare, bytes, triangles: []}, /no triangles/);
  await refused({...bare, bytes, triangles: [0, 1]}, /triangles are a list of 3 numbers each/);
  await refused({...bare, bytes, triangles: [0, 1, 9999]}, /names vertex 9999/);
  await refused({...bare, bytes, triangles: [0, 0, 1]}, /No triangle of the mesh is left/);
  await refused({...bare, bytes, positions: [NaN, ...ball.positions.slice(1)]}, /finite place/);
  await refused({...bare, bytes, texture}, /texcoords, two numbers for each/);
  await refused({...ball, bytes}, /A texture and texcoords/);
  await refused({...bare, bytes, maps: {normal: texture}}, /give one/);
  await refused({...ball, bytes, texture, maps: {gloss: texture}}, /name of a map is one of/);
  await refused({...ball, bytes, texture, maps: {normal: {...texture, width: 9}}}, /normal: 9 x/);
  await refused({...ball, texture, psnr: 40}, /takes a number of bytes as its target/);
  await refused({...ball, bytes, texture: {...texture, crs: 'x'}}, /texture .* cannot have crs/);
  await refused({...ball, bytes, texture: {...texture, width: 63}}, /63 x 32 samples/);
});

test('a page in one script carries the module alone that it calls', async () => {
  const web = new URL('..', import.meta.url).pathname, packed = {
    encode: 'packed_encode', encodeObject: 'packed_encode_object'};
  for (const [name, module] of Object.entries(packed)) {
    const contents = `import {${name}} from './src/encode.js'; window.call = ${name};`;
    const {outputFiles: [{contents: script}]} = await build({stdin: {contents, resolveDir: web},
      bundle: true, minify: true, write: false, format: 'iife', logLevel: 'silent'});
    const {size} = await stat(`${web}dist/${module}.js`);
    assert.ok(script.length > size && script.length < size + 40000, `${name}: ${script.length}`);
  }
});
