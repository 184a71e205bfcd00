// SPDX-License-Identifier: Apache-2.0
// The viewer's globe in headless Chromium: round after 4 kB, without holes at the poles and at the
// date line, and flat where the address or the page says so.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {encode} from '../src/encode.js';
import {earth, earthOnCube, roughEarth} from './earth.js';
import {MIDDLE, drawn, viewerSite} from './viewer_site.js';

const TIMEOUT = {timeout: 120000};
/** The camera, 16 000 km from the centre; y points north, x to longitude 0. */
const PLACES = {
  north: '0,1.6e7,0', south: '0,-1.6e7,0', date: '-1.6e7,0,0', greenwich: '1.6e7,0,0',
};
let site, stream, indexed;

before(async () => {
  stream = await encode({heights: earth().heights, bytes: 80000});
  const rough = {...roughEarth(), bytes: 800000, regions: 128};
  indexed = await encode({...rough, index: true});
  const onCube = earthOnCube();
  const moon = {...earth().heights, crs: 'Moon', geoKeys: '1024=2 2057=1737400 2058=1737400'};
  site = await viewerSite({
    'earth.tks': stream,
    'textured.tks': await encode({...earth(), bytes: 120000}),
    'whole.tks': await encode(rough),
    'indexed.tks': indexed,
    'cube.tks': await encode({...onCube, bytes: 120000}),
    'bare_cube.tks': await encode({heights: onCube.heights, bytes: 80000}),
    'moon.tks': await encode({heights: moon, bytes: 40000}),
  });
});
after(() => site.close());

/** isGround(x, y), in pixels of the page: whether that is not what an empty page shows there. */
async function groundOf(page, name) {
  const style = 'aside, header, #bearings { display: none !important }';
  const path = process.env.TETRAKIS_PICTURES && join(process.env.TETRAKIS_PICTURES, `${name}.png`);
  const picture = await page.screenshot({style, path});
  const empty = await page.screenshot({style: `${style} #picture { visibility: hidden }`});
  const differs = await page.evaluate(async (files) => {
    const [a, b] = await Promise.all(files.map(async (base64) => {
      const blob = await (await fetch('data:image/png;base64,' + base64)).blob();
      const image = await createImageBitmap(blob);
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }));
    // As text: an array of so many numbers takes seconds to come from the page.
    return Array.from({length: a.length / 4}, (_, i) =>
      ([0, 1, 2].some((k) => Math.abs(a[4 * i + k] - b[4 * i + k]) > 3) ? 'x' : ' ')).join('');
  }, [picture, empty].map((file) => file.toString('base64')));
  return (x, y) => differs[1000 * Math.round(y) + Math.round(x)] === 'x';
}

/** All pixels within so many of the middle. */
function assertNoHole(isGround, radius, name) {
  for (let y = -radius; y <= radius; ++y) {
    for (let x = -radius; x <= radius; ++x) {
      if (Math.hypot(x, y) > radius) continue;
      assert.ok(isGround(MIDDLE.x + x, MIDDLE.y + y), `${name}: a hole at ${x}, ${y}`);
    }
  }
}

/** How far ground goes from the middle, along 24 directions. */
function radiiOf(isGround) {
  return Array.from({length: 24}, (_, i) => {
    const turn = (i * Math.PI) / 12;
    let radius = 0;
    while (radius < 290 &&
      isGround(MIDDLE.x + radius * Math.cos(turn), MIDDLE.y + radius * Math.sin(turn))) ++radius;
    return radius;
  });
}

for (const name of ['earth', 'textured', 'bare_cube', 'cube']) {
  test(`after 4 kB a round globe is drawn: ${name}`, TIMEOUT, async () => {
    await site.withPage(`tks=${name}.tks`, async (page) => {
      const isGround = await groundOf(page, `globe_first_${name}`);
      for (const [x, y] of [[3, 3], [996, 3], [3, 596], [996, 596]])
        assert.ok(!isGround(x, y), `${name}: the globe does not reach ${x}, ${y}`);
      const radii = radiiOf(isGround);
      assert.ok(Math.min(...radii) > 100 && Math.max(...radii) < 1.15 * Math.min(...radii),
        `${name}: ${radii.join()}`);
    }, true);
  });
}

for (const [stream, bytes] of [['textured', '4kB'], ['textured', 'all'], ['cube', '4kB'],
  ['cube', 'all']]) {
  test(`no holes at poles, date line and edges: ${stream}, ${bytes}`, TIMEOUT, async () => {
    await site.withPage(`tks=${stream}.tks`, async (page) => {
      for (const [place, eye] of Object.entries(PLACES)) {
        await page.evaluate((hash) => (location.hash = hash), `eye=${eye}&target=0,0,0`);
        await page.waitForTimeout(300);
        const name = `globe_${stream}_${place}_${bytes}`;
        assertNoHole(await groundOf(page, name), 200, name);
      }
    }, bytes === '4kB');
  });
}

/** The root of the mean square by which two pictures differ within so many pixels of the middle. */
function differenceOf(page, pictures, radius) {
  return page.evaluate(async ({files, middle, radius}) => {
    const [a, b] = await Promise.all(files.map(async (base64) => {
      const blob = await (await fetch('data:image/png;base64,' + base64)).blob();
      const image = await createImageBitmap(blob);
      const context = new OffscreenCanvas(2 * radius, 2 * radius).getContext('2d');
      context.drawImage(image, radius - middle.x, radius - middle.y);
      return context.getImageData(0, 0, 2 * radius, 2 * radius).data;
    }));
    return Math.sqrt(a.reduce((sum, value, i) => sum + (value - b[i]) ** 2, 0) / a.length);
  }, {files: pictures.map((file) => file.toString('base64')), middle: MIDDLE, radius});
}

test('a globe with an index takes the bytes of the side that is seen', TIMEOUT, async () => {
  const pictures = [];
  for (const name of ['whole', 'indexed']) {
    await site.withPage(`tks=${name}.tks#eye=-7e6,0,0&target=0,0,0`, async (page) => {
      const bytesOf = async () => Number(await page.locator('body').getAttribute('data-bytes'));
      const fetched = await bytesOf();
      pictures.push(await page.locator('#picture').screenshot());
      if (name === 'whole') return;
      assert.ok(fetched < 0.6 * indexed.length, `${fetched} of ${indexed.length} bytes`);
      const difference = await differenceOf(page, pictures, 180);
      assert.ok(difference < 3, `the picture differs by ${difference}`);
      await page.evaluate(() => (location.hash = 'eye=7e6,0,0&target=0,0,0'));
      await page.waitForFunction((before) => Number(document.body.dataset.bytes) > before, fetched);
      await drawn(page);
      const both = await bytesOf();
      assert.ok(both > fetched + 0.05 * indexed.length, `${fetched} bytes, then ${both}`);
    });
  }
});

test('the wheel comes nearer, and the camera stays above the ground', TIMEOUT, async () => {
  await site.withPage('tks=earth.tks', async (page) => {
    await page.mouse.move(MIDDLE.x, MIDDLE.y);
    for (let i = 0; i < 60; ++i) await page.mouse.wheel(0, -600);
    await page.waitForTimeout(1500);
    const [, eye] = /eye=([^&]*)/.exec(decodeURIComponent(new URL(page.url()).hash));
    const radius = Math.hypot(...eye.split(',').map(Number));
    assert.ok(radius > 6.37e6 && radius < 7e6, `${radius} m from the centre`);
    const isGround = await groundOf(page, 'globe_near');
    assertNoHole(isGround, 250, 'near the ground');
  });
});

test('more bytes and the slider of heights change the picture', TIMEOUT, async () => {
  await site.withPage('tks=earth.tks', async (page) => {
    assert.equal(await page.locator('body').getAttribute('data-bytes'), String(stream.length));
    assert.equal(await page.locator('#exaggeration-value').textContent(), '× 15');
    const picture = () => page.locator('#picture').screenshot();
    const before = await picture();
    await page.locator('#exaggeration').fill('10');
    await page.waitForTimeout(1500);
    await drawn(page);
    const after = await picture();
    assert.notDeepEqual(after, before);
  });
});

test('the switch and the address show it flat, and round again', TIMEOUT, async () => {
  const isWide = async (page, name) => {
    const isGround = await groundOf(page, name), radii = radiiOf(isGround);
    return Math.max(...radii) > 1.3 * Math.min(...radii);
  };
  await site.withPage('tks=earth.tks&view=flat', async (page) => {
    assert.ok(await isWide(page, 'globe_flat'));
    await page.locator('#globe').click();
    await page.waitForFunction(() => document.body.dataset.state !== 'done');
    await drawn(page);
    assert.equal(await isWide(page, 'globe_round'), false);
    assert.equal(new URL(page.url()).searchParams.get('view'), null);
    await page.locator('#globe').click();
    await page.waitForFunction(() => document.body.dataset.state !== 'done');
    await drawn(page);
    assert.ok(await isWide(page, 'globe_flat_again'));
    assert.equal(new URL(page.url()).searchParams.get('view'), 'flat');
  });
});

test('the Moon fills the picture as the Earth does, and relief is drawn for its size', TIMEOUT,
  async () => {
    const seen = {};
    for (const name of ['earth', 'moon']) {
      await site.withPage(`tks=${name}.tks`, async (page) => {
        seen[name] = radiiOf(await groundOf(page, `globe_${name}`));
        assert.equal(await page.locator('#exaggeration-value').textContent(),
          name === 'moon' ? '× 4.1' : '× 15');
        await page.mouse.move(MIDDLE.x, MIDDLE.y);
        await page.waitForFunction(() => document.getElementById('under').textContent);
        // From where home looks.
        assert.match(await page.locator('#under').textContent(), /m · (19|20|21)\.\d+° N 1[45]\./);
      });
    }
    seen.earth.forEach((radius, i) => assert.ok(Math.abs(radius - seen.moon[i]) < 8,
      `${seen.earth.join()} and ${seen.moon.join()}`));
  });
