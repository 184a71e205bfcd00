// SPDX-License-Identifier: Apache-2.0
// Frames that play with a renderer of three.js in headless Chromium: large textures come in slices,
// into two textures that take turns. It needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {mkdir, rm, writeFile} from 'node:fs/promises';
import {test} from 'node:test';

import {launch} from './chromium.js';
import {sequenceOf} from './sequences.js';
import {serve} from './server.js';

const web = new URL('..', import.meta.url).pathname, folder = `${web}dist/frames-test/`;
/** Bytes that a picture has time for. */
const SLICE = 2 ** 21;

test('large textures of frames come in slices, into two textures', async () => {
  const {bytes} = await sequenceOf({texture: 'clouds', frames: 4, size: 600}, '--bytes', '400k');
  await mkdir(folder, {recursive: true});
  await writeFile(`${folder}pictures.tks`, bytes);
  const server = await serve(web), browser = await launch();
  try {
    await browser.withPage(async (page) => {
      const errors = [];
      page.on('pageerror', (error) => errors.push(error.message));
      await page.goto(`${server.url}test/frames.html`);
      await page.waitForFunction(() => document.body.dataset.state === 'ready');
      for (const number of [1, 2, 0, 3, 1]) {
        const {pictures, worst, textures} = await page.evaluate((n) => window.play(n), number);
        assert.ok(pictures >= (4 * 1198 ** 2) / SLICE, `${pictures} pictures`);
        assert.equal(worst, 0, `frame ${number}`);
        assert.ok(textures <= 3, `${textures} textures`);  // the first frame had one of its own
      }
      assert.deepEqual(errors, []);
    });
  } finally {
    await browser.close();
    await server.close();
    await rm(folder, {recursive: true});
  }
});
