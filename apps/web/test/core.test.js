// SPDX-License-Identifier: Apache-2.0
// The core: sources of bytes with the faults that servers have, frames, aborts, limits of memory.
import assert from 'node:assert/strict';
import {openAsBlob} from 'node:fs';
import {readFile, mkdtemp, writeFile, rm} from 'node:fs/promises';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {gzipSync} from 'node:zlib';

import {encode} from '../src/encode.js';
import {FIRST_FRAME, TksError, open} from '../src/index.js';
import {serve} from './server.js';
import {terrainOf} from './terrain.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url).pathname;
const NAME = 'joint_budget_97x97_128x128.tks';
let bytes, folder;

before(async () => {
  bytes = new Uint8Array(await readFile(vectors + NAME));
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await writeFile(join(folder, 'whole.tks'), bytes);
  await writeFile(join(folder, 'short.tks'), bytes.subarray(0, bytes.length >> 1));
  await writeFile(join(folder, 'header.tks'), bytes.subarray(0, 30));
  await writeFile(join(folder, 'page.tks'), '<!doctype html><title>Sign in</title>');
  await writeFile(join(folder, 'empty.tks'), '');
});
after(() => rm(folder, {recursive: true}));

async function withServer(faults, use) {
  const server = await serve(folder, faults);
  try {
    return await use(server);
  } finally {
    await server.close();
  }
}

const framesOf = async (terrain, options) => {
  const frames = [];
  for await (const frame of terrain.refine(options)) frames.push(frame);
  return frames;
};

const wasm = (name) => readFile(new URL(`../dist/${name}.wasm`, import.meta.url));
/** The decoder's module. */
const compiled = async () => WebAssembly.compile(await wasm('tetrakis'));

const rejects = (promise, code, pattern) =>
  assert.rejects(promise, (error) => {
    assert.ok(error instanceof TksError, String(error));
    assert.equal(error.code, code, error.message);
    assert.match(error.message, pattern);
    return true;
  });

test('frames grow to the whole stream, from bytes, a Blob and a URL alike', async () => {
  await withServer({}, async (server) => {
    const results = [];
    const inputs = [bytes, bytes.buffer.slice(0), new Blob([bytes]), server.url + 'whole.tks'];
    for (const input of inputs) {
      const terrain = await open(input);
      const frames = await framesOf(terrain, {normals: true, surface: true});
      terrain.dispose();
      assert.ok(frames.length >= 2);
      for (let i = 1; i < frames.length; ++i) assert.ok(frames[i].bytes > frames[i - 1].bytes);
      assert.ok(frames.at(-1).complete);
      assert.equal(frames.at(-1).bytes, bytes.length);
      results.push(frames);
    }
    for (const frames of results) assert.deepEqual(frames, results[0]);
    const tks = server.requests.map((request) => request.range);
    assert.equal(tks[0], 'bytes=0-4095');
    assert.ok(tks.length <= 3, tks.join());
  });
});

test('what a terrain tells of itself is what the frame of most bytes does', async () => {
  const terrain = await open(bytes), {info: first} = terrain;
  assert.ok(first.availableBytes < bytes.length && first.heightsRmse > 0);
  const whole = await terrain.decode({mesh: false});
  assert.equal(whole.info.availableBytes, bytes.length);
  assert.deepEqual(terrain.info, whole.info);
  await terrain.decode({mesh: false, bytes: 4096});
  assert.deepEqual(terrain.info, whole.info);
  assert.notDeepEqual(first, whole.info);
  terrain.dispose();
});

test('a frame is whole: triangles within the budget, indices, normals, RGBA', async () => {
  const terrain = await open(bytes);
  const {mesh, texture, surface, info} = await terrain.decode(
    {triangles: 500, normals: true, surface: true});
  assert.ok(mesh.triangles.length <= 1500 && mesh.triangles.length > 600);
  assert.ok(mesh.triangles.every((vertex) => vertex < mesh.heights.length));
  assert.ok(mesh.gridIndex.every((sample) => sample < info.width * info.height));
  assert.equal(mesh.normals.length, 3 * mesh.heights.length);
  for (let i = 0; i < mesh.normals.length; i += 3) {
    assert.ok(Math.abs(Math.hypot(...mesh.normals.subarray(i, i + 3)) - 1) < 1e-5);
  }
  assert.equal(texture.data.length, 4 * info.textureWidth * info.textureHeight);
  assert.equal(surface.data.length, info.width * info.height);
  const small = await terrain.decode({texels: 40, mesh: false});
  assert.ok(small.texture.width <= 40 && small.texture.level > 0 && !small.mesh);
});

test('nothing is made finer than the bytes that are here feed', async () => {
  const terrain = await open(bytes);
  const {headerBytes, streamBytes} = terrain.info;
  let texels = 0;
  for (let most = headerBytes + 40; most < streamBytes; most = Math.ceil(1.3 * most)) {
    const {info, mesh, texture, surface} = await terrain.decode({bytes: most, surface: true});
    const finer = (width, height, level) => (width * height) / 4 ** (level - 1);
    assert.ok(texture.width >= texels && surface.level <= info.coarsestLevel);
    if (texture.level > 0) {
      const next = finer(info.textureWidth, info.textureHeight, texture.level);
      assert.ok(next > 64 * info.textureBytes, `${next} texels of ${info.textureBytes} bytes`);
    }
    assert.ok(mesh.triangles.length <= 12 * info.geometryBytes || mesh.triangles.length <= 6,
      `${mesh.triangles.length / 3} triangles of ${info.geometryBytes} bytes`);
    texels = texture.width;
  }
  const first = {bytes: headerBytes + 40, mesh: false};
  assert.ok((await terrain.decode(first)).texture.level > 0);
  assert.equal((await terrain.decode({...first, textureLevel: 0})).texture.width, 128);
  assert.equal((await terrain.decode({mesh: false})).texture.width, 128);
  terrain.dispose();
});

test('the coarsest mesh of a long grid is the least, whatever is asked for', async () => {
  const terrain = await open(
    await encode({heights: {data: new Int16Array(1025 * 3).map((_, i) => i % 97), width: 1025,
      height: 3}}));
  const {mesh} = await terrain.decode({triangles: 2});
  assert.equal(mesh.triangles.length, 3 * 1024);
  terrain.dispose();
});

test('what is no number, no number of triangles or no level is refused', async () => {
  const terrain = await open(bytes);
  for (const [options, pattern] of [
      [{bytes: NaN}, /`bytes` is a number/], [{bytes: '9'}, /`bytes`/],
    [{bytes: -1}, /`bytes` is a number from 0 on/],
    [{triangles: 0}, /`triangles` is a whole number from 2 on/], [{triangles: 1}, /`triangles`/],
    [{triangles: 10.5}, /`triangles`/], [{triangles: '9'}, /`triangles`/],
    [{triangles: NaN}, /`triangles`/], [{texels: NaN}, /`texels`/], [{samples: NaN}, /`samples`/],
    [{surface: true, surfaceLevel: 99}, /`surfaceLevel` is a mip level of this stream/],
    [{surface: true, surfaceLevel: 0.5}, /`surfaceLevel`/], [{surfaceLevel: -1}, /`surfaceLevel`/],
    [{textureLevel: 99}, /`textureLevel`/], [{textureLevel: NaN}, /`textureLevel`/]]) {
    await rejects(terrain.decode(options), 'usage', pattern);
    await rejects(terrain.refine(options).next(), 'usage', pattern);
  }
  await rejects(terrain.load(), 'usage', /`bytes`/);
  await rejects(terrain.load(100, {triangles: 0}), 'usage', /`triangles`/);
  const {mesh} = await terrain.decode({triangles: Infinity});
  assert.deepEqual((await terrain.decode({triangles: 2 ** 32})).mesh, mesh);
  assert.ok((await terrain.decode({triangles: 2})).mesh.triangles.length <= 6);
});

test('a view gives a part of the mesh', async () => {
  const terrain = await open(bytes);
  // The western half: column 0 to 48 becomes -1 to 1; rows likewise; no perspective.
  const view = [1 / 24, 0, 0, -1, 0, 1 / 48, 0, -1, 0, 0, 0, 0, 0, 0, 0, 1];
  const whole = (await terrain.decode({triangles: 2000})).mesh;
  const part = (await terrain.decode({triangles: 2000, view})).mesh;
  assert.ok(part.triangles.length > 0 && part.triangles.length < whole.triangles.length);
});

test('prefixes that are there need no request; a longer one needs one', async () => {
  await withServer({}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    assert.equal(server.requests.length, 1);
    await terrain.decode({bytes: 2000});
    assert.equal(server.requests.length, 1);
    await Promise.all([terrain.decode(), terrain.decode()]);
    assert.equal(server.requests.length, 2);
    assert.deepEqual(
      terrain.loaded, {requests: 2, bytes: bytes.length, ranges: [[0, bytes.length]]});
    terrain.dispose();
  });
});

test('a server without ranges: one request, the same frames', async () => {
  await withServer({noRanges: true}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    const frames = await framesOf(terrain);
    assert.ok(frames.length >= 2 && frames.at(-1).complete);
    assert.equal(server.requests.length, 1);
    terrain.dispose();
  });
});

test('ranges that end midway: what is there is left out of the whole file', async () => {
  await withServer({}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    server.faults.noRanges = true;
    const frame = await terrain.decode();
    assert.deepEqual(frame.texture, (await (await open(bytes)).decode()).texture);
    terrain.dispose();
  });
});

test('a file that is cut short is a prefix, and says so', async () => {
  for (const noRanges of [false, true]) {
    await withServer({noRanges}, async (server) => {
      const terrain = await open(server.url + 'short.tks');
      const frames = await framesOf(terrain);
      assert.equal(frames.at(-1).complete, false);
      assert.equal(frames.at(-1).bytes, bytes.length >> 1);
      assert.equal(terrain.truncated, true);
      terrain.dispose();
    });
  }
  await rejects(open(bytes.subarray(0, 30)), 'truncated', /ends after 30 bytes, inside the header/);
});

test('a server that sends less than was asked for is asked again', async () => {
  await withServer({most: 1000}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    const frame = await terrain.decode();
    assert.ok(frame.complete && !terrain.truncated);
    assert.equal(terrain.loaded.bytes, bytes.length);
    terrain.dispose();
  });
});

test('a server that repeats ends behind the end of the file is understood', async () => {
  await withServer({overstated: true}, ({url}) =>
    rejects(open(url + 'header.tks'), 'truncated', /ends after 30 bytes/));
});

test('a disposed terrain says so', async () => {
  await withServer({}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    terrain.dispose();
    await rejects(terrain.decode(), 'usage', /is disposed/);
    await rejects(terrain.decode({bytes: 2000}), 'usage', /is disposed/);
  });
});

test('a worker that answers after it failed is not heard', async () => {
  const worker = {postMessage() {}, terminate() {}};
  const opening = open(bytes, {worker});
  await new Promise((resolve) => setTimeout(resolve, 20));
  worker.onerror({message: 'gone'});
  worker.onmessage({data: {id: 0, result: null}});
  await rejects(opening, 'io', /gone/);
});

test('a Worker serves one terrain', async () => {
  const worker = {postMessage() {}, terminate() {}}, stop = new AbortController();
  const first = open(bytes, {worker, signal: stop.signal});
  await rejects(open(bytes, {worker}), 'usage', /This Worker serves another terrain/);
  stop.abort();
  await assert.rejects(first, {name: 'AbortError'});
});

test('what cannot be opened says why', async () => {
  await withServer({}, async ({url}) => {
    await rejects(open(url + 'page.tks'), 'corrupt',
      /page\.tks \(application\/octet-stream\) is not a Tetrakis stream: it begins with "<!doc/);
    await rejects(open(url + 'none.tks'), 'io', /the server answered 404/);
    await rejects(open(url + 'header.tks'), 'truncated', /ends after 30 bytes/);
  });
  await withServer({headers: {'content-type': 'text/html'}}, ({url}) =>
    rejects(open(url + 'page.tks'), 'corrupt', /\(text\/html\) is not a Tetrakis stream/));
  await rejects(open('http://127.0.0.1:9/closed.tks'), 'io',
    /cannot be fetched: its server cannot be reached/);
  await rejects(open('folder/a.tks'), 'io', /is no address.*the bytes of a file/);
  await rejects(open(new URL(import.meta.url)), 'io', /is a file, which cannot be fetched/);
  await rejects(open(new TextEncoder().encode('PK..')), 'corrupt', /not a Tetrakis stream/);
  await rejects(open(7), 'usage', /URL, bytes or a Blob/);
  await withServer({empty: true}, ({url}) =>
    rejects(open(url + 'whole.tks'), 'io', /the server answered 204/));
  await rejects(open(bytes, {worker: 'w.js'}), 'io', /The worker w\.js cannot be started/);
  const damaged = bytes.slice();
  damaged[4] = 99;
  await rejects(open(damaged), 'unsupported', /version/i);
});

test('a file that changes between requests is refused, as far as its server tells', async () => {
  const name = join(folder, 'changing.tks'), longer = new Uint8Array(bytes.length + 1);
  longer.set(bytes);
  const date = 'Fri, 27 Nov 2026 00:00:00 GMT', later = 'Fri, 27 Nov 2026 00:00:01 GMT';
  for (const [first, second, file, isRefused] of [
    [{etag: '"x"'}, {etag: '"y"'}, bytes, true],
    [{'last-modified': date}, {'last-modified': later}, bytes, true],
    [{}, {}, longer, true],
    [{etag: '"x"'}, {etag: '"x"'}, longer, true],
    [{etag: '"x"'}, {etag: 'W/"x"'}, bytes, false],
    [{'last-modified': date}, {etag: '"x"', 'last-modified': date}, bytes, false],
    [{etag: '"x"', 'last-modified': date}, {etag: '"x"', 'last-modified': later}, bytes, false],
  ]) {
    await writeFile(name, bytes);
    await withServer({headers: first}, async (server) => {
      const terrain = await open(server.url + 'changing.tks');
      await writeFile(name, file);
      server.faults.headers = second;
      if (isRefused) await rejects(terrain.decode(), 'changed', /has changed on the server/);
      else assert.ok((await terrain.decode()).complete);
      terrain.dispose();
    });
  }
});

test('a Blob that changes on the disk is refused', async () => {
  const name = join(folder, 'chosen.tks');
  await writeFile(name, bytes);
  const terrain = await open(await openAsBlob(name));
  await writeFile(name, bytes.subarray(0, 5000));
  await rejects(terrain.decode(), 'io', /This file cannot be read: it has changed or gone/);
});

test('aborting does not wait for a module that never comes', async () => {
  await writeFile(join(folder, 'decoder.wasm'), bytes);
  await withServer({stall: 0}, async ({url}) => {
    const reason = new Error('the user went away');
    const stop = new AbortController();
    const opening = open(bytes, {wasm: url + 'decoder.wasm', signal: stop.signal});
    setTimeout(() => stop.abort(reason), 50);
    const late = new Promise((_, reject) => setTimeout(reject, 20000, new Error('late')).unref());
    await assert.rejects(Promise.race([opening, late]), reason);
  });
});

test('aborting: the reason comes back, and the terrain goes on', async () => {
  const reason = new Error('the user went away');
  await assert.rejects(open(bytes, {signal: AbortSignal.abort(reason)}), reason);
  const terrain = await open(bytes);
  const stop = new AbortController();
  const frame = terrain.decode({signal: stop.signal});
  stop.abort(reason);
  await assert.rejects(frame, reason);
  assert.ok((await terrain.decode()).complete);
  // A load that is aborted before it begins asks for nothing, and leaves no rejection behind.
  await withServer({}, async (server) => {
    const remote = await open(server.url + 'whole.tks');
    server.faults.missing = true;
    const asked = server.requests.length;
    await assert.rejects(remote.load(bytes.length, {signal: AbortSignal.abort(reason)}), reason);
    await new Promise((resolve) => setTimeout(resolve, 50));
    assert.equal(server.requests.length, asked);
    const late = new AbortController();
    const failing = remote.load(bytes.length, {signal: late.signal});
    late.abort(reason);
    await assert.rejects(failing, reason);
    await new Promise((resolve) => setTimeout(resolve, 50));
    remote.dispose();
  });
});

test('a connection that is cut ahead of an answer or in the middle of it broke', async () => {
  for (const sent of [0, 100]) {
    const server = createServer((request, response) => {
      if (sent === 0) return response.destroy();
      response.writeHead(206, {'content-length': 4096, 'content-range': 'bytes 0-4095/9999'});
      response.write(bytes.subarray(0, sent));
      setTimeout(() => response.destroy(), 20);
    });
    await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
    await rejects(open(`http://127.0.0.1:${server.address().port}/a.tks`), 'io',
      /: the connection broke\.$/);
    server.close();
  }
});

/** Resolves to false if the connection is cut before all of the answer went out. */
const answered = (request) => Promise.race([request.ended,
  new Promise((_, reject) => setTimeout(reject, 20000, new Error('it stays open')).unref())]);
const until = async (condition) => {
  while (!condition()) await new Promise((resolve) => setTimeout(resolve, 5));
};

test('aborting ends requests on the network, and what is missing is asked for anew', async () => {
  const reason = new Error('the user went away');
  for (const noRanges of [false, true]) {
    await withServer({noRanges, stall: 10}, async (server) => {
      const stop = new AbortController();
      const opening = open(server.url + 'whole.tks', {signal: stop.signal});
      await until(() => server.requests.length === 1);
      stop.abort(reason);
      await assert.rejects(opening, reason);
      assert.equal(await answered(server.requests[0]), false);
    });
    await withServer({noRanges, stall: 5000}, async (server) => {
      const opened = new AbortController(), stop = new AbortController();
      const terrain = await open(server.url + 'whole.tks', {signal: opened.signal});
      opened.abort(reason);  // too late to end anything
      const frame = terrain.decode({signal: stop.signal});
      const waiting = terrain.decode();
      await until(() => server.requests.length === (noRanges ? 1 : 2));
      await new Promise((resolve) => setTimeout(resolve, 20));
      server.faults.stall = Infinity;
      stop.abort(reason);
      await assert.rejects(frame, reason);
      assert.equal(await answered(server.requests.at(noRanges ? 0 : 1)), false);
      assert.deepEqual(await waiting, await (await open(bytes)).decode());
      assert.equal(server.requests.length, noRanges ? 2 : 3);
      terrain.dispose();
    });
  }
});

test('bytes come on while frames are made; who leaves ends their coming', async () => {
  await withServer({}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    server.faults.stall = 6000;
    for await (const frame of terrain.refine({first: {triangles: 50}, triangles: 2000})) {
      assert.equal(frame.bytes, 4096);
      assert.ok(frame.mesh.triangles.length <= 150);
      await until(() => server.requests.length === 2);
      break;
    }
    assert.equal(await answered(server.requests[1]), false);
    terrain.dispose();
  });
  const terrain = await open(bytes), frames = [];
  for await (const frame of terrain.refine({first: {triangles: 50}, triangles: 2000})) {
    frames.push(frame);
  }
  // All was there behind the first picture: there is nothing to be shown between.
  assert.deepEqual(frames.map(({bytes: here}) => here), [4096, bytes.length]);
  assert.ok(frames[1].mesh.triangles.length > 3000);
});

test('what comes soon is waited for, instead of a frame without it', async () => {
  await writeFile(join(folder, 'large.tks'), await encode({...terrainOf(385), bytes: 90000}));
  await withServer({pause: [70000, 30]}, async (server) => {
    const framed = async () => {
      const terrain = await open(server.url + 'large.tks');
      const frames = await framesOf(terrain);
      terrain.dispose();
      return frames.map((frame) => frame.bytes);
    };
    // A busy machine may make a pause of 30 ms longer than receivers wait, but not five times.
    let shown = await framed();
    for (let again = 0; again < 4 && shown.length > 2; ++again) shown = await framed();
    assert.deepEqual(shown, [4096, 90000]);
    // Whoever asked for it, and however much is here.
    const other = await open(server.url + 'large.tks');
    const loading = other.load(Infinity);
    await until(() => other.loaded.bytes > 60000);
    const rest = await framesOf(other, {after: 4096});
    assert.deepEqual(rest.map((frame) => frame.bytes), [other.info.streamBytes]);
    await loading;
    other.dispose();
  });
});

test('on a slow link frames follow each other at fourfold bytes', async () => {
  await withServer({most: 700}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    const shown = (await framesOf(terrain)).map((frame) => frame.bytes);
    assert.equal(shown.at(-1), bytes.length);
    for (const here of shown) {
      const alone = await (await open(bytes)).decode({bytes: here});
      assert.deepEqual((await terrain.decode({bytes: here})).texture, alone.texture);
    }
    terrain.dispose();
  });
});

test('what a request needs beside its range goes with each', async () => {
  await withServer({}, async (server) => {
    const terrain = await open(server.url + 'whole.tks', {request: {headers: {'X-Key': 'abc'}}});
    await terrain.decode();
    assert.deepEqual(server.requests.map(({headers}) => headers['x-key']), ['abc', 'abc']);
    assert.deepEqual(server.requests.map(({range}) => range),
      ['bytes=0-4095', `bytes=4096-${bytes.length - 1}`]);
    terrain.dispose();
  });
});

test('disposing ends requests on the network', async () => {
  await withServer({noRanges: true, stall: 5000}, async (server) => {
    const terrain = await open(server.url + 'whole.tks');
    const frame = terrain.decode();
    terrain.dispose();
    await rejects(frame, 'usage', /is disposed/);
    assert.equal(await answered(server.requests[0]), false);
  });
});

test('an aborted frame ends at its next part if it was begun, else it never begins', async (t) => {
  const {Decoder} = await import('../src/stream_decoder.js');
  const terrain = await open(bytes), stop = new AbortController();
  const {parts} = Decoder.prototype;
  let made = 0;
  t.mock.method(Decoder.prototype, 'parts', function* (request) {
    const steps = parts.call(this, request);
    for (let step = steps.next(); ; step = steps.next()) {
      if (step.done) return step.value;
      if (++made === 2) stop.abort();
      yield;
    }
  });
  const all = {surface: true, normals: true}, {signal} = stop;
  const frames = Array.from({length: 5}, () => terrain.decode({...all, signal}));
  for (const frame of frames) await assert.rejects(frame, {name: 'AbortError'});
  const whole = await terrain.decode(all);
  assert.equal(made, 2 + 4);  // opened, mesh, surface, normals; the texture ends it
  assert.deepEqual(whole, await (await open(bytes)).decode(all));
});

test('addresses above 2 GiB', async () => {
  const {Decoder} = await import('../src/stream_decoder.js');
  const module = await compiled();
  const request = {bytes: bytes.length, mesh: true, normals: true, surface: true, texture: true,
    triangles: 1000, texels: 4096, samples: 4096};
  const low = new Decoder(module, 2 ** 30), high = new Decoder(module, 2 ** 30);
  low.append(bytes);
  high.append(bytes);
  let above = 0;
  high.opened(300, ({instance}) => {
    instance.allocate(2 ** 31);  // nobody writes there, so that it takes no memory of the machine
    const {malloc} = instance.calls;
    instance.calls = {...instance.calls, malloc: (size) => {
      const address = malloc(size);
      above += address < 0;
      return address;
    }};
  });
  high.opened(299, () => {});  // begins anew
  const cut = [1 / 24, 0, 0, -1, 0, 1 / 48, 0, -1, 0, 0, 0, 0, 0, 0, 0, 1];
  for (const view of [null, cut]) {
    assert.deepEqual(high.decode({...request, cut: view}), low.decode({...request, cut: view}));
  }
  assert.deepEqual(high.samples(bytes.length, 0), low.samples(bytes.length, 0));
  assert.ok(above > 10, `${above} addresses`);
  const errorOf = (decoder) => {
    try {
      return decoder.opened(bytes.length, (opened) => opened.setLevels(99, 0));
    } catch ({code, message}) {
      return {code, message};
    }
  };
  assert.match(errorOf(high).message, /level/);
  assert.deepEqual(errorOf(high), errorOf(low));
  high.opened(bytes.length, ({instance}) => {
    assert.throws(() => instance.with(2 ** 32 + 8, () => {}), {code: 'memory'});
  });
});

test('a limit of memory is kept; an instance that aborted is replaced', async () => {
  await rejects(open(bytes, {memory: 1000}).then((terrain) => terrain.decode()), 'limit',
    /the limit \(`memory`\) of 1000 bytes/);
  const {Decoder} = await import('../src/stream_decoder.js');
  const decoder = new Decoder(await compiled(), 2 ** 30);
  decoder.append(bytes);
  const request = {bytes: bytes.length, texture: true, texels: 4096, samples: 4096};
  const before = decoder.decode(request);
  assert.throws(() => decoder.opened(bytes.length, (opened) => {
    opened.instance.calls.free(0x7ffffff0);
    opened.instance.calls.tks_decode_texture(0x7ffffff0, 0, 0);
  }), (error) => error.code === 'memory');
  assert.deepEqual(decoder.decode(request), before);
});

test('only memory that runs out is called so', async () => {
  const {Decoder} = await import('../src/stream_decoder.js');
  const decoder = new Decoder(await compiled(), 2 ** 30);
  decoder.append(bytes);
  for (const [error, code] of [[new TypeError('no number'), 'usage'],
    [new WebAssembly.LinkError('no import'), 'usage'],
    [new RangeError('allocation failed'), 'memory'],
    [new WebAssembly.RuntimeError('unreachable'), 'memory']]) {
    assert.throws(() => decoder.opened(300, () => { throw error; }), {name: 'TksError', code});
  }
  await rejects(open(bytes, {wasm: await wasm('tetrakis-encode')}), 'usage', /has no web_open\(\)/);
  await rejects(open(bytes, {wasm: new Uint8Array(10)}), 'io', /module cannot be loaded/);
  await rejects((await open(bytes)).needed({}), 'usage', /needed\(\) takes `part`/);
});

test('a decoder that goes on gives what one that begins anew gives, forth and back', async () => {
  const {Decoder} = await import('../src/stream_decoder.js');
  const module = await compiled();
  const growing = new Decoder(module, 2 ** 30);
  growing.append(bytes.subarray(0, 1000));
  for (const cut of [700, 701, 1000, 1700, 3000, 2999, 5000, 400, bytes.length, bytes.length]) {
    if (cut === 1700) growing.append(bytes.subarray(1000));
    const fresh = new Decoder(module, 2 ** 30);
    fresh.append(bytes.subarray(0, cut));
    const request = {bytes: cut, mesh: true, normals: true, surface: true, texture: true,
      triangles: 1000, texels: cut % 2 ? 64 : 4096, samples: cut % 3 ? 64 : 4096};
    assert.deepEqual(growing.decode(request), fresh.decode(request), `${cut} bytes`);
  }
});

test('memory of a module grows in few pieces', async () => {
  const {Instance} = await import('../src/instance.js');
  const instance = new Instance(await compiled()), sizes = new Set();
  for (let i = 0; i < 1000; ++i) {
    instance.allocate(2 ** 16);
    sizes.add(instance.calls.memory.buffer.byteLength);
  }
  assert.ok(Math.max(...sizes) > 1000 * 2 ** 16 && sizes.size < 30, `${sizes.size} sizes`);
});

test('a texture that becomes RGBA in pieces is whole', async () => {
  const width = 700, height = 400;
  const data = new Uint8ClampedArray(4 * width * height)
    .map((_, i) => (i % 4 === 3 ? 255 : (i >> 2) % width + (i & 3) * 40));
  const terrain = await open(await encode({texture: {data, width, height}}));
  const {texture} = await terrain.decode();
  assert.deepEqual(texture.data, data);
  terrain.dispose();
});

test('bytes that came in many pieces are given to the decoder at once', async (t) => {
  const {Decoder} = await import('../src/stream_decoder.js');
  const {OpenedStream} = await import('../src/opened_stream.js');
  const module = await compiled();
  const put = t.mock.method(OpenedStream.prototype, 'put');
  const whole = new Decoder(module, 2 ** 30), pieces = new Decoder(module, 2 ** 30);
  whole.append(bytes);
  for (let at = 0; at < bytes.length; at += 100) pieces.append(bytes.subarray(at, at + 100));
  assert.deepEqual(pieces.samples(bytes.length, 0), whole.samples(bytes.length, 0));
  assert.equal(put.mock.callCount(), 2);
});

test('a module is compiled whatever the server calls it', async () => {
  await writeFile(join(folder, 'decoder.wasm'),
    await readFile(new URL('../dist/tetrakis.wasm', import.meta.url)));
  for (const type of ['application/wasm', 'application/octet-stream']) {
    await withServer({headers: {'content-type': type}}, async ({url}) => {
      const terrain = await open(bytes, {worker: false, wasm: `${url}decoder.wasm`});
      assert.equal((await terrain.decode(FIRST_FRAME)).bytes, FIRST_FRAME.bytes);
      terrain.dispose();
    });
  }
  await withServer({missing: true}, async ({url}) => {
    await assert.rejects(open(bytes, {worker: false, wasm: `${url}decoder.wasm`}), {code: 'io'});
  });
});

test('memory returns: a hundred frames take no more than one', async () => {
  const {Decoder} = await import('../src/stream_decoder.js');
  const decoder = new Decoder(await compiled(), 2 ** 30);
  decoder.append(bytes);
  const size = () => decoder.opened(bytes.length, (o) => o.instance.calls.memory.buffer.byteLength);
  const request = {bytes: bytes.length, mesh: true, normals: true, surface: true, texture: true,
    triangles: 5000, texels: 4096, samples: 4096};
  decoder.decode(request);
  const first = size();
  for (let i = 0; i < 100; ++i) decoder.decode(request);
  assert.equal(size(), first);
});

test('the modules are small', async () => {
  const limits = {tetrakis: 332, 'tetrakis-raster': 231, 'tetrakis-encode': 535,
    'tetrakis-encode-object': 638};
  for (const [name, limit] of Object.entries(limits)) {
    const file = await readFile(new URL(`../dist/${name}.wasm`, import.meta.url));
    const zipped = gzipSync(file, {level: 9}).length;
    console.log(`${name}.wasm: ${file.length} bytes, ${zipped} gzipped`);
    assert.ok(zipped <= limit * 1000, `${name}.wasm`);
  }
});
