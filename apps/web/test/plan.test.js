// SPDX-License-Identifier: Apache-2.0
// Streams with an index: what is fetched for a view, by how many requests, and what is decoded.
import assert from 'node:assert/strict';
import {mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {PerspectiveCamera} from 'three';

import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {Held, requestsFor} from '../src/ranges.js';
import {TksTerrain} from '../src/three.js';
import {serve} from './server.js';
import {settle} from './settle.js';
import {terrainOf} from './terrain.js';

const SIDE = 193;
let folder, bytes, original;

before(async () => {
  original = terrainOf(SIDE);
  bytes = await encode({...original, bytes: 90000, index: true, regions: 32});
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await writeFile(join(folder, 'a.tks'), bytes);
  await writeFile(join(folder, 'cut.tks'), bytes.subarray(0, 60000));
});
after(() => rm(folder, {recursive: true}));

/** A map of a square of samples, so many pixels wide. */
function mapOf(x, y, side, pixels) {
  const k = 2 / side;
  return {clip: [k, 0, 0, -k * x - 1, 0, -k, 0, k * y + 1, 0, 0, 0, 0, 0, 0, 0, 1],
    width: pixels, height: pixels};
}
const CORNER = mapOf(0, 0, 48, 480);

/** Squared error of the texture over a square. */
function errorIn({data}, x0, y0, side) {
  let sum = 0;
  for (let y = y0; y < y0 + side; ++y) {
    for (let x = x0; x < x0 + side; ++x) {
      for (let c = 0; c < 3; ++c) {
        sum += (data[4 * (y * SIDE + x) + c] - original.texture.data[3 * (y * SIDE + x) + c]) ** 2;
      }
    }
  }
  return sum;
}

async function served(faults, use) {
  const server = await serve(folder, faults);
  try {
    return await use(server.url + 'a.tks', server);
  } finally {
    await server.close();
  }
}

test('bytes that are here, and gaps', () => {
  const held = new Held();
  for (const [b, e] of [[10, 20], [30, 40], [20, 25], [24, 31], [50, 50]]) held.add(b, e);
  assert.deepEqual(held.ranges, [[10, 40]]);
  held.add(60, 70);
  assert.equal(held.bytes, 40);
  assert.deepEqual(held.gaps(0, 65), [[0, 10], [40, 60]]);
  assert.deepEqual(held.gaps(12, 30), []);
});

test('a dozen requests at a time, for what helps and is there', () => {
  const plan = [[900, 940, 2], [0, 30, 1], [990, 1200, 1], [1500, 1600, 1], [40, 50, 0]]
    .map(([begin, end, gain]) => ({begin, end, gain}));
  assert.deepEqual(requestsFor(plan, 1000), [[900, 940], [0, 30], [990, 1000]]);
  const many = Array.from({length: 99}, (_, i) => ({begin: i * 90, end: i * 90 + 10, gain: 1}));
  assert.equal(requestsFor(many, 1e6).length, 12);
  assert.deepEqual(requestsFor(plan, 1000, 50), [[900, 940], [0, 10]]);
});

test('where requests cost more there are fewer, and the picture is as good', async () => {
  const results = [];
  for (const requestBytes of [0, 1024, 4096, 16384]) {
    await served({}, async (url, server) => {
      const terrain = await open(url, {requestBytes});
      let last;
      for await (const frame of terrain.refine({view: CORNER, mesh: false})) last = frame;
      const {length} = server.requests, error = errorIn(last.texture, 4, 4, 36);
      results.push({length, error});
      terrain.dispose();
    });
  }
  const [free, ...priced] = results;
  let before = free.length * 2 / 3;
  for (const {length, error} of priced) {
    assert.ok(length <= before, `${length} requests, ${before} where they cost less`);
    assert.ok(error <= 1.1 * free.error);
    before = length;
  }
});

test('two requests before the first picture; then what the view needs, and no more', async () => {
  await served({}, async (url, server) => {
    const terrain = await open(url, {requestBytes: 128});
    assert.equal(terrain.info.hasIndex, true);
    const frames = [];
    for await (const frame of terrain.refine({view: CORNER, mesh: false})) {
      if (frames.length === 0) assert.ok(server.requests.length <= 2);
      assert.equal(frame.bytes, terrain.loaded.bytes);
      frames.push(frame);
    }
    const last = frames.at(-1), {loaded} = terrain;
    assert.ok(frames.length > 1 && !last.complete);
    assert.equal(loaded.ranges.reduce((sum, [b, e]) => sum + e - b, 0), loaded.bytes);
    const whole = await (await open(bytes)).decode({mesh: false});
    const prefix = await (await open(bytes)).decode({mesh: false, bytes: last.bytes});
    assert.ok(errorIn(last.texture, 4, 4, 36) < 0.2 * errorIn(prefix.texture, 4, 4, 36));
    assert.ok(errorIn(last.texture, 4, 4, 36) < 2 * 3 * 36 ** 2);
    // Elsewhere then nothing is fetched twice, and all of it is the whole.
    const before = server.requests.length;
    await terrain.decode({view: mapOf(140, 140, 48, 480), mesh: false});
    assert.ok(server.requests.length > before);
    assert.deepEqual((await terrain.decode({mesh: false})).texture, whole.texture);
    assert.deepEqual(terrain.loaded.ranges, [[0, bytes.length]]);
    // Fewer bytes: the first that came.
    assert.equal((await terrain.decode({mesh: false, bytes: last.bytes})).bytes, last.bytes);
    const window = {x: 0, y: 0, width: 10, height: 10};
    const needed = await terrain.needed({part: 'texture', window});
    assert.ok(needed.every(([b, e]) => b < e && e <= bytes.length));
    terrain.dispose();
  });
});

test('a header longer than the first request takes another, which brings a picture', async () => {
  for (const side of [129, 225]) {
    const long = await encode({...terrainOf(side), bytes: 60000, index: true, regions: 16});
    const {headerBytes} = (await open(long)).info;
    assert.ok(headerBytes > 4096, `${headerBytes} bytes of ${side}²`);
    await writeFile(join(folder, 'long.tks'), long);
    await writeFile(join(folder, 'longer.tks'), long.subarray(0, headerBytes - 1));
    for (const faults of [{}, {noRanges: true}, {most: 3000}]) {
      await served(faults, async (url, server) => {
        const terrain = await open(url.replace('a.tks', 'long.tks'));
        if (!faults.most) assert.equal(server.requests.length, faults.noRanges ? 1 : 2);
        assert.ok(terrain.loaded.bytes < headerBytes + 8192);
        const asked = server.requests.length;
        const {value: frame} = await terrain.refine({view: CORNER}).next();
        assert.ok(frame.info.texturePsnr > 10 && frame.bytes > headerBytes, `${frame.bytes}`);
        if (faults.noRanges) assert.equal(server.requests.length, asked);
        assert.deepEqual(
          (await terrain.decode()).texture, (await (await open(long)).decode()).texture);
        await assert.rejects(open(url.replace('a.tks', 'longer.tks')),
          {code: 'truncated', message: /ends after \d+ bytes, inside the header/});
        terrain.dispose();
      });
    }
  }
});

test('a limit of bytes is kept', async () => {
  const requestBytes = 1024, terrain = await open(bytes, {requestBytes});
  const limit = terrain.info.headerBytes + 9000;
  for await (const {bytes: here} of terrain.refine({view: CORNER, bytes: limit})) {
    assert.ok(here <= Math.max(limit, 8192));
  }
  const left = limit - terrain.loaded.bytes;
  // What is left is worth no request of its own.
  assert.ok(left >= 0 && left < 2 * requestBytes, `${left} of ${limit} bytes are left`);
});

test('servers without ranges, or that forget them, and files cut short', async () => {
  const whole = await (await open(bytes)).decode({mesh: false});
  await served({noRanges: true}, async (url, server) => {
    const terrain = await open(url);
    for await (const frame of terrain.refine({view: CORNER, mesh: false})) assert.ok(frame.texture);
    assert.equal(server.requests.length, 1);
    assert.equal(terrain.loaded.bytes, bytes.length);
  });
  await served({}, async (url, server) => {
    const terrain = await open(url);
    await terrain.decode({view: CORNER, mesh: false, bytes: terrain.info.headerBytes + 12000});
    server.faults.noRanges = true;
    const frame = await terrain.decode({view: CORNER, mesh: false});
    assert.deepEqual(frame.texture, whole.texture);
  });
  await served({}, async (url) => {
    const terrain = await open(url.replace('a.tks', 'cut.tks'));
    const frame = await terrain.decode({view: CORNER, mesh: false});
    assert.ok(frame.bytes <= 60000 && terrain.truncated && !frame.complete);
  });
});

test('a request of a plan that fails: others are kept, and those still to come end', async () => {
  const load = (terrain) => terrain.load(Infinity, {view: CORNER});
  await served({}, async (url, server) => {
    const terrain = await open(url, {requestBytes: 128}), {bytes: before} = terrain.loaded;
    const asked = server.requests.length;
    server.faults.fail = [asked + 1, 150];
    await assert.rejects(load(terrain), {code: 'io', message: /answered 500/});
    assert.ok(server.requests.length > asked + 1);
    assert.ok(terrain.loaded.bytes > before, 'bytes behind the failing ones are here');
    terrain.dispose();
  });
  await served({}, async (url, server) => {
    const terrain = await open(url, {requestBytes: 128}), asked = server.requests.length;
    Object.assign(server.faults, {fail: [asked + 2, 100], stall: 10});
    await assert.rejects(load(terrain), {code: 'io', message: /answered 500/});
    assert.equal(await server.requests[asked].ended, false);
    terrain.dispose();
  });
});

test('a view that is none is refused', async () => {
  const terrain = await open(bytes);
  for (const view of [{...CORNER, width: 0}, {...CORNER, clip: [1]}, [1, 2, 3], {}]) {
    await assert.rejects(terrain.decode({view}),
      {code: 'usage', message: /clip, 16 numbers, and width and height/});
  }
});

/** Until nothing more comes. */
const fed = (object, camera) => settle(object, camera,
  {height: 400, told: ({terrain}) => terrain.loaded.bytes, times: 8, wait: 80});

test('a terrain of three.js goes on to what its camera needs, though it stays still', async () => {
  const terrain = await open(bytes, {requestBytes: 2 ** 14});
  const object = new TksTerrain(terrain, {triangles: 2000});
  const camera = new PerspectiveCamera(40, 1.6, 1, 1e6);
  camera.position.set(0, 4000, 4000);
  camera.lookAt(0, 0, 0);
  await fed(object, camera);
  const {bytes: settled} = terrain.loaded, view = object.viewOf(camera, 400);
  assert.ok(settled > 0.5 * bytes.length, `${settled} of ${bytes.length}`);
  assert.equal(await terrain.load(Infinity, {view, triangles: 2000}), settled);
  assert.equal(object.frame.bytes, settled);
  object.dispose();
});

test('a terrain of three.js asks a dozen times for a view, some more as it moves', async () => {
  const large = await encode({...terrainOf(385), bytes: 300000, index: true, regions: 32});
  await writeFile(join(folder, 'large.tks'), large);
  await served({}, async (url, server) => {
    const terrain = await open(url.replace('a.tks', 'large.tks'));
    const object = new TksTerrain(terrain, {triangles: 20000});
    await object.begin();
    const camera = new PerspectiveCamera(50, 1.6, 1, 1e6);
    const look = async (x, z) => {
      camera.position.set(x, 1600, z);
      camera.lookAt(1.4 * x, 0, 1.4 * z);
      await fed(object, camera);
      assert.ok(terrain.loaded.bytes < large.length);
      return server.requests.length;
    };
    const still = await look(-3500, -3500), moved = await look(-3500, 2000);
    assert.ok(still <= 12 && moved <= 20, `${still}, then ${moved} requests`);
    // They brought what helps: no other request is worth its cost.
    const view = object.viewOf(camera, 400), {bytes: settled} = terrain.loaded;
    assert.equal(await terrain.load(Infinity, {view, triangles: 20000}), settled);
    object.dispose();
  });
});

test('a terrain of three.js shows all of a file that is cut short', async () => {
  const camera = new PerspectiveCamera(40, 1.6, 1, 1e6);
  camera.position.set(0, 1500, 1500);
  camera.lookAt(0, 0, 0);
  for (const [index, size] of [[false, 40000], [true, 60000], [true, 20000]]) {
    const stream = index ? bytes : await encode({...original, bytes: 90000});
    const terrain = await open(stream.subarray(0, size)), errors = [];
    const object = new TksTerrain(terrain, {triangles: 2000});
    object.addEventListener('frame', ({frame}) => errors.push(frame.info.heightsRmse));
    await object.begin();
    await fed(object, camera);
    assert.ok(terrain.truncated);
    const {bytes: settled} = terrain.loaded, view = object.viewOf(camera, 400);
    if (!index) assert.equal(settled, size);
    else assert.equal(await terrain.load(Infinity, {view, triangles: 2000}), settled);
    assert.equal(object.frame.bytes, settled);
    assert.ok(object.frame.mesh.triangles.length > 3 * 1000);
    assert.ok(errors.length > 1 && errors.at(-1) < errors[0], `${errors}`);
    object.dispose();
  }
});

test('a view without a picture waits for one that has one', async () => {
  const spoils = [(camera) => (camera.aspect = NaN), (camera) => (camera.aspect = Infinity),
    (camera) => (camera.aspect = 0), (camera) => (camera.position.x = NaN)];
  for (const stream of [bytes, await encode({...original, bytes: 30000})]) {
    const object = new TksTerrain(await open(stream));
    const failures = [], camera = new PerspectiveCamera(40, 1.6, 1, 1e6);
    let frames = 0;
    object.addEventListener('error', ({error}) => failures.push(error));
    object.addEventListener('frame', () => ++frames);
    await object.begin();
    const {bytes: before} = object.terrain.loaded;
    const look = async (height) => {
      camera.updateProjectionMatrix();
      object.update(camera, height);
      await new Promise((resolve) => setTimeout(resolve, 80));
    };
    for (const height of [0, undefined, NaN]) await look(height);
    for (const spoil of spoils) {
      spoil(camera);
      await look(400);
      camera.aspect = 1.6;
      camera.position.set(0, 1500, 0);
      camera.lookAt(0, 0, 0);
    }
    assert.deepEqual([failures, frames, object.terrain.loaded.bytes], [[], 1, before]);
    await look(400);
    assert.ok(object.terrain.loaded.bytes > before && failures.length === 0);
    object.dispose();
  }
});

test('a terrain of three.js fetches for its camera, and on when that moves', async () => {
  const object = new TksTerrain(await open(bytes), {triangles: 2000});
  const camera = new PerspectiveCamera(40, 1.6, 1, 1e6);
  const look = async (x, z) => {
    camera.position.set(x, 1500, z);
    camera.lookAt(1.5 * x, 0, 1.5 * z);
    await fed(object, camera);
    return object.terrain.loaded.bytes;
  };
  const first = await look(-2000, -2000);
  assert.ok(first < 0.8 * bytes.length, `${first}`);
  assert.equal(await look(-2000, -2000), first);
  assert.ok((await look(2000, 2000)) > first);
  assert.equal(object.frame.bytes, object.terrain.loaded.bytes);
  object.dispose();
});
