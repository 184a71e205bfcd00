// SPDX-License-Identifier: Apache-2.0
// The viewer and some streams on a server, and pages of headless Chromium that show them.
import assert from 'node:assert/strict';
import {cp, mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

import {launch} from './chromium.js';
import {serve} from './server.js';

const viewer = new URL('../dist/viewer/', import.meta.url).pathname;
/** Where the middle of what is looked at is drawn, beside the panel. */
export const MIDDLE = {x: 350, y: 300};

/** Waits until all that is wanted is drawn, or the first bytes. */
export async function drawn(page, firstOnly = false) {
  await page.waitForFunction((first) => (first ? document.body.dataset.bytes === '4096'
    : ['done', 'failed'].includes(document.body.dataset.state)), firstOnly);
  assert.notEqual(await page.locator('body').getAttribute('data-state'), 'failed',
    await page.locator('#message').textContent());
  await page.waitForTimeout(300);
}

/** A server of the viewer with files of these names and bytes. */
export async function viewerSite(files) {
  const browser = await launch();
  const folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await cp(viewer, folder, {recursive: true});
  for (const [name, bytes] of Object.entries(files)) await writeFile(join(folder, name), bytes);
  const server = await serve(folder);
  return {
    server,
    /** Opens the viewer and calls `use` once it is drawn, with all bytes or with the first ones. */
    withPage: (query, use, firstOnly = false) => browser.withPage(async (page) => {
      const errors = [];
      page.on('pageerror', (error) => errors.push(error.message));
      if (firstOnly) {
        await page.route(({pathname}) => pathname.endsWith('.tks'), (route) =>
          (route.request().headers().range === 'bytes=0-4095' ? route.continue() : undefined));
      }
      await page.goto(`${server.url}index.html?${query}`);
      await drawn(page, firstOnly);
      await use(page);
      assert.deepEqual(errors, []);
    }),
    async close() {
      await browser.close();
      await server.close();
      await rm(folder, {recursive: true});
    },
  };
}
