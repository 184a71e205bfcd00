// SPDX-License-Identifier: Apache-2.0
// The adapter of MapLibre on a map, in headless Chromium: terrain and picture, refined.
import assert from 'node:assert/strict';
import {cp, rm} from 'node:fs/promises';
import {test} from 'node:test';
import {chromium} from 'playwright-core';

import {serve} from './server.js';

const web = new URL('..', import.meta.url).pathname;
const vectors = new URL('../../../conformance/vectors/', import.meta.url).pathname;
const STREAM = 'dist/map-test.tks';

test('a map drapes the picture over the terrain and refines both', async () => {
  await cp(vectors + 'regions_joint_index_40x33_50x47.tks', web + STREAM);
  const server = await serve(web);
  const browser = await chromium.launch(
    {executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
  try {
    const page = await browser.newPage();
    const errors = [];
    page.on('pageerror', (error) => errors.push(error.message));
    await page.goto(`${server.url}test/map.html?tks=/${STREAM}`);
    await page.waitForFunction(() => document.body.dataset.state === 'done', null, {timeout: 60000})
      .catch((error) => assert.fail(`${error.message} ${errors}`));
    const {first, last, wanted, failure} = await page.evaluate(() =>
      ({first: window.first, last: window.last, wanted: window.wanted, failure: window.failure}));
    assert.equal(failure, undefined);
    assert.deepEqual(errors, []);
    assert.ok(last.bytes > first.bytes);
    const requests = server.requests.filter(({path}) => path.endsWith('.tks'));
    assert.deepEqual(requests.map(({range}) => range),
      ['bytes=0-4095', `bytes=4096-${last.bytes - 1}`]);
    // The slopes here are of hundreds of metres from one pixel of a tile to the next.
    assert.ok(Math.abs(last.height - wanted) < 100, `${last.height} is not ${wanted}`);
  } finally {
    await browser.close();
    await server.close();
    await rm(web + STREAM);
  }
});
