// SPDX-License-Identifier: Apache-2.0
// Tiles that the command line writes, in Cesium in headless Chromium: all load without an error,
// and the ground is in sight from near and far. It needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {mkdir, rm, symlink, writeFile} from 'node:fs/promises';
import {after, before, test} from 'node:test';
import {build} from 'esbuild';

import {launch} from './chromium.js';
import {serve} from './server.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const web = new URL('..', import.meta.url).pathname;
const folder = web + 'dist/tiles-test/';
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
const PIXELS = 256;
let browser, server;

const tetrakis = (...words) => execFileSync(CLI, ['-q', ...words], {cwd: folder});

before(async () => {
  if (skip) return;
  await rm(folder, {recursive: true, force: true});
  await mkdir(folder, {recursive: true});
  tetrakis('synth', '-o', 'sample', '--size', '129');
  tetrakis('encode', 'sample/height.tif', '--bytes', '64k', '-o', 'bare.tks');
  tetrakis('encode', 'sample/height.tif', '--texture', 'sample/texture.png', '--bytes', '128k',
    '-o', 'both.tks');
  tetrakis('tiles', 'bare.tks', '--format', '3dtiles', '-o', 'bare');
  tetrakis('tiles', 'both.tks', '--format', '3dtiles', '-o', 'both');
  tetrakis('tiles', 'both.tks', '--format', 'quantized-mesh', '-o', 'terrain');
  await build({
    stdin: {contents: `export * from '@cesium/engine';`, resolveDir: web}, bundle: true,
    format: 'esm', outfile: folder + 'cesium.js', external: ['node:*'], logLevel: 'error',
  });
  // Cesium looks for both in one folder.
  await symlink(web + 'node_modules/@cesium/engine/Build/Workers', folder + 'Workers');
  await symlink(web + 'node_modules/@cesium/engine/Source/Assets', folder + 'Assets');
  server = await serve(web);
  browser = await launch({width: PIXELS, height: PIXELS});
});
after(async () => {
  await browser?.close();
  await server?.close();
  await rm(folder, {recursive: true, force: true});
});

/** Calls `look` with a page that shows a folder of tiles; nothing fails meanwhile. */
const shown = (tiles, format, look) => browser.withPage(async (page) => {
  const errors = [], first = server.requests.length;
  page.on('pageerror', (error) => errors.push(error.message));
  const query = `tiles=/dist/tiles-test/${tiles}&format=${format}`;
  await page.goto(`${server.url}test/tiles.html?${query}`);
  await page.waitForFunction(() => document.body.dataset.state === 'done', null, {timeout: 60000})
    .catch((error) => assert.fail(`${error.message} ${errors}`));
  await look(page);
  const failures = await page.evaluate(() => window.failures);
  const missing = server.requests.slice(first).filter(({status}) => status === 404);
  assert.deepEqual([errors, failures, missing], [[], [], []]);
  return server.requests.slice(first).map(({path}) => path);
});

/** The share of pixels that are not black, from so many times the width of the ground. */
async function litFrom(page, times, error, name) {
  await page.evaluate((view) => window.lookFrom(...view), [times, error]);
  const picture = await page.screenshot();
  if (PICTURES) await writeFile(`${PICTURES}/${name}-${times}.png`, picture);
  return page.evaluate(async (base64) => {
    const blob = await (await fetch('data:image/png;base64,' + base64)).blob();
    const image = await createImageBitmap(blob), {width, height} = image;
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context.drawImage(image, 0, 0);
    const {data} = context.getImageData(0, 0, width, height);
    let lit = 0;
    for (let i = 0; i < data.length; i += 4) lit += data[i] + data[i + 1] + data[i + 2] > 24;
    return lit / (width * height);
  }, picture.toString('base64'));
}

/** The square of ground, as wide as the sphere around it over √2, seen from `times` that width. */
const shareFrom = (times) =>
  Math.min(1, (1 / Math.SQRT2 / (2 * times * Math.tan(Math.PI / 9))) ** 2);

for (const [tiles, format, cesiums] of [
  ['bare', '3dtiles', 16], ['both', '3dtiles', 16], ['terrain', 'quantized-mesh', 2],
]) {
  test(`${format} of ${tiles}.tks show the ground from near and far`, {skip}, async () => {
    const paths = await shown(tiles, format, async (page) => {
      // The last two with what Cesium allows.
      for (const [times, error] of [[0.3, 1], [2, cesiums], [12, cesiums]]) {
        const lit = await litFrom(page, times, error, `${tiles}-${format}`);
        const wanted = shareFrom(times);
        if (PICTURES) console.log(tiles, times, lit.toFixed(4), wanted.toFixed(4));
        assert.ok(lit > 0.7 * wanted && lit < 1.4 * wanted,
          `from ${times} times its width the ground takes ${lit} of the picture, not ${wanted}`);
      }
    });
    const levels =
      new Set(paths.map((path) => /\/(\d+)\/\d+\/\d+\.(glb|terrain)$/.exec(path)?.[1]));
    assert.ok(levels.size > 2, `few levels were asked for: ${[...levels]}`);
  });
}

test('quantized-mesh has the heights of the stream', {skip}, async () => {
  tetrakis('decode', 'both.tks', '--height', 'stored.tif');
  execFileSync('gdal_translate', ['-q', '-unscale', '-ot', 'Float32', 'stored.tif', 'heights.tif'],
    {cwd: folder});
  const fractions = Array.from({length: 30}, (_, i) => [0.1 + 0.8 * ((i * 0.37) % 1),
    0.1 + 0.8 * ((i * 0.53) % 1)]);
  await shown('terrain', 'quantized-mesh', async (page) => {
    await page.evaluate(() => window.lookFrom(0.5, 2));
    const places = await page.evaluate((at) => window.heightsAt(at), fractions);
    const input = places.map(([longitude, latitude]) => `${longitude} ${latitude}\n`).join('');
    const wanted = execFileSync('gdallocationinfo', ['-valonly', '-wgs84', 'heights.tif'],
      {cwd: folder, input, encoding: 'utf8'}).trim().split('\n').map(Number);
    const errors = places.map(([, , height], i) => height - wanted[i]);
    const rms = (values) => Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / values.length);
    if (PICTURES) console.log('heights are off by', rms(errors).toFixed(2), 'of', rms(wanted));
    assert.ok(rms(errors) < rms(wanted) / 5, `heights are ${rms(errors)} m off`);
  });
});
