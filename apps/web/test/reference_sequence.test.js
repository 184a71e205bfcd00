// SPDX-License-Identifier: Apache-2.0
// Sequences whose groups go on from the one before: every frame is that of its file, however it is
// come to, and where groups are gone the library's sentence says so. It needs a built `tetrakis`
// (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {startDecoder} from '../src/decoders.js';
import {open, openLive} from '../src/index.js';
import {Sequence} from '../src/sequence.js';
import {sourceOf} from '../src/source.js';
import {Player} from '../viewer/player.js';
import {HEIGHTS, countingMemory, equal, sequenceOf, using} from './sequences.js';
import {serve} from './server.js';

/** Groups of three frames; every fourth one stands by itself. */
const FRAMES = 26, GROUP = 3, ENTRY = 4;
let folder, site, bytes, rasters, places, clouds;

const isLost = {code: 'truncated', message: /^Group \d+ of the sequence goes on from group \d+,/};

before(async () => {
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  const going = ['--lossless', '--reference', 'all', '--entry', ENTRY, '--group', GROUP];
  ({bytes, rasters} =
    await sequenceOf({heights: 'erosion', frames: FRAMES, size: 97}, ...going));
  clouds = (await sequenceOf({texture: 'clouds', frames: 12, size: 128}, ...going)).bytes;
  places = [];  // where groups begin, and the end
  const file = Buffer.from(bytes);
  for (let at = 0; at >= 0; at = file.indexOf('TKG\x1a', at + 1)) places.push(at);
  places.push(bytes.length);
  assert.equal(places.length, 1 + Math.ceil(FRAMES / GROUP));
  await writeFile(join(folder, 'file.tks'), bytes);
  site = await serve(folder);
});
after(async () => {
  await site.close();
  await rm(folder, {recursive: true});
});

const frameOf = async (sequence, frame) =>
  equal((await sequence.decode({...HEIGHTS, frame})).surface, rasters[frame]);
/** Frames [from, to), one after another, as a player asks for them. */
async function play(sequence, from, to) {
  for (let frame = from; frame < to; ++frame) {
    const next = frame + GROUP;
    const ahead = frame % GROUP === 0 && next < to && sequence.decode({...HEIGHTS, frame: next});
    await frameOf(sequence, frame);
    await ahead;
  }
}
const withoutGroups = (...numbers) => Buffer.concat(places.slice(0, -1)
  .map((begin, i) => (numbers.includes(i) ? Buffer.of() : bytes.subarray(begin, places[i + 1]))));

test('every frame is that of its file, there and back and anywhere', async () => {
  for (const input of [bytes, new Blob([bytes]), `${site.url}file.tks`]) {
    await using(open(input), async (sequence) => {
      for (const frame of [25, 11, 4, 13, 0, 10]) await frameOf(sequence, frame);
      await play(sequence, 0, FRAMES);
      for (let frame = FRAMES - 1; frame >= 0; frame -= 2) await frameOf(sequence, frame);
    });
  }
});

test('with one decoder, and with more groups at once than are held', async () => {
  const alone = new Sequence(sourceOf(bytes), startDecoder(), {another: () => null});
  await alone.begin(bytes.slice(0, 4096));
  for (const opening of [alone, open(bytes), open(`${site.url}file.tks`)]) {
    await using(opening, (sequence) =>
      Promise.all([9, 25, 5, 1, 22, 8, 4, 17].map((frame) => frameOf(sequence, frame))));
  }
});

test('fewer bytes than before show what they do of a texture in any case', async () => {
  const decode = (sequence, options) => sequence.decode({frame: 11, mesh: false, ...options});
  await using(open(clouds), async (sequence) => {
    const whole = await decode(sequence), few = await decode(sequence, {bytes: 3000});
    assert.ok(whole.complete && !few.complete);
    await using(open(clouds), async (fresh) =>
      assert.deepEqual((await decode(fresh, {bytes: 3000})).texture, few.texture));
    assert.notDeepEqual(few.texture, whole.texture);
    assert.deepEqual((await decode(sequence)).texture, whole.texture);
    const steps = [];
    for await (const frame of sequence.refine({frame: 5})) steps.push(frame.bytes);
    assert.equal(steps.at(-1), sequence.info.streamBytes);
  });
});

test('who plays asks for no bytes twice, but for those of the first group', async () => {
  site.begin();
  await using(open(`${site.url}file.tks`), async (sequence) => {
    await play(sequence, 0, FRAMES);
    const ranges = site.requests.map(({range}) => range.match(/\d+/g).map(Number));
    const asked = ranges.reduce((sum, [begin, end]) =>
      sum + Math.min(end + 1, bytes.length) - begin, 0);
    const known = 4096 + 2 ** 16 + places[1];  // what opening asks for
    assert.ok(asked <= bytes.length + known, `${asked} of ${bytes.length}`);
    assert.ok(ranges.length <= 4 + 2 * places.length, `${ranges.length} requests`);
  });
});

test('any frame takes one request more than those of other sequences', async () => {
  for (const frame of [5, 11, 14, 23]) {
    site.begin();
    await using(open(`${site.url}file.tks`), async (sequence) => {
      await frameOf(sequence, frame);
      assert.ok(site.requests.length <= 5, `frame ${frame}: ${site.requests.length} requests`);
    });
  }
});

test('a live sequence keeps what its frames go on from, and forgets the rest', async () => {
  await using(openLive(), async (live) => {
    for (let place = 0; place < bytes.length; place += 1777) {
      const frames = await live.append(bytes.subarray(place, place + 1777));
      if (frames === 0) continue;
      live.forget(frames - 1);
      assert.ok(frames - live.firstFrame <= GROUP * ENTRY);
      const {number, complete, surface} = await live.decode({...HEIGHTS, frame: frames - 1});
      assert.equal(number, frames - 1);
      if (complete) equal(surface, rasters[number]);
    }
    assert.equal(live.frames, FRAMES);
  });
});

test('a receiver that joins late says what is gone, and shows the next entry', async () => {
  const late = bytes.subarray(places[1]);
  await using(openLive(), async (live) => {
    assert.equal(await live.append(late), FRAMES);
    assert.equal(live.firstFrame, GROUP);
    for (const frame of [3, 8, 11]) await assert.rejects(live.decode({frame}), isLost);
    await play(live, ENTRY * GROUP, FRAMES);
  });
  await using(open(late), async (sequence) => {
    await assert.rejects(sequence.decode({frame: 3}), isLost);
    await frameOf(sequence, ENTRY * GROUP);
  });
});

test('behind a group that was lost the next entry is right', async () => {
  for (const lost of [1, 2, 5]) {
    await using(openLive(), async (live) => {
      await live.append(withoutGroups(lost));
      const entry = lost - lost % ENTRY;
      for (let group = 0; group < 9; ++group) {
        const frame = GROUP * group, isGone = group > lost && group < entry + ENTRY;
        if (isGone) await assert.rejects(live.decode({frame}), isLost);
        else if (group !== lost) await frameOf(live, frame);
      }
    });
  }
});

test('a head that states another way back is refused', async () => {
  await using(openLive(), async (live) => {
    await live.append(bytes.subarray(0, places[2]));
    const other = withoutGroups(0, 1, 2, 3, 4, 5);  // of the depth 2
    await live.append(other);
    await assert.rejects(live.decode({frame: 3 * GROUP * 2}), isLost);
  });
  const lossy = (await sequenceOf({heights: 'erosion', frames: 6, size: 97}, '--group', GROUP,
    '--reference', 'all', '--max-error', 1)).bytes;
  const second = Buffer.from(lossy).lastIndexOf('TKG\x1a');
  await using(openLive(), async (live) => {
    await live.append(bytes.subarray(0, places[1]));
    await assert.rejects(live.append(lossy.subarray(second)), {code: 'corrupt'});
  });
});

test('playing passes over groups that do not decode', async () => {
  await using(open(bytes.subarray(places[2])), async (sequence) => {
    const shown = [];
    await new Promise((resolve, reject) => {
      const player = new Player({
        decode: ({frame, signal}) => sequence.decode({...HEIGHTS, frame, signal}),
        show: ({number}) => shown.push(number), fail: reject, onend: resolve,
      });
      [player.loops, player.speed] = [false, 1000];
      player.begin(sequence, 2 * GROUP);
      player.play();
    });
    const first = ENTRY * GROUP;
    assert.deepEqual(shown, Array.from({length: FRAMES - first}, (_, i) => first + i));
  });
});

test('memory stays where it was from entry to entry', () =>
  countingMemory(({modules, size}) =>
    using(open(bytes, {worker: false}), async (sequence) => {
      await play(sequence, 0, 2 * ENTRY * GROUP);
      const before = size();
      for (let i = 0; i < 4; ++i) await play(sequence, 0, 2 * ENTRY * GROUP);
      assert.equal(modules(), 2);
      assert.equal(size(), before);
    })));
