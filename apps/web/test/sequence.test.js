// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';
import {open} from '../src/index.js';
test('x', async () => {
  const s = await open(await readFile('/tmp/seq/flood.tks'));
  console.log(s.frames, s.clock, s.times, s.loaded);
  const t = performance.now();
  for (const frame of [0, 1, 2, 9, 31, 4]) {
    const b = performance.now();
    const f = await s.decode({frame, mesh: false, surface: true});
    console.log(f.number, f.time, f.bytes, f.complete, f.surface.data.length, performance.now() - b);
  }
  s.dispose();
});
