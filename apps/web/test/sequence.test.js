// SPDX-License-Identifier: Apache-2.0
// Sequences, and streams of several frames: which frames come, of how many requests, in how much
// memory. It needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {startDecoder} from '../src/decoders.js';
import {open, openLive} from '../src/index.js';
import {Sequence} from '../src/sequence.js';
import {sourceOf} from '../src/source.js';
import {HEIGHTS, countingMemory, equal, sequenceOf, using} from './sequences.js';
import {serve} from './server.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);
let folder, site, whole, rasters, many, large;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  const lossless = ['--lossless', '--every', 1.5, '--epoch', '2026-03-01T00:00:00Z'];
  ({bytes: whole, rasters} =
    await sequenceOf({heights: 'flood', frames: 10, size: 65}, ...lossless, '--group', 4));
  // Groups whose tail leads to all of them through further indices.
  many = await sequenceOf({heights: 'erosion', frames: 90, size: 64}, '--lossless', '--group', 1);
  // Groups that are longer than the tail.
  large = await sequenceOf({texture: 'clouds', frames: 9, size: 128}, '--lossless', '--group', 3);
  const files = {whole, many: many.bytes, large: large.bytes};
  for (const [name, bytes] of Object.entries(files)) {
    await writeFile(join(folder, `${name}.tks`), bytes);
  }
  site = await serve(folder);
});
after(async () => {
  await site.close();
  await rm(folder, {recursive: true});
});

const isUsage = {code: 'usage'};

test('every frame is that of its file, of bytes, a Blob and a URL alike', async () => {
  for (const input of [whole, new Blob([whole]), `${site.url}whole.tks`]) {
    await using(open(input), async (sequence) => {
      assert.ok(sequence.isSequence);
      assert.deepEqual([sequence.firstFrame, sequence.frames], [0, 10]);
      assert.deepEqual(sequence.clock,
        {numerator: 3, denominator: 2, epoch: '2026-03-01T00:00:00Z', calendar: ''});
      for (const number of [0, 1, 9, 4, 5, 3]) {
        const frame = await sequence.decode({...HEIGHTS, frame: number});
        equal(frame.surface, rasters[number]);
        assert.deepEqual([frame.number, frame.time, frame.complete], [number, number, true]);
        assert.equal(sequence.times[number], number);
      }
    });
  }
});

test('a frame that is left out is the first; one that is not there is refused', async () => {
  await using(open(whole), async (sequence) => {
    equal((await sequence.decode(HEIGHTS)).surface, rasters[0]);
    for (const frame of [-1, 10, 1.5, '2', NaN]) {
      await assert.rejects(sequence.decode({frame}), isUsage);
      await assert.rejects(sequence.load(100, {frame}), isUsage);
    }
  });
});

test('frames refine from the first bytes of their group', async () => {
  await using(open(`${site.url}large.tks`), async (sequence) => {
    const steps = [];
    for await (const frame of sequence.refine({frame: 4})) {
      steps.push(frame.bytes);
      assert.equal(frame.number, 4);
    }
    assert.ok(steps[0] < 8192 && steps.length > 1, steps.join());
    assert.equal(steps.at(-1), sequence.info.streamBytes);
    assert.equal(sequence.info.streamBytes, (await sequence.group(4)).bytes);
  });
});

test('any frame and any time takes two requests behind the two of opening, at most', async () => {
  assert.ok(many.bytes.length > 2 ** 17, 'indices are behind the tail');
  for (const number of [0, 1, 2, 30, 31, 32, 62, 63, 64, 77, 89]) {
    site.begin();
    await using(open(`${site.url}many.tks`), async (sequence) => {
      assert.equal(sequence.frames, 90);
      assert.ok(site.requests.length <= 2);
      const opened = site.requests.length;
      assert.equal(await sequence.at(number + 0.5), number);
      assert.ok(site.requests.length - opened <= 2, `at(): frame ${number}`);
    });
    site.begin();
    await using(open(`${site.url}many.tks`), async (sequence) => {
      equal((await sequence.decode({...HEIGHTS, frame: number})).surface, many.rasters[number]);
      assert.ok(site.requests.length <= 4, `frame ${number}: ${site.requests.length} requests`);
      assert.equal(sequence.loaded.requests, site.requests.length);
    });
  }
});

test('who goes on from group to group asks twice for each, at most', async () => {
  await using(open(`${site.url}large.tks`), async (sequence) => {
    for (let frame = 0; frame < 3; ++frame) await sequence.decode({frame});
    site.begin();
    for (let frame = 3; frame < 6; ++frame) await sequence.decode({frame});
    assert.ok(site.requests.length <= 2, `${site.requests.length}`);
  });
});

test('times before the first frame and behind the last are those', async () => {
  await using(open(whole), async (sequence) => {
    const asked = [-Infinity, -1, 0, 0.9, 1, 3.5, 4, 8.99, 9, 1e9, Infinity];
    const found = [];
    for (const time of asked) found.push(await sequence.at(time));
    assert.deepEqual(found, [0, 0, 0, 0, 1, 3, 4, 8, 9, 9, 9]);
    await assert.rejects(sequence.at(NaN), isUsage);
  });
});

test('more groups at once than are held', async () => {
  await using(open(whole), async (sequence) => {
    const numbers = [0, 9, 5, 1, 8, 4, 2, 6];
    const frames = await Promise.all(
      numbers.map((frame) => sequence.decode({...HEIGHTS, frame})));
    frames.forEach(({surface}, i) => equal(surface, rasters[numbers[i]]));
  });
});

test('with one decoder groups take turns', async () => {
  const alone = new Sequence(sourceOf(whole), startDecoder(), {another: () => null});
  await alone.begin(whole.slice(0, 4096));
  await using(alone, async (sequence) => {
    const numbers = [9, 0, 5, 8];
    const frames = await Promise.all(
      numbers.map((frame) => sequence.decode({...HEIGHTS, frame})));
    frames.forEach(({surface}, i) => equal(surface, rasters[numbers[i]]));
  });
});

test('a group that is given up for others says so to who refines it, and comes again', async () => {
  await using(open(`${site.url}large.tks`), async (sequence) => {
    const refining = sequence.refine({frame: 0});
    assert.equal((await refining.next()).value.complete, false);
    for (const frame of [3, 6]) await sequence.decode({frame});
    await assert.rejects(refining.next(), isUsage);
    assert.ok((await sequence.decode({frame: 0})).complete);
  });
});

test('who waits for a group that another one has stopped asking for gets it', async () => {
  await using(open(`${site.url}large.tks`), async (sequence) => {
    const stop = new AbortController();
    const first = sequence.decode({frame: 4, signal: stop.signal});
    const second = sequence.decode({frame: 5});
    stop.abort();
    await assert.rejects(first, {name: 'AbortError'});
    assert.equal((await second).number, 5);
  });
});

test('an aborted frame says why, and others come', async () => {
  await using(open(`${site.url}large.tks`), async (sequence) => {
    const stop = new AbortController(), reason = new Error('enough');
    const asked = sequence.decode({frame: 5, signal: stop.signal});
    stop.abort(reason);
    await assert.rejects(asked, reason);
    assert.equal((await sequence.decode({frame: 5})).number, 5);
  });
});

test('a sequence that is cut ends with the last group whose header is there', async () => {
  const last = Buffer.from(large.bytes).lastIndexOf('TKG\x1a');
  assert.ok(large.bytes.length - last > 2 ** 17, 'the tail has no index');
  for (const [end, frames] of [[last + 70000, 9], [last + 2000, 9], [last + 20, 6], [last, 6]]) {
    await writeFile(join(folder, 'cut.tks'), large.bytes.subarray(0, end));
    for (const input of [large.bytes.subarray(0, end), `${site.url}cut.tks`]) {
      await using(open(input), async (sequence) => {
        assert.equal(sequence.frames, frames);
        const frame = await sequence.decode({frame: frames - 1});
        assert.equal(frame.complete, frames === 6);
        assert.equal(sequence.truncated, frames === 9);
      });
    }
  }
});

test('of a server without ranges one request brings all', async () => {
  site.begin({noRanges: true});
  await using(open(`${site.url}whole.tks`), async (sequence) => {
    for (const number of [8, 0]) {
      equal((await sequence.decode({...HEIGHTS, frame: number})).surface, rasters[number]);
    }
    assert.equal(site.requests.length, 1);
    assert.equal(sequence.loaded.requests, 1);
  });
  site.begin();
});

test('a live sequence grows by any pieces; what is forgotten is gone', async () => {
  await using(openLive(), async (sequence) => {
    await assert.rejects(sequence.decode(), isUsage);
    await assert.rejects(sequence.at(0), isUsage);
    const seen = new Set();
    let place = 0;
    for (let size = 1; place < whole.length; size = (7 * size + 1) % 401) {
      const frames = await sequence.append(whole.subarray(place, place + size));
      place += size;
      assert.ok(frames >= Math.max(0, ...seen));
      if (seen.has(frames) || frames === 0) continue;
      seen.add(frames);
      assert.equal((await sequence.decode({...HEIGHTS, frame: frames - 1})).number, frames - 1);
    }
    assert.deepEqual([...seen], [4, 8, 10]);
    for (let frame = 0; frame < 10; ++frame) {
      equal((await sequence.decode({...HEIGHTS, frame})).surface, rasters[frame]);
    }
    sequence.forget(9);
    assert.deepEqual([sequence.firstFrame, sequence.frames], [8, 10]);
    assert.deepEqual(Object.keys(sequence.times), ['8', '9']);
    await assert.rejects(sequence.decode({frame: 7}), isUsage);
    equal((await sequence.decode(HEIGHTS)).surface, rasters[8]);
  });
});

test('what does not follow is refused, and what was there stays', async () => {
  const behind = async (bytes) => using(openLive(), async (sequence) => {
    await sequence.append(whole);
    await assert.rejects(sequence.append(bytes), {code: 'corrupt'});
    equal((await sequence.decode({...HEIGHTS, frame: 9})).surface, rasters[9]);
    await assert.rejects(sequence.append(bytes), {code: 'corrupt'});
  });
  await behind(whole);
  await behind(new TextEncoder().encode('no group'));
  const damaged = whole.slice();
  damaged[9] ^= 1;
  await assert.rejects(open(damaged), {code: 'corrupt'});
  await assert.rejects(open(whole.subarray(0, 30)), {code: 'truncated'});
  await using(open(whole), (sequence) =>
    assert.rejects(sequence.append(whole), isUsage));
});

test('memory stays where it was while groups follow each other', () =>
  countingMemory(({modules, size}) =>
    using(open(many.bytes, {worker: false}), async (sequence) => {
      const play = async (from, to) => {
        for (let frame = from; frame < to; ++frame) await sequence.decode({...HEIGHTS, frame});
      };
      await play(0, 10);
      const before = size();
      await play(10, 90);
      assert.equal(modules(), 2);
      assert.equal(size(), before);
    })));

test('a stream of several frames shows any of them', async () => {
  const bytes = await readFile(new URL('frames_joint_30x30_40x40.tks', vectors));
  await using(open(bytes), async (terrain) => {
    assert.equal(terrain.isSequence, false);
    const {frames} = terrain, seen = new Set();
    assert.ok(frames > 1);
    assert.deepEqual(terrain.times, Array.from({length: frames}, (_, i) => i));
    for (let number = 0; number < frames; ++number) {
      const frame = await terrain.decode({frame: number, surface: true});
      assert.deepEqual([frame.number, frame.time, frame.info.frame], [number, number, number]);
      seen.add(String(frame.surface.data));
      assert.equal(await terrain.at(number + 0.9), number);
    }
    assert.equal(seen.size, frames);
    for await (const frame of terrain.refine({frame: 1})) assert.equal(frame.number, 1);
    assert.deepEqual([await terrain.at(-5), await terrain.at(1e9)], [0, frames - 1]);
    await assert.rejects(terrain.decode({frame: frames}), isUsage);
  });
});

test('normals of a grid are those of its slopes', async () => {
  await using(open(whole), async (sequence) => {
    const {surface} = await sequence.decode({...HEIGHTS, normals: true, texture: false});
    const {data, normals, width} = surface, x = 20, y = 30, i = y * width + x;
    const across = (data[i + 1] - data[i - 1]) / (2 * surface.spacingX);
    const down = (data[i + width] - data[i - width]) / (2 * surface.spacingY);
    const length = Math.hypot(across, 1, down);
    [-across / length, 1 / length, -down / length].forEach((part, k) =>
      assert.ok(Math.abs(part - normals[3 * i + k]) < 1e-5));
    assert.equal(normals.length, 3 * data.length);
  });
});
