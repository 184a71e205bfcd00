// SPDX-License-Identifier: Apache-2.0
// The core on a page of headless Chromium: what only a browser refuses, and its worker.
import assert from 'node:assert/strict';
import {cp, mkdtemp, rm} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {chromium} from 'playwright-core';

import {serve} from './server.js';

const web = new URL('..', import.meta.url).pathname;
const vectors = new URL('../../../conformance/vectors/', import.meta.url).pathname;
const NAME = 'joint_budget_97x97_128x128.tks';
let browser, folder, site;

before(async () => {
  browser = await chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await cp(vectors + NAME, join(folder, 'a.tks'));
  site = await serve(web);
});
after(async () => {
  await browser.close();
  await site.close();
  await rm(folder, {recursive: true});
});

/** Calls `use` with a page of the site, and a server of another origin with these faults. */
async function withPage(faults, use) {
  const server = await serve(folder, faults), page = await browser.newPage();
  try {
    await page.goto(site.url + 'test/core.html');
    await use(page, server);
  } finally {
    await page.close();
    await server.close();
  }
}

/** What open() on the page says of an address. */
const refusal = (page, url) => page.evaluate(async (address) => {
  const {TksError, open} = await import('/src/index.js');
  const error = await open(address).then(() => null, (thrown) => thrown);
  return error && {code: error.code, message: error.message, known: error instanceof TksError};
}, url);

test('another origin that lets no page read it is told from one that is away', async () => {
  const open = {headers: {'access-control-allow-origin': '*'}};
  await withPage({}, async (page, server) => {
    const refused = await refusal(page, server.url + 'a.tks');
    assert.equal(refused.known, true);
    assert.equal(refused.code, 'io');
    assert.match(refused.message, /a\.tks cannot be read: its server answers, but does not allow/);
    assert.ok(refused.message.includes(`pages of ${new URL(site.url).origin} `), refused.message);
    assert.match(refused.message, /Access-Control-Allow-Origin/);
    const away = await refusal(page, 'http://127.0.0.1:9/a.tks');
    assert.match(away.message, /cannot be fetched: its server cannot be reached/);
  });
  await withPage(open, async (page, server) =>
    assert.equal(await refusal(page, server.url + 'a.tks'), null));
});

test('of another origin, without the headers that only some servers show, all comes', async () => {
  const headers = {'access-control-allow-origin': '*'};
  for (const faults of [{headers}, {headers, noRanges: true}]) {
    await withPage(faults, async (page, server) => {
      const got = await page.evaluate(async (address) => {
        const {open} = await import('/src/index.js');
        const terrain = await open(address), frame = await terrain.decode();
        return {complete: frame.complete, requests: terrain.loaded.requests};
      }, server.url + 'a.tks');
      assert.deepEqual(got, {complete: true, requests: faults.noRanges ? 1 : 2});
    });
  }
});

test('aborting ends the request and what its worker was asked for', async () => {
  const headers = {'access-control-allow-origin': '*'};
  await withPage({headers}, async (page, server) => {
    await page.evaluate(async (address) => {
      const {open} = await import('/src/index.js');
      window.terrain = await open(address);
    }, server.url + 'a.tks');
    server.faults.stall = 100;
    await page.evaluate(() => {
      window.stop = new AbortController();
      window.frame = window.terrain.decode({signal: window.stop.signal})
        .catch((error) => error.name);
    });
    while (server.requests.length < 2) await page.waitForTimeout(10);
    assert.equal(await page.evaluate(() => (window.stop.abort(), window.frame)), 'AbortError');
    assert.equal(await server.requests.at(-1).ended, false);
    server.faults.stall = Infinity;
    // A hundred frames, of which none is wanted any more, do not keep the next one waiting.
    const {one, next} = await page.evaluate(async () => {
      const {terrain} = window, request = {surface: true, normals: true, triangles: 1e5};
      await terrain.decode(request);
      const timed = async () => {
        const begin = performance.now();
        await terrain.decode(request);
        return performance.now() - begin;
      };
      const alone = Math.max(await timed(), await timed());
      const {signal} = (window.stop = new AbortController());
      const frames = Array.from({length: 100}, () => terrain.decode({...request, signal}));
      const ends = Promise.allSettled(frames);
      await Promise.resolve();
      window.stop.abort();
      const after = await timed();
      if ((await ends).some(({status}) => status !== 'rejected')) throw new Error('a frame came');
      return {one: alone, next: after};
    });
    assert.ok(next < 20 * one, `${next} ms, ${one} ms alone`);
  });
});

test('a server that calls modules something else is no trouble', async () => {
  const plain = await serve(web, {types: {'.wasm': 'text/plain'}}), page = await browser.newPage();
  try {
    await page.goto(plain.url + 'test/core.html');
    const heights = await page.evaluate(async () => {
      const {open} = await import('/src/index.js');
      const {encode} = await import('/src/encode.js');
      const data = Uint8Array.from({length: 16}, (_, i) => i);
      const terrain = await open(await encode({heights: {data, width: 4, height: 4}}));
      const {surface} = await terrain.decode({mesh: false, surface: true});
      terrain.dispose();
      return [...surface.data];
    });
    assert.deepEqual(heights, Array.from({length: 16}, (_, i) => i));
  } finally {
    await page.close();
    await plain.close();
  }
});

test('a large texture comes to the graphics card in slices, and looks as one that came at once',
  {timeout: 120000}, async () => {
    await withPage({headers: {'access-control-allow-origin': '*'}}, async (page, server) => {
      const seen = await page.evaluate(async (address) => {
        const {MeshBasicMaterial, OrthographicCamera, Scene, WebGLRenderer} = await import('three');
        const {open} = await import('/src/index.js');
        const {TksTerrain, textureOf} = await import('/src/three.js');
        const side = 2048, data = new Uint8ClampedArray(4 * side * side);
        for (let i = 0; i < side * side; ++i) {
          data.set([(i % side) / 8, Math.floor(i / side) / 8, i % 251, 255], 4 * i);
        }
        const object =
          new TksTerrain(await open(address), {material: new MeshBasicMaterial(), glideTime: 0});
        await object.begin();
        const renderer = new WebGLRenderer({preserveDrawingBuffer: true}), scene = new Scene();
        renderer.setSize(64, 64);
        scene.add(object);
        const camera = new OrthographicCamera(-1500, 1500, 1500, -1500, 1, 1e5);
        object.geometry.computeBoundingBox();
        camera.position.set(0, object.geometry.boundingBox.max.y + 1000, 0);
        camera.up.set(0, 0, -1);
        camera.lookAt(0, 0, 0);
        const drawn = () => {
          object.update(camera, 0);  // fetches nothing for a picture without a height
          renderer.render(scene, camera);
          const gl = renderer.getContext(), pixels = new Uint8Array(4 * 64 * 64);
          gl.readPixels(0, 0, 64, 64, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          return pixels;
        };
        for (let i = 0; i < 3; ++i) drawn();
        const raster = {width: side, height: side, data};
        object.show({info: object.terrain.info, texture: raster});
        const before = object.material.map.image.width;
        let pictures = 0;
        for (; object.material.map.image.width !== side; ++pictures) drawn();
        const last = drawn();
        object.setMap(textureOf(raster));
        const atOnce = drawn();
        return {before, pictures, colours: new Set(new Uint32Array(atOnce.buffer)).size,
          worst: Math.max(...last.map((value, i) => Math.abs(value - atOnce[i])))};
      }, server.url + 'a.tks');
      assert.ok(seen.before <= 128 && seen.pictures >= 8 && seen.colours > 100,
        JSON.stringify(seen));
      assert.ok(seen.worst <= 1, `${seen.worst}`);
    });
  });

test('terrains that are opened and disposed leave nothing', async () => {
  await withPage({headers: {'access-control-allow-origin': '*'}}, async (page, server) => {
    const devtools = await page.context().newCDPSession(page);
    const heap = async () => {
      await devtools.send('HeapProfiler.collectGarbage');
      const {usedSize, backingStorageSize} = await devtools.send('Runtime.getHeapUsage');
      return usedSize + backingStorageSize;
    };
    const opened = (times, options) => page.evaluate(async ([address, count, given]) => {
      const {open} = await import('/src/index.js');
      for (let i = 0; i < count; ++i) {
        const input = i % 2 ? address : await (await fetch(address)).arrayBuffer();
        const terrain = await open(input, given);
        await terrain.decode({normals: true, surface: true});
        terrain.dispose();
        // One that is aborted, and one that is no stream.
        const stop = new AbortController();
        const aborted = open(address, {...given, signal: stop.signal});
        stop.abort();
        await Promise.allSettled([aborted, open(new Uint8Array(100), given)]);
      }
    }, [server.url + 'a.tks', times, options]);
    for (const [count, options] of [[40, {}], [15, {worker: false}]]) {
      await opened(5, options);
      const before = await heap();
      await opened(count, options);
      const growth = await heap() - before;
      // A terrain that stayed would be a megabyte, or the module's memory.
      assert.ok(growth < 250000, `${growth} bytes, ${JSON.stringify(options)}`);
      // Those that still end do so soon; of others this is never told.
      await Promise.all(
        page.workers().map((worker) => worker.waitForEvent('close', {timeout: 5000})));
    }
  });
});
