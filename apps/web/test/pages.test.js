// SPDX-License-Identifier: Apache-2.0
// Mosaics with an index in pages: a view and a window take those that tell of them.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {open} from '../src/index.js';
import {serve} from './server.js';

const CLI = process.env.TETRAKIS ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const SIDE = 1000;
let folder, bytes;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  const heights = Int16Array.from({length: SIDE * SIDE}, (_, i) => {
    const x = i % SIDE, y = Math.floor(i / SIDE);
    const noise = 60 * Math.sin(x * y / 90) + (x * 7919 + y * 104729) % 13;
    return 900 * Math.sin(x / 40) * Math.cos(y / 33) + noise;
  });
  await writeFile(join(folder, 'a.raw'), heights);
  execFileSync(CLI, ['mosaic', 'join', `${folder}/a.raw:${SIDE}x${SIDE}:i16`, '--lossless', '-q',
    '--regions', '16', '--tile', '256', '-o', join(folder, 'a.tks')]);
  bytes = await readFile(join(folder, 'a.tks'));
});
after(() => rm(folder, {recursive: true}));

/** A map of a square of samples, so many pixels wide. */
function mapOf(x, y, side, pixels) {
  const k = 2 / side;
  return {clip: [k, 0, 0, -k * x - 1, 0, -k, 0, k * y + 1, 0, 0, 0, 0, 0, 0, 0, 1],
    width: pixels, height: pixels};
}

async function served(faults, use, name = 'a.tks') {
  const server = await serve(folder, faults);
  try {
    const terrain = await open(server.url + name, {requestBytes: 2000});
    await use(terrain, server);
    terrain.dispose();
  } finally {
    await server.close();
  }
}

test('a view takes the pages that tell of it, and their packets', async () => {
  await served({}, async (terrain) => {
    const {info} = terrain;
    assert.ok(info.indexBytes > 1000 && info.hasIndex);
    assert.equal(info.streamBytes + info.indexBytes, bytes.length);
    await terrain.decode({view: mapOf(700, 650, 60, 600), mesh: false});
    const {loaded} = terrain;
    assert.ok(loaded.bytes < 0.5 * bytes.length, `${loaded.bytes} of ${bytes.length}`);
    assert.ok(loaded.ranges.at(-1)[1] <= info.streamBytes);
    const last = await terrain.decode({mesh: false});
    assert.equal(last.complete, true);
    assert.equal(last.bytes, info.streamBytes);
    const whole = await (await open(bytes)).decode({mesh: false});
    assert.deepEqual(last.surface, whole.surface);
  });
});

test('needed() fetches the pages of a window', async () => {
  await served({}, async (terrain, server) => {
    const window = {x: 500, y: 400, width: 40, height: 30};
    const before = server.requests.length;
    const needed = await terrain.needed({window});
    assert.ok(server.requests.length > before);
    const size = needed.reduce((sum, [b, e]) => sum + e - b, 0);
    assert.ok(needed.every(([b, e]) => b < e && e <= terrain.info.streamBytes));
    assert.ok(size > 0 && size < bytes.length / 4, `${size} of ${bytes.length}`);
    const again = server.requests.length;
    assert.deepEqual(await terrain.needed({window}), needed);
    assert.equal(server.requests.length, again);
  });
});

test('without ranges, or without its pages, a file is read from its beginning', async () => {
  const view = mapOf(700, 650, 60, 600);
  await served({noRanges: true}, async (terrain) => {
    const frame = await terrain.decode({view, mesh: false});
    assert.equal(frame.complete, true);
  });
  await writeFile(join(folder, 'cut.tks'), bytes.subarray(0, bytes.length - 1));
  await served({}, async (terrain) => {
    const {headerBytes, streamBytes} = terrain.info;
    assert.deepEqual(await terrain.needed({window: {x: 0, y: 0, width: 9, height: 9}}),
      [[headerBytes, streamBytes]]);
    assert.equal((await terrain.decode({view, mesh: false})).complete, true);
  }, 'cut.tks');
});
