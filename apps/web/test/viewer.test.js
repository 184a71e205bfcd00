// SPDX-License-Identifier: Apache-2.0
// The viewer in headless Chromium: what is drawn, after how many requests, and what it says of bad
// files. TETRAKIS_CLI: a built `tetrakis`, whose `view` then serves the page in one of the tests.
import assert from 'node:assert/strict';
import {spawn, spawnSync} from 'node:child_process';
import {once} from 'node:events';
import {existsSync} from 'node:fs';
import {cp, mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {fromArrayBuffer} from 'geotiff';

import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {launch} from './chromium.js';
import {psnr} from './pictures.js';
import {serve} from './server.js';
import {terrainOf, tiffOf} from './terrain.js';

const viewer = new URL('../dist/viewer/', import.meta.url).pathname;
const vectors = new URL('../../../conformance/vectors/', import.meta.url).pathname;
const NAME = 'joint_budget_97x97_128x128.tks';
const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
let browser, folder, bytes, site;

before(async () => {
  browser = await launch();
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await cp(viewer, folder, {recursive: true});
  bytes = await readFile(vectors + NAME);
  const damaged = Buffer.from(bytes);
  damaged.fill(0xff, 5, 40);
  await writeFile(join(folder, 'whole.tks'), bytes);
  await writeFile(join(folder, 'damaged.tks'), damaged);
  await writeFile(join(folder, 'short.tks'), bytes.subarray(0, 3000));
  await writeFile(join(folder, 'page.tks'), '<!doctype html><title>Sign in</title>');
  await writeFile(join(folder, 'empty.tks'), '');
  await cp(vectors + 'column_1x300.tks', join(folder, 'column.tks'));
  site = await serve(folder);
});
after(async () => {
  await browser.close();
  await site.close();
  await rm(folder, {recursive: true});
});

const ended = (page) =>
  page.waitForFunction(() => ['done', 'failed'].includes(document.body.dataset.state));

/** Waits until all of `stream` is drawn. */
const shows = (page, stream) => page.waitForFunction(
  (size) => document.body.dataset.bytes === size, String(stream.length));

/** Opens the viewer and calls `use` once it has ended with what it was told to show. */
const withPage = (query, use, faults = {}, options = null) => browser.withPage(async (page) => {
  const errors = [];
  site.begin(faults);
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(site.url + 'index.html' + query);
  if (query) await ended(page);
  await use(page, site);
  assert.deepEqual(errors, []);
}, options);

const ranges = (server) =>
  server.requests.filter(({path}) => path.endsWith('.tks')).map(({range}) => range);
const text = (page, selector) => page.locator(selector).textContent();

/** Distinct colours of the canvas, coarsely, and the share of pixels that are not sky. */
async function colours(page) {
  const picture =
    await page.locator('#picture').screenshot({style: 'aside, header { display: none }'});
  return page.evaluate(async (base64) => {
    const answer = await fetch('data:image/png;base64,' + base64);
    const image = await createImageBitmap(await answer.blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    const {data} = context.getImageData(0, 0, image.width, image.height), seen = new Set();
    let ground = 0;
    for (let i = 0; i < data.length; i += 4) {
      seen.add((data[i] >> 4 << 8) | (data[i + 1] >> 4 << 4) | data[i + 2] >> 4);
      // The sky is blue to grey: its red is never the most.
      if (data[i] > data[i + 2] || data[i + 1] > data[i + 2]) ++ground;
    }
    return {distinct: seen.size, ground: (4 * ground) / data.length};
  }, picture.toString('base64'));
}

test('a picture after one request, then refinement to the last byte', async () => {
  await withPage('?tks=whole.tks', async (page, server) => {
    assert.equal(ranges(server)[0], 'bytes=0-4095');
    assert.equal(ranges(server).length, 2);
    assert.equal(await page.locator('body').getAttribute('data-bytes'), String(bytes.length));
    assert.match(await text(page, '#split-text'), /heights .*texture /);
    assert.match(await text(page, '#fetched-text'), /12 kB fetched in 2 requests/);
    assert.match(await text(page, '#psnr'), /dB/);
    const {distinct, ground} = await colours(page);
    assert.ok(distinct > 40 && ground > 0.05, JSON.stringify({distinct, ground}));
  });
});

test('the first picture needs the first request alone', () => browser.withPage(async (page) => {
  // Whatever follows the first 4 kB never comes.
  await page.route('**/whole.tks', (route) =>
    route.request().headers().range === 'bytes=0-4095' ? route.continue() : undefined);
  await page.goto(site.url + 'index.html?tks=whole.tks');
  await page.waitForFunction(() => document.body.dataset.bytes === '4096');
  assert.ok((await colours(page)).ground > 0.05);
}));

test('sliders go back without requests; wireframe, texture, light and flight draw', async () => {
  await withPage('?tks=whole.tks', async (page, server) => {
    const before = server.requests.length;
    await page.locator('#bytes').fill('400');
    await page.locator('#triangles').fill('100');
    await page.waitForFunction(() => Number(document.body.dataset.bytes) < 1000);
    await ended(page);
    await page.waitForFunction(
      () => Number(document.querySelector('#triangles-here').textContent) < 300);
    assert.equal(server.requests.length, before);
    for (const name of ['wireframe', 'textured', 'shaded', 'fly']) {
      await page.locator('#' + name).click();
    }
    await page.keyboard.down('w');
    await page.waitForTimeout(200);
    await page.keyboard.up('w');
    assert.ok((await colours(page)).distinct > 4);
  });
});

test('a server without ranges', async () => {
  await withPage('?tks=whole.tks', async (page, server) => {
    assert.equal(ranges(server).length, 1);
    assert.equal(await page.locator('body').getAttribute('data-bytes'), String(bytes.length));
  }, {noRanges: true});
});

test('files that cannot be shown say why, and others can be opened', async () => {
  await withPage('', async (page, server) => {
    for (const [name, pattern] of [
      ['damaged.tks', /profile 255/], ['page.tks', /not a Tetrakis stream/],
      ['none.tks', /answered 404/], ['empty.tks', /The file is empty/],
      ['column.tks', /1 x 300 samples have no area/],
    ]) {
      await page.locator('#address input').fill(server.url + name);
      await page.locator('#address button').click();
      await page.getByRole('alert').filter({hasText: pattern}).waitFor();
      assert.equal(await page.locator('#panel').isVisible(), false);
    }
    await page.locator('#file').setInputFiles(join(folder, 'whole.tks'));
    await shows(page, bytes);
    assert.equal(await page.getByRole('alert').isVisible(), false);
    assert.ok(await page.locator('#panel').isVisible());
  });
});

test('a server that lets no other page read its files is named on the page', async () => {
  const other = await serve(folder);
  try {
    await withPage('?tks=' + encodeURIComponent(other.url + 'whole.tks'), async (page, server) => {
      const said = await page.getByRole('alert').textContent();
      assert.ok(said.startsWith(other.url), said);
      assert.match(said, /its server answers, but does not allow pages of/);
      assert.ok(said.includes(new URL(server.url).origin), said);
      await page.locator('#file').setInputFiles(join(folder, 'whole.tks'));
      await shows(page, bytes);
      assert.equal(await page.getByRole('alert').isVisible(), false);
    });
  } finally {
    await other.close();
  }
});

test('a file that is cut short is shown, with a note', async () => {
  await withPage('?tks=short.tks', async (page) => {
    assert.match(await page.getByRole('alert').textContent(), /cut short: 3.0 kB of 12 kB/);
    assert.ok((await colours(page)).ground > 0.05);
  });
  // Of a stream with an index a view may need less than is there.
  const stream = await encode({...terrainOf(385), bytes: 300000, index: true, regions: 32});
  await writeFile(join(folder, 'short_index.tks'), stream.subarray(0, 200000));
  await withPage('?tks=short_index.tks&eye=-5000,900,-5000&target=-5700,0,-5700', async (page) => {
    const here = Number(await page.locator('#fetched').getAttribute('data-bytes'));
    assert.ok(here < 199000, `${here}`);
    assert.match(await page.getByRole('alert').textContent(), /cut short: 200 kB of 300 kB/);
  });
});

test('a drop opens', async () => {
  await withPage('', async (page) => {
    await page.locator('#welcome').waitFor();
    await page.evaluate((data) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([new Uint8Array(data)], 'dropped.tks'));
      window.dispatchEvent(new DragEvent('drop', {dataTransfer: transfer, cancelable: true}));
    }, [...bytes]);
    await ended(page);
    assert.equal(await text(page, '#name'), 'dropped.tks');
    assert.equal(await page.locator('body').getAttribute('data-state'), 'done');
  });
});

test('a bad file leaves what is shown, under its own name, and going on', async () => {
  const image = {name: 'image.png', mimeType: 'image/png', buffer: Buffer.from('none')};
  const stream = {name: 'a.tks', mimeType: '', buffer: bytes};
  await withPage('?tks=whole.tks', async (page) => {
    const size = await text(page, '#size');
    for (const [files, pattern] of [[join(folder, 'damaged.tks'), /profile 255/],
      [[stream, image], /a\.tks is a stream, which is opened alone/],
      [[image], /image\.png cannot/]]) {
      await page.locator('#file').setInputFiles(files);
      await page.getByRole('alert').filter({hasText: pattern}).waitFor();
      assert.equal(await text(page, '#name'), 'whole.tks');
      assert.equal(await page.title(), 'whole.tks – Tetrakis');
      assert.equal(await text(page, '#size'), size);
      assert.ok(await page.locator('#panel').isVisible());
    }
    await page.locator('#bytes').fill('400');
    await page.waitForFunction(() => Number(document.body.dataset.bytes) < 1000);
  });
});

test('in a frame that is not shown the viewer waits, and draws once it is', async () => {
  await writeFile(join(folder, 'indexed.tks'),
    await encode({...terrainOf(385), bytes: 90000, index: true, regions: 32}));
  await writeFile(join(folder, 'host.html'), '<!doctype html><iframe src="index.html?' +
    'tks=indexed.tks" style="display: none; width: 800px; height: 500px"></iframe>');
  await browser.withPage(async (page) => {
    await page.goto(site.url + 'host.html');
    await page.waitForTimeout(1500);
    const frame = page.frames()[1], body = frame.locator('body');
    assert.equal(await body.getAttribute('data-state'), 'refining');
    await page.locator('iframe').evaluate((element) => (element.style.display = 'block'));
    await ended(frame);
    assert.equal(await body.getAttribute('data-state'), 'done');
    assert.ok(Number(await body.getAttribute('data-bytes')) > 80000);
    assert.ok((await colours(frame)).ground > 0.05);
  });
});

test('a lost context comes back', async () => {
  await withPage('?tks=whole.tks', async (page) => {
    await page.evaluate(async () => {
      const context = document.querySelector('#picture').getContext('webgl2');
      const extension = context.getExtension('WEBGL_lose_context');
      const restored = new Promise((resolve) =>
        document.querySelector('#picture').addEventListener('webglcontextrestored', resolve));
      extension.loseContext();
      await new Promise((resolve) => setTimeout(resolve, 100));
      extension.restoreContext();
      await restored;
      await new Promise((resolve) => setTimeout(resolve, 200));
    });
    assert.ok((await colours(page)).ground > 0.05);
  });
});

test('a browser without WebGL is told apart', async () => {
  const page = await browser.newPage();
  try {
    await page.addInitScript(() => (HTMLCanvasElement.prototype.getContext = () => null));
    await page.goto(site.url + 'index.html?tks=whole.tks');
    await ended(page);
    assert.match(await page.getByRole('alert').textContent(), /no WebGL/);
  } finally {
    await page.close();
  }
});

test('a phone: the controls unfold, nothing is wider than the screen', async () => {
  await withPage('?tks=whole.tks', async (page) => {
    assert.equal(await page.locator('#bytes').isVisible(), false);
    await page.locator('#fold').tap();
    assert.ok(await page.locator('#bytes').isVisible());
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    assert.match(await text(page, '#help'), /finger/);
    await page.locator('#fold').tap();
    assert.equal(await page.locator('#split').isVisible(), false);
    const [north, panel] = await Promise.all(
      ['#north', '#panel'].map((name) => page.locator(name).boundingBox()));
    assert.ok(north.y + north.height < panel.y, 'the panel does not lie over the needle');
    await page.locator('#fold').tap();
    await page.setViewportSize({width: 844, height: 390});
    const {x, y, width, height} = await page.locator('#panel').boundingBox();
    assert.ok(
      x >= 0 && y >= 0 && x + width <= 844 && y + height <= 390, 'the panel is on the screen');
  }, {}, {viewport: {width: 390, height: 844}, isMobile: true, hasTouch: true});
});

test('every kind of stream is drawn', async () => {
  await withPage('', async (page) => {
    for (const [name, note = /^$/] of [['geometry_budget_129x97'], ['rgba_32x32'],
      ['coast_budget_90x70'], ['nothing_valid_12x7', /All heights of this stream are voids/],
      ['cutout_all_hidden_33x20', /The cut-out of this stream hides all texels/], ['texture_1x1'],
      ['tiny_2x2']]) {
      await page.locator('#file').setInputFiles(`${vectors}${name}.tks`);
      await page.waitForFunction((begin) => document.title.startsWith(begin) &&
        document.body.dataset.state !== 'busy', name);
      await ended(page);
      assert.equal(await page.locator('body').getAttribute('data-state'), 'done', name);
      assert.match(await text(page, '#message'), note);
    }
  });
});

test('what lies high, or is higher than wide, is in the picture, exaggerated or not', async () => {
  const {heights} = terrainOf(65);
  const high = {...heights, data: heights.data.map((metres) => metres + 20000)};
  await writeFile(join(folder, 'high.tks'), await encode({heights: high}));
  await writeFile(join(folder, 'tall.tks'), await encode({heights: {...high, spacing: 1}}));
  for (const [name, least, most] of [['high', 1, 1], ['tall', 0.001, 0.1]]) {
    await withPage(`?tks=${name}.tks`, async (page) => {
      const times = Number((await text(page, '#exaggeration-value')).slice(1));
      assert.ok(times >= least && times <= most, `${name}: × ${times}`);
      assert.ok((await colours(page)).ground > 0.1, name);
      await page.locator('#exaggeration').fill('10');
      assert.ok((await colours(page)).ground > 0.1, name + ', exaggerated');
    });
  }
});

test('keys turn the picture and come nearer, and Home brings all of it back', async () => {
  await withPage('?tks=whole.tks', async (page) => {
    const picture = async () => {
      await page.waitForTimeout(700);  // what moves comes to rest
      return page.locator('#picture').screenshot({style: 'aside, header { display: none }'});
    };
    const before = await picture();
    await page.locator('#picture').focus();
    for (const key of ['ArrowLeft', 'ArrowUp', '+', '+']) await page.keyboard.press(key);
    const after = await picture();
    assert.notDeepEqual(after, before);
    await page.keyboard.press('Home');
    const dB = await psnr(page, [await picture(), before],
      Array(2).fill({x: 0, y: 0, width: 1000, height: 600}));
    assert.ok(dB > 40, `${dB} dB`);
  });
});

/** Keys of UTM zone 11 north; a sample is the value at its middle. */
const PLACED = [[33550, 12, 3, [30, 30, 0]], [33922, 12, 6, [0, 0, 0, 5e5, 4e6, 0]],
  [34735, 3, 16, [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 2, 3072, 0, 1, 32611]]];

test('a GeoTIFF and an image over it are coded on the page, and can be saved', async () => {
  const {heights} = terrainOf(65);
  const height = {
    name: 'dem.tif', mimeType: 'image/tiff', buffer: Buffer.from(tiffOf(heights, PLACED)),
  };
  const svg = await browser.newPage({viewport: {width: 64, height: 64}});
  await svg.setContent('<body style="background: linear-gradient(90deg, #a52, #4b6)">');
  const image = {name: 'image.png', mimeType: 'image/png', buffer: await svg.screenshot()};
  await svg.close();
  await withPage('', async (page) => {
    await page.locator('#file').setInputFiles([height, image]);
    await ended(page);
    assert.equal(await page.locator('body').getAttribute('data-state'), 'done',
      await page.locator('#message').textContent());
    assert.match(await text(page, '#size'), /65 × 65 heights · 64 × 64 texels/);
    const saved = await page.evaluate(async () =>
      [...new Uint8Array(await (await fetch(document.querySelector('#save').href)).arrayBuffer())]);
    const {info} = await open(new Uint8Array(saved));
    assert.deepEqual([info.crs, info.spacingX, info.hasIndex], ['EPSG:32611', 30, true]);
    assert.deepEqual(info.geotransform, [5e5 - 15, 30, 0, 4e6 + 15, 0, -30]);
    assert.ok((await colours(page)).ground > 0.05);
  });
});

test('files that cannot be coded say why', async () => {
  const text = {name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('just words')};
  const broken = {name: 'broken.tif', mimeType: 'image/tiff', buffer: Buffer.from('II*\0________')};
  const dem = {name: 'dem.tif', mimeType: 'image/tiff',
    buffer: Buffer.from(tiffOf(terrainOf(16).heights))};
  for (const [files, pattern] of [[[text], /notes\.txt cannot be read as a GeoTIFF or an image/],
    [[broken], /broken\.tif cannot be read/], [[dem, dem], /Two of these files hold heights/]]) {
    await withPage('', async (page) => {
      await page.locator('#file').setInputFiles(files);
      await ended(page);
      assert.match(await page.getByRole('alert').textContent(), pattern);
    });
  }
});

test('of a stream with an index all comes in few requests, and is drawn as a map', async () => {
  const stream = await encode({...terrainOf(193), bytes: 90000, index: true, regions: 32});
  await writeFile(join(folder, 'indexed.tks'), stream);
  await withPage('?tks=indexed.tks', async (page, server) => {
    assert.ok(ranges(server).length <= 8, ranges(server).join(' '));
    const here = Number(await page.locator('#fetched').getAttribute('data-bytes'));
    assert.ok(here > stream.length - 4096 && here <= stream.length, `${here} of ${stream.length}`);
    assert.ok(await page.locator('#ground').isVisible());
    assert.match(await text(page, '#fetched-text'), /requests, and for which ground/);
  });
});

test('the map of the ground has north above', async () => {
  const {heights} = terrainOf(65), options = {index: true, regions: 16};
  for (const [step, upright] of [[-30, 'scale(1, 1)'], [30, 'scale(1, -1)']]) {
    const geotransform = [5e5, 30, 0, 4e6, 0, step];
    await writeFile(join(folder, 'mapped.tks'),
      await encode({heights: {...heights, geotransform}, ...options}));
    await withPage('?tks=mapped.tks', async (page) => {
      const map = page.locator('#ground');
      assert.ok(await map.isVisible());
      assert.equal(await map.evaluate(({style}) => style.transform), upright);
    });
  }
});

test('the map of a long strip is no line', async () => {
  const data = Int16Array.from({length: 1025 * 20}, (_, i) => (i * i) % 97);
  for (const [width, height] of [[1025, 20], [20, 1025]]) {
    const heights = {data, width, height, spacing: 30};
    await writeFile(join(folder, 'strip.tks'), await encode({heights, index: true, regions: 16}));
    await withPage('?tks=strip.tks', async (page) => {
      const box = await page.locator('#ground').boundingBox();
      assert.ok(Math.min(box.width, box.height) >= 16 && Math.max(box.width, box.height) <= 64);
    });
  }
});

test('a link keeps the camera, once it was moved', async () => {
  await withPage('?tks=whole.tks', async (page) => {
    const url = () => new URL(page.url());
    assert.equal(url().hash, '');
    await page.locator('#exaggeration').fill('4');
    await page.locator('#picture').focus();
    for (const key of ['ArrowLeft', '+', '+']) await page.keyboard.press(key);
    await page.waitForFunction(() => location.hash);
    const shot = (which) =>
      which.locator('#picture').screenshot({style: 'aside, header, #bearings { display: none }'});
    // The camera glides, and a busy machine draws late: a picture counts once it stays.
    const steady = async (which) => {
      for (let last = await shot(which), i = 0; ; ++i) {
        await which.waitForTimeout(700);
        const next = await shot(which);
        if (i === 8 || next.equals(last)) return next;
        last = next;
      }
    };
    const before = await steady(page);
    assert.match(url().hash, /^#eye=[-\d.,e]+&target=[-\d.,e]+&height=4$/);
    const other = await browser.newPage();
    await other.goto(page.url());
    await ended(other);
    const dB = await psnr(page, [await steady(other), before],
      Array(2).fill({x: 0, y: 0, width: 1000, height: 600}));
    await other.close();
    assert.ok(dB > 35, `${dB} dB`);
    await page.locator('#home').click();
    await page.waitForFunction(() => !location.hash);
  });
});

test('the page tells what lies under the pointer, a scale, and where north is', async () => {
  await writeFile(join(folder, 'placed.tks'), await encode(terrainOf(129)));
  await withPage('?tks=placed.tks', async (page) => {
    await page.locator('#north').click();
    await page.waitForTimeout(700);
    const turned = await page.locator('#needle').getAttribute('style');
    assert.ok(Math.abs(Number(/rotate\((.*)rad\)/.exec(turned)[1])) < 0.01, turned);
    await page.mouse.move(350, 300);
    await page.waitForFunction(() => document.querySelector('#under').textContent);
    // 3870 m from 500 000, 4 000 000 on, in UTM's zone 11.
    const [, metres, latitude, longitude] =
      /^(-?[\d.]+) m · ([\d.]+)° N ([\d.]+)° W$/.exec(await text(page, '#under'));
    assert.ok(Math.abs(metres) < 800 && latitude > 36.1 && latitude < 36.15, `${latitude}`);
    assert.ok(longitude > 116.95 && longitude < 117.0001, longitude);
    const {width} = await page.locator('#scale').boundingBox();
    assert.ok(width >= 40 && width <= 121, `${width}`);
    assert.match(await text(page, '#scale'), /^[125]0* k?m$/);
    await page.mouse.move(350, 5);
    await page.waitForFunction(() => document.querySelector('#under').textContent === '');
  });
});

test('sliders say their values, and the sun moves', async () => {
  await withPage('?tks=whole.tks', async (page) => {
    const said = (name) => page.locator(`#${name}`).getAttribute('aria-valuetext');
    assert.equal(await said('bytes'), '12 kB');
    assert.equal(await text(page, '#sun-value'), '305° NW');
    const lit = await page.locator('#picture').screenshot();
    await page.locator('#sun').fill('90');
    assert.equal(await said('sun'), '90 degrees, east');
    await page.waitForTimeout(200);
    assert.notDeepEqual(await page.locator('#picture').screenshot(), lit);
    for (const slider of await page.locator('input[type=range]:visible').all()) {
      assert.ok(await slider.getAttribute('aria-valuetext'));
    }
  });
});

/** Of a part of a picture: the share of texels whose red is the largest, and how many reds. */
const tonesOf = (page, picture) => page.evaluate(async (base64) => {
  const answer = await fetch('data:image/png;base64,' + base64);
  const image = await createImageBitmap(await answer.blob());
  const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
  context.drawImage(image, 0, 0);
  const {data} = context.getImageData(250, 250, 200, 100);
  const reds = data.filter((_, i) => i % 4 === 0);
  const burnt = reds.filter((red) => red === 255).length / reds.length;
  return {burnt, tones: new Set(reds).size};
}, picture.toString('base64'));

test('white slopes keep their shape in the light', async () => {
  const {heights} = terrainOf(129), data = new Uint8Array(3 * 129 * 129).fill(255);
  await writeFile(join(folder, 'snow.tks'),
    await encode({heights, texture: {data, width: 129, height: 129}}));
  await withPage('?tks=snow.tks', async (page) => {
    const style = 'aside, header, #bearings { display: none }';
    const {burnt, tones} = await tonesOf(page, await page.locator('#picture').screenshot({style}));
    assert.ok(burnt < 0.02 && tones > 30, `${burnt} ${tones}`);
  });
});

test('what is shown is saved as mesh, GeoTIFF and picture', async () => {
  await writeFile(join(folder, 'placed.tks'), await encode(terrainOf(129)));
  await withPage('?tks=placed.tks', async (page) => {
    const files = {};
    for (const kind of ['glb', 'tif', 'png']) {
      const [file] = await Promise.all([
        page.waitForEvent('download'), page.locator(`[data-kind=${kind}]`).click(),
      ]);
      assert.equal(file.suggestedFilename(), `placed.${kind}`);
      files[kind] = await readFile(await file.path());
    }
    assert.equal(files.png.toString('latin1', 1, 4), 'PNG');
    assert.deepEqual([files.png.readUInt32BE(16), files.png.readUInt32BE(20)], [129, 129]);
    const image = await (await fromArrayBuffer(new Uint8Array(files.tif).buffer)).getImage();
    const [samples] = await image.readRasters();
    assert.deepEqual([...samples], [...terrainOf(129).heights.data]);
    assert.deepEqual(image.getOrigin().slice(0, 2), [5e5, 4e6]);
    assert.equal(image.getGeoKeys().ProjectedCSTypeGeoKey, 32611);
    const length = files.glb.readUInt32LE(12);
    const {accessors, extensionsUsed, images} = JSON.parse(files.glb.subarray(20, 20 + length));
    assert.equal(files.glb.readUInt32LE(8), files.glb.length);
    assert.deepEqual(extensionsUsed, ['KHR_materials_unlit']);
    assert.ok(accessors[3].count > 3000 && images.length === 1);
    assert.deepEqual([accessors[0].min[0], accessors[0].max[0]], [-1920, 1920]);
  });
});

test('the original stands beside what was coded from it', async () => {
  const {heights} = terrainOf(257);
  const file = {
    name: 'dem.tif', mimeType: 'image/tiff', buffer: Buffer.from(tiffOf(heights, PLACED)),
  };
  await withPage('?tks=whole.tks', async (page) => {
    assert.equal(await page.locator('#compare').isVisible(), false);
    await page.locator('#file').setInputFiles([file]);
    await page.waitForFunction(() => document.title.startsWith('dem.tks'));
    await ended(page);
    await page.locator('#bytes').fill('0');
    await page.waitForTimeout(500);
    await ended(page);
    const style = 'aside, header, #bearings, #edge { display: none }';
    const shot = () => page.locator('#picture').screenshot({style});
    const stream = await shot();
    await page.locator('#compared').click();
    await page.locator('#edge').fill('400');
    await page.waitForTimeout(500);
    assert.equal(await page.locator('#edge').getAttribute('aria-valuetext'),
      '40 % stream, 60 % original');
    const both = await shot();
    const dB = (x) => psnr(page, [stream, both],
      Array(2).fill({x, y: 150, width: 180, height: 250}));
    const [left, right] = [await dB(200), await dB(420)];
    assert.ok(left > 50 && right < 35, `${left} ${right}`);
    await page.locator('#compared').click();
    await page.waitForTimeout(300);
    assert.equal(await page.locator('#edge').isVisible(), false);
  });
});

test('the original stands beside a stream whose address names it', async () => {
  const {heights} = terrainOf(65);
  await writeFile(join(folder, 'alone.tks'), await encode({heights, bytes: 2000}));
  await writeFile(join(folder, 'alone.tif'), tiffOf(heights, PLACED));
  await writeFile(join(folder, 'other.tif'), tiffOf(terrainOf(66).heights, PLACED));
  await withPage('?tks=alone.tks&original=alone.tif', async (page) => {
    await ended(page);
    await page.locator('#compared').click();
    assert.equal(await page.locator('#edge').isVisible(), true);
  });
  const said = {'other.tif': /66 × 66 heights, and the stream has 65 × 65/, 'none.tif': /404/};
  for (const [name, text] of Object.entries(said)) {
    await withPage(`?tks=alone.tks&original=${name}`, async (page) => {
      await ended(page);
      await page.locator('#message').filter({hasText: text}).waitFor();
      assert.equal(await page.locator('#compare').isVisible(), false);
    });
  }
});

test('tetrakis view serves the page by ranges', {skip: !existsSync(CLI)}, async () => {
  const child = spawn(CLI, ['view', '--no-browser', join(folder, 'whole.tks')]);
  const page = await browser.newPage();
  try {
    const [line] = await once(child.stdout, 'data');
    const address = String(line).trim();
    assert.match(address, /^http:\/\/127\.0\.0\.1:\d+\/\?tks=whole\.tks$/);
    const answers = [];
    page.on('response', (answer) => answers.push(answer));
    await page.goto(address);
    await ended(page);
    assert.equal(await page.locator('body').getAttribute('data-bytes'), String(bytes.length));
    const parts = answers.filter((answer) => answer.url().endsWith('/whole.tks'));
    assert.deepEqual(parts.map((answer) => answer.status()), [206, 206]);
    const status = async (path, headers) =>
      (await page.request.get(new URL(path, address).href, {headers})).status();
    assert.equal(await status('/%2e%2e/%2e%2e/etc/passwd'), 404);
    const {port} = new URL(address);
    for (const [name, expected] of [['elsewhere.example', 403], ['localhost.example', 403],
      ['[::2]', 403], ['LocalHost', 200], ['127.0.0.1', 200], ['[::1]', 200]]) {
      for (const Host of [name, `${name}:${port}`])
        assert.equal(await status('/whole.tks', {Host}), expected, Host);
    }
    assert.equal(await status('/whole.tks', {Range: 'bytes=900000-'}), 416);
    const last = await page.request.get(new URL('/whole.tks', address).href,
      {headers: {Range: 'bytes=5990-99999999'}});
    assert.deepEqual(await last.body(), bytes.subarray(5990));
    const {status: code, stderr} = spawnSync(
      CLI, ['view', '--no-browser', '--port', port, join(folder, 'whole.tks')], {timeout: 5000});
    assert.equal(code, 2);
    assert.match(String(stderr), new RegExp(port));
  } finally {
    await page.close();
    child.kill();
  }
});

test('names of streams may be of any script', {skip: !existsSync(CLI)}, async () => {
  await writeFile(join(folder, 'рельеф 1.tks'), bytes);
  const child = spawn(CLI, ['view', '--no-browser', join(folder, 'рельеф 1.tks')]);
  const page = await browser.newPage();
  try {
    const [line] = await once(child.stdout, 'data');
    const address = new URL(String(line).trim());
    assert.equal(address.searchParams.get('tks'), 'рельеф_1.tks');
    await page.goto(address.href);
    await ended(page);
    assert.equal(await page.locator('body').getAttribute('data-bytes'), String(bytes.length));
  } finally {
    await page.close();
    child.kill();
  }
});
