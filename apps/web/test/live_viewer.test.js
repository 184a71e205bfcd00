// SPDX-License-Identifier: Apache-2.0
// The viewer in headless Chromium, of what `tetrakis serve` serves: it follows what grows, goes to
// other frames, and tells where its camera is. It needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import {appendFile, mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {launch} from './chromium.js';
import {CLI, sequenceOf} from './sequences.js';
import {controlOf, serveFile} from './transmitter.js';
import {drawn, viewerSite} from './viewer_site.js';

let site, folder, groups;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  const {bytes} = await sequenceOf({heights: 'flood', frames: 12, size: 129}, '--lossless',
    '--index', '--fps', 4, '--group', 1, '--epoch', '2026-03-01T00:00:00Z');
  const all = Buffer.from(bytes);
  const begins = [...all.toString('latin1').matchAll(/TKG\x1a/g)].map(({index}) => index);
  groups = begins.map((begin, i) => all.subarray(begin, begins[i + 1]));
  site = await viewerSite({});
});
after(async () => {
  await site.close();
  await rm(folder, {recursive: true});
});

/** Calls use(page, {append, end, controls}) with the viewer of a server of the first `count`
 * groups; `controls`: what the page tells the server. */
async function watching(count, options, hash, use) {
  const path = join(folder, `live_${Math.random()}.tks`);
  await writeFile(path, Buffer.concat(groups.slice(0, count)));
  const server = await serveFile(path, ...options);
  try {
    await site.withPage(`live=${encodeURIComponent(server.url)}${hash}`, (page) => {
      const controls = [];
      page.on('request', (request) => {
        if (request.method() === 'POST') controls.push(controlOf(request.postDataBuffer()));
      });
      return use(page, {
        append: (from, to) => appendFile(path, Buffer.concat(groups.slice(from, to))),
        end: () => server.end(), controls,
      });
    });
  } finally {
    await server.end();
  }
}
const shows = (page, number) => page.waitForFunction(
  (wanted) => document.body.dataset.frame === wanted, String(number));
const spoken = (page) => page.locator('#frame').getAttribute('aria-valuetext');
const picture = async (page) => (await page.locator('#picture')
  .screenshot({style: 'aside, header, #timeline, #bearings { display: none }'})).toString('base64');

test('the newest frame is followed, as it comes', async () => {
  await watching(3, ['--live'], '', async (page, {append, controls}) => {
    await shows(page, 2);
    assert.equal(await spoken(page), '2026-03-01T00:00:00.500Z, frame 2 of 3');
    assert.equal(await page.locator('#live').getAttribute('aria-pressed'), 'true');
    assert.equal(await page.locator('#play').getAttribute('aria-label'), 'Pause');
    const before = await picture(page);
    for (let frame = 3; frame < 12; ++frame) {
      await append(frame, frame + 1);
      await shows(page, frame);
    }
    assert.equal(await page.locator('#frame').getAttribute('max'), '11');
    await drawn(page);
    assert.match(await page.locator('#rmse').textContent(), /exact/);
    assert.notEqual(await picture(page), before);
    assert.ok(!(await page.evaluate(() => location.hash)).includes('frame='));
    assert.equal(controls.at(-1).frame, -1);
  });
});

test('the server is told what the camera looks at', async () => {
  await watching(12, [], '', async (page, {controls}) => {
    await drawn(page);
    const before = controls.length;
    await page.locator('#picture').focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press('+');
    await page.waitForTimeout(1500);
    const seen = controls.slice(before).filter(({width}) => width > 0);
    assert.ok(seen.length > 0, JSON.stringify(controls.at(-1)));
    assert.equal(seen[0].width, 1000);
  });
});

test('who pauses stays, goes to other frames, and goes back to what is newest', async () => {
  await watching(3, ['--live'], '', async (page, {append, controls}) => {
    await shows(page, 2);
    await page.locator('#play').click();
    await append(3, 9);
    await page.waitForFunction(() => document.getElementById('frame').max === '8');
    await drawn(page);
    assert.match(await spoken(page), /frame 2 of 9/);
    await page.locator('#frame').fill('6');  // has not come yet
    await shows(page, 6);
    await drawn(page);
    assert.match(await page.locator('#rmse').textContent(), /exact/);
    assert.match(await page.evaluate(() => location.hash), /frame=6/);
    assert.equal(controls.at(-1).frame, 6);
    await page.locator('#frame').fill('1');
    await shows(page, 1);
    await page.locator('#live').click();
    await shows(page, 8);
    await append(9, 10);
    await shows(page, 9);
  });
});

test('from an older frame it plays to the end, and follows that', async () => {
  await watching(4, ['--live'], '#frame=1', async (page, {append}) => {
    await shows(page, 1);
    assert.equal(await page.locator('#live').getAttribute('aria-pressed'), 'false');
    await append(4, 6);
    await page.waitForFunction(() => document.getElementById('frame').max === '5');
    await page.locator('#speed').selectOption('4');
    await page.locator('#play').click();
    await shows(page, 5);
    await append(6, 7);
    await shows(page, 6);
    assert.equal(await page.locator('#live').getAttribute('aria-pressed'), 'true');
  });
});

test('a film that is served plays from its begin, and stays when the server ends', async () => {
  await watching(12, [], '', async (page, {end}) => {
    await shows(page, 11);
    await page.locator('#play').click();  // pauses
    await page.locator('#speed').selectOption('4');
    await page.locator('#play').click();
    await shows(page, 0);
    await shows(page, 11);
    await end();
    await page.locator('#frame').fill('10');
    await shows(page, 10);
  });
});

test('where no server is the page says so', async () => {
  const browser = await launch(), nowhere = encodeURIComponent('http://127.0.0.1:1/a');
  try {
    await browser.withPage(async (page) => {
      await page.goto(`${site.server.url}index.html?live=${nowhere}`);
      await page.waitForFunction(() => document.body.dataset.state === 'failed');
      assert.match(await page.locator('#message').textContent(), /cannot be fetched/);
    });
  } finally {
    await browser.close();
  }
});

test('`tetrakis view URL` opens the viewer of what is served there', async () => {
  const url = 'http://127.0.0.1:8000/a b.tks?x=1&y="$(z)';
  const viewing = spawn(CLI, ['view', url, '--no-browser']);
  try {
    const [text] = await once(viewing.stdout, 'data'), address = new URL(String(text).trim());
    assert.equal(address.searchParams.get('live'), url);
    assert.match(String(text), /^[\w.:/?=%-]+\n$/);
    assert.match(await (await fetch(address)).text(), /<title>/);
  } finally {
    viewing.kill();
  }
  const refused = spawn(CLI, ['view', url, '--strict', '--no-browser']);
  assert.deepEqual(await once(refused, 'exit'), [1, null]);
});
