// SPDX-License-Identifier: Apache-2.0
// The viewer's timeline in headless Chromium: sequences play, are sought, and refine where they
// rest. It needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {frameTime, rateOf} from '../viewer/frame_time.js';
import {CLI, sequenceOf} from './sequences.js';
import {drawn, viewerSite} from './viewer_site.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);
let site, flood, clouds;

before(async () => {
  const frames = {heights: 'flood', frames: 12, size: 65};
  const options = ['--lossless', '--fps', 4, '--epoch', '2026-03-01T00:00:00Z'];
  ({bytes: flood} = await sequenceOf(frames, ...options, '--group', 4));
  const {bytes: going} =
    await sequenceOf(frames, ...options, '--group', 2, '--reference', 'all', '--entry', 3);
  const late = going.subarray(Buffer.from(going).indexOf('TKG\x1a', 1));
  ({bytes: clouds} = await sequenceOf({texture: 'clouds', frames: 4, size: 64},
    '--bytes', '40k', '--group', 2));
  const single = await readFile(new URL('frames_joint_30x30_40x40.tks', vectors));
  site = await viewerSite({'flood.tks': flood, 'going.tks': going, 'late.tks': late,
    'clouds.tks': clouds, 'single.tks': single});
});
after(() => site.close());

const value = (page, selector, name) => page.locator(selector).getAttribute(name);
const spoken = (page) => value(page, '#frame', 'aria-valuetext');
const shows = (page, number) => page.waitForFunction(
  (wanted) => document.body.dataset.frame === wanted, String(number));
/** Numbers of frames as they are shown, from now on. */
async function shown(page) {
  await page.evaluate(() => {
    window.shown = [];
    new MutationObserver(() => {
      const number = Number(document.body.dataset.frame);
      if (number !== window.shown.at(-1)) window.shown.push(number);  // not where it is refined
    }).observe(document.body, {attributeFilter: ['data-frame']});
  });
  return () => page.evaluate(() => window.shown);
}
/** The picture without what lies over it. */
const picture = async (page) => (await page.locator('#picture')
  .screenshot({style: 'aside, header, #timeline, #bearings { display: none }'})).toString('base64');

test('a time in words', () => {
  const clock = {numerator: 1, denominator: 4, epoch: '', calendar: ''};
  const since = (epoch, calendar = '') => frameTime({...clock, epoch, calendar}, 6, 6);
  assert.equal(since('2026-02-28T23:59:59Z'), '2026-03-01T00:00:00.500Z');
  assert.equal(since('2026-02-28T23:59:58.5+01:00'), '2026-02-28T23:00:00Z');
  assert.equal(since('1900-01-01 00:00'), '1900-01-01T00:00:01.500Z');
  assert.equal(since('2001-01-01'), '2001-01-01T00:00:01.500Z');
  assert.equal(since('2001-01-01', 'noleap'), '1.5 s since 2001-01-01');
  assert.equal(since('long ago'), '1.5 s since long ago');
  assert.equal(since(''), '1.5 s');
  assert.deepEqual([frameTime(null, 6, 6), frameTime(null, 7, 6), frameTime(clock, undefined, 6)],
    ['frame 6', 'tick 7', 'frame 6']);
});

test('frames a second are those of the clock, where they can be watched', () => {
  const every = (numerator, denominator) => ({numerator, denominator});
  assert.equal(rateOf(every(1, 25), 10, 11), 25);
  assert.equal(rateOf(every(1, 1000), 0, 40), 25);
  for (const clock of [null, every(3600, 1), every(1, 1000)]) {
    assert.equal(rateOf(clock, 0, 1), 5);
  }
});

test('a sequence shows its first frame, and says when that is', async () => {
  await site.withPage('tks=flood.tks', async (page) => {
    assert.equal(await spoken(page), '2026-03-01T00:00:00Z, frame 0 of 12');
    assert.equal(await page.locator('#frame-value').textContent(), '2026-03-01T00:00:00Z');
    assert.deepEqual([await value(page, '#frame', 'min'), await value(page, '#frame', 'max')],
      ['0', '11']);
    assert.match(await page.locator('#rmse').textContent(), /exact/);
  });
});

test('the bar goes to a frame, which is refined, and which the address keeps', async () => {
  await site.withPage('tks=flood.tks', async (page) => {
    const before = await picture(page);
    await page.locator('#frame').fill('10');
    await shows(page, 10);
    await drawn(page);
    assert.equal(await spoken(page), '2026-03-01T00:00:02.500Z, frame 10 of 12');
    assert.notEqual(await picture(page), before);
    assert.match(page.url(), /#frame=10$/);
    assert.ok(await page.evaluate(() => document.body.dataset.bytes > 0));
    // A copy of the address shows the same, and so does going to it.
    await page.goto('about:blank');
    await page.goto(`${site.server.url}index.html?tks=flood.tks#frame=10`);
    await drawn(page);
    assert.equal(await spoken(page), '2026-03-01T00:00:02.500Z, frame 10 of 12');
    await page.evaluate(() => (location.hash = '#frame=3'));
    await shows(page, 3);
    await drawn(page);
    assert.equal(await value(page, '#frame', 'aria-valuetext'),
      '2026-03-01T00:00:00.750Z, frame 3 of 12');
  });
});

test('frames play one after the other, round and round, faster where it is asked for', async () => {
  await site.withPage('tks=flood.tks', async (page) => {
    const numbers = await shown(page);
    await page.locator('#speed').selectOption('4');
    await page.locator('#play').click();
    assert.equal(await value(page, '#play', 'aria-label'), 'Pause');
    await page.waitForFunction(() => window.shown.length > 14);
    const seen = await numbers();
    seen.forEach((number, i) => assert.equal(number, (i + 1) % 12));
    await page.locator('#play').click();
    assert.equal(await value(page, '#play', 'aria-label'), 'Play');
    await drawn(page);
    const {length} = await numbers();
    await page.waitForTimeout(600);
    assert.equal((await numbers()).length, length);
    const {frame} = await page.evaluate(() => document.body.dataset);
    assert.match(await spoken(page), new RegExp(`frame ${frame} of 12`));
  });
});

test('groups that go on from those before are shown as others are, and play', async () => {
  await site.withPage('tks=going.tks#frame=10', async (page) => {
    assert.match(await page.locator('#rmse').textContent(), /exact/);
    const numbers = await shown(page);
    await page.locator('#speed').selectOption('4');
    await page.locator('#play').click();
    await page.waitForFunction(() => window.shown.length > 12);
    (await numbers()).forEach((number, i) => assert.equal(number, (i + 11) % 12));
  });
});

test('where groups are gone the page says so, and plays on from the next entry', async () => {
  await site.withPage('tks=late.tks#frame=7', async (page) => {
    const numbers = await shown(page);
    await page.locator('#frame').fill('3');
    await page.waitForFunction(() =>
      /goes on from group 0, which is not there/.test(document.body.textContent));
    await page.locator('#speed').selectOption('4');
    await page.locator('#play').click();
    await page.waitForFunction(() => window.shown.length > 7);
    assert.deepEqual([...new Set(await numbers())].sort((a, b) => a - b), [6, 7, 8, 9, 10, 11]);
  });
});

test('the next group is fetched while this one plays', async () => {
  await site.withPage('tks=flood.tks', async (page) => {
    const groups = [...Buffer.from(flood).toString('latin1').matchAll(/TKG\x1a/g)];
    site.server.begin();
    await page.locator('#play').click();
    await shows(page, 1);
    await page.waitForTimeout(100);
    const {index: second} = groups[1];
    const reaches = site.server.requests.some(({range}) => {
      const [begin, end] = range.match(/\d+/g).map(Number);
      return begin <= second && end > second;
    });
    const whole = site.server.requests.length === 0;  // it was in the tail
    assert.ok(reaches || whole, site.server.requests.map(({range}) => range).join());
  });
});

test('without the loop frames end with the last, and begin anew', async () => {
  await site.withPage('tks=flood.tks#frame=9', async (page) => {
    await page.locator('#loop').uncheck();
    const numbers = await shown(page);
    await page.locator('#picture').focus();
    await page.keyboard.press(' ');
    await page.waitForFunction(() => document.body.dataset.frame === '11' &&
      document.body.dataset.state === 'done');
    assert.deepEqual(await numbers(), [10, 11]);
    assert.equal(await value(page, '#play', 'aria-label'), 'Play');
    await page.keyboard.press(' ');
    await shows(page, 0);
  });
});

test('what is sought while frames play goes on from there', async () => {
  await site.withPage('tks=flood.tks', async (page) => {
    await page.locator('#play').click();
    await shows(page, 1);
    await page.locator('#frame').fill('7');
    await shows(page, 9);
    assert.equal(await value(page, '#play', 'aria-label'), 'Pause');
  });
});

test('a stream of several frames, and frames of textures, play too', async () => {
  for (const [name, times] of [['single', 'frame 2 of'], ['clouds', 'frame 2 of 4']]) {
    await site.withPage(`tks=${name}.tks`, async (page) => {
      const before = await picture(page);
      await page.locator('#frame').fill('2');
      await shows(page, 2);
      await drawn(page);
      assert.ok((await spoken(page)).startsWith(times), await spoken(page));
      assert.notEqual(await picture(page), before);
      const numbers = await shown(page);
      await page.locator('#play').click();
      await page.waitForFunction(() => window.shown.length > 1);
      const max = Number(await value(page, '#frame', 'max'));
      const [first, second] = await numbers();
      assert.deepEqual([first, second], [3 % (max + 1), (first + 1) % (max + 1)]);
    });
  }
});

test('a sequence is dropped on the page; a single frame has no bar', async () => {
  await site.withPage('tks=flood.tks#frame=5', async (page) => {
    const drop = (name, bytes) => page.evaluate(([called, base64]) => {
      const data = new DataTransfer();
      const content = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      data.items.add(new File([content], called));
      window.dispatchEvent(new DragEvent('drop', {dataTransfer: data, cancelable: true}));
    }, [name, Buffer.from(bytes).toString('base64')]);
    await drop('clouds', clouds);
    await page.waitForFunction(() => document.getElementById('frame').max === '3');
    await drawn(page);
    assert.ok(await page.locator('#timeline').isVisible());
    await drop('one.tks', await readFile(new URL('geometry_budget_129x97.tks', vectors)));
    await page.waitForFunction(() => document.getElementById('name').textContent === 'one.tks');
    await drawn(page);
    assert.ok(await page.locator('#timeline').isHidden());
  });
});

test('`tetrakis view` shows all of a sequence', async () => {
  const folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await writeFile(join(folder, 'flood.tks'), flood);
  const served = spawn(CLI, ['view', join(folder, 'flood.tks'), '--no-browser']);
  try {
    const address = await new Promise((resolve) =>
      served.stdout.once('data', (text) => resolve(String(text).trim())));
    const answer = await fetch(new URL('/flood.tks', address));
    assert.deepEqual(new Uint8Array(await answer.arrayBuffer()), flood);
  } finally {
    served.kill();
    await rm(folder, {recursive: true});
  }
});
