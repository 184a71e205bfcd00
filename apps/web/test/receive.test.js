// SPDX-License-Identifier: Apache-2.0
// Receivers of `tetrakis serve`: files, and files that grow. They need a built `tetrakis`
// (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {appendFile, mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {TksError, receive} from '../src/index.js';
import {HEIGHTS, equal, sequenceOf, using} from './sequences.js';
import {serveFile} from './transmitter.js';

const FRAMES = 24;
let folder, flood, groups;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  flood = await sequenceOf({heights: 'flood', frames: FRAMES, size: 65}, '--lossless', '--fps', 4,
    '--group', 1, '--reference', 'all', '--entry', 6, '--epoch', '2026-03-01T00:00:00Z');
  const all = Buffer.from(flood.bytes);
  const begins = [...all.toString('latin1').matchAll(/TKG\x1a/g)].map(({index}) => index);
  groups = begins.map((begin, i) => all.subarray(begin, begins[i + 1]));
});
after(() => rm(folder, {recursive: true}));

/** Serves a file that begins with so many groups: use({url, path, append(from, to), restart()}). */
async function serving(count, options, use) {
  const path = join(folder, `live_${Math.random()}.tks`);
  await writeFile(path, Buffer.concat(groups.slice(0, count)));
  let server = await serveFile(path, ...options);
  const port = new URL(server.url).port;
  try {
    await use({
      url: server.url, path,
      append: (from, to) => appendFile(path, Buffer.concat(groups.slice(from, to))),
      end: () => server.end(),
      restart: async () => (server = await serveFile(path, ...options, '--port', port)),
    });
  } finally {
    await server.end();
  }
}
const exact = async (reception, frame) => {
  await reception.load(Infinity, {frame});
  const {surface, number, time} = await reception.decode({...HEIGHTS, frame});
  equal(surface, flood.rasters[frame]);
  assert.deepEqual([number, time], [frame, frame]);
};

test('any frame of a file that is served comes, with what it goes on from', async () => {
  await serving(FRAMES, [], ({url}) => using(receive(url), async (flood) => {
    assert.equal(flood.sourceFrames, FRAMES);
    assert.deepEqual(flood.clock,
      {numerator: 1, denominator: 4, epoch: '2026-03-01T00:00:00Z', calendar: ''});
    for (const frame of [23, 9, 0, 10, 17]) await exact(flood, frame);
    assert.equal(await flood.at(flood.times[10]), 10);
    assert.deepEqual(await flood.group(9),
      {firstFrame: 9, endFrame: 10, bytes: (await flood.decode({frame: 9})).info.streamBytes});
    await assert.rejects(flood.decode({frame: FRAMES}), {name: 'TksError', code: 'usage'});
    await assert.rejects(flood.decode({frame: -1}), {code: 'usage'});
    await assert.rejects(flood.decode({component: 0}), {code: 'usage', message: /no `component`/});
  }));
});

test('nothing comes twice', async () => {
  await serving(FRAMES, [], ({url}) => using(receive(url), async (reception) => {
    let bytes = 0;
    const {fetch} = globalThis;
    globalThis.fetch = async (...args) => {
      const answer = await fetch(...args);
      bytes += (await answer.clone().arrayBuffer()).byteLength;
      return answer;
    };
    try {
      for (let frame = 0; frame < FRAMES; ++frame) await exact(reception, frame);
    } finally {
      globalThis.fetch = fetch;
    }
    assert.ok(bytes < flood.bytes.length * 1.1, `${bytes} of ${flood.bytes.length} bytes`);
  }));
});

test('a receiver that joins late follows the newest frame of a file that grows', async () => {
  await serving(8, ['--live'], ({url, append}) => using(receive(url), async (reception) => {
    const shown = [];
    for await (const {number} of reception.newest(HEIGHTS)) {
      if (number === shown.at(-1)) continue;  // more of it came
      shown.push(number);
      if (number === 20) break;
      await append(number + 1, number + 2);
    }
    assert.deepEqual(shown, Array.from({length: 14}, (_, i) => 7 + i));
    await exact(reception, 20);
    await exact(reception, 3);  // from before it joined
  }));
});

test('a server that restarts goes on being received', async () => {
  await serving(8, ['--live'], ({url, append, end, restart}) =>
    using(receive(url), async (reception) => {
      await exact(reception, 7);
      await end();
      await append(8, 12);
      await exact(reception, 7);  // it is here
      await restart();
      while (reception.frames < 12) await reception.changed();
      await exact(reception, 11);
      await exact(reception, 2);
    }));
});

test('a server that ends is told, and what came is still shown', async () => {
  await serving(8, ['--live'], ({url, end}) =>
    using(receive(url, {patience: 300}), async (reception) => {
      await exact(reception, 7);
      await end();
      const following = (async () => {
        for await (const {number} of reception.newest(HEIGHTS)) assert.equal(number, 7);
      })();
      await assert.rejects(following, {name: 'TksError', code: 'io'});
      assert.equal(reception.error.code, 'io');
      equal((await reception.decode(HEIGHTS)).surface, flood.rasters[7]);
      await assert.rejects(reception.decode({frame: 0}), {code: 'io'});
    }));
});

test('a thin link brings rough frames, which get better', async () => {
  await serving(FRAMES, [], ({url}) => using(receive(url, {link: 400}), async (reception) => {
    const bytes = [];
    for await (const {info} of reception.refine({...HEIGHTS, frame: 23})) {
      bytes.push(info.availableBytes);
    }
    assert.ok(bytes.length > 1, bytes.join());
    assert.ok(bytes.every((count, i) => i === 0 || count > bytes[i - 1]), bytes.join());
    await exact(reception, 23);
  }));
});

test('what is no server of sequences is refused', async () => {
  await serving(8, ['--live'], async ({url, end}) => {
    await assert.rejects(receive(`${url}x`), ({message, code}) =>
      code === 'io' && /answered 404/.test(message));
    await end();
    await assert.rejects(receive(url), ({message, code}) =>
      code === 'io' && /cannot be fetched|broke/.test(message));
  });
  await assert.rejects(receive('frames.tks'), /is no address/);
  for (const wrong of [{link: 0}, {triangles: -1}, {frame: 1.5}, {keep: -1}, {view: {clip: []}}]) {
    await assert.rejects(receive('http://127.0.0.1:1/a', wrong), {code: 'usage'});
  }
});

test('calls end when their signal aborts, and when the reception is disposed', async () => {
  await serving(0, ['--live'], async ({url, append}) => {
    await assert.rejects(receive(url, {signal: AbortSignal.timeout(200)}), {name: 'TimeoutError'});
    const opening = receive(url);
    await append(0, 8);
    const reception = await opening, stop = new AbortController();
    await exact(reception, 7);
    const waiting = reception.changed({signal: stop.signal});
    stop.abort(new Error('enough'));
    await assert.rejects(waiting, /enough/);
    const next = reception.newest(HEIGHTS);
    await next.next();
    const later = next.next();
    reception.dispose();
    await assert.rejects(later, TksError);
    await assert.rejects(reception.decode(HEIGHTS), /disposed/);
  });
});
