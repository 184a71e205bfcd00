// SPDX-License-Identifier: Apache-2.0
// The four adapters in headless Chromium: they deliver the same heights and draw the same picture.
// It needs a built `tetrakis` (TETRAKIS_CLI), which makes the stream.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {cp, mkdir, rm, symlink, writeFile} from 'node:fs/promises';
import {after, before, test} from 'node:test';
import {build} from 'esbuild';
import {chromium} from 'playwright-core';

import {serve} from './server.js';

const CLI = process.env.TETRAKIS_CLI ?? new URL('../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const web = new URL('..', import.meta.url).pathname;
const folder = web + 'dist/adapters-test/';
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
let browser, server, reference;

/** What the page takes of libraries that browsers cannot load as they are. */
const LIBRARIES = {
  deck: `export {Deck, MapView} from '@deck.gl/core';
    export {SimpleMeshLayer} from '@deck.gl/mesh-layers';
    export {load} from '@loaders.gl/core';`,
  cesium: `export {Cartesian3, Cartographic, CesiumWidget, Credit, Event, GeographicTilingScheme,
    HeightmapTerrainData, Math, Rectangle, TerrainProvider, TileAvailability, TileProviderError,
    sampleTerrainMostDetailed} from '@cesium/engine';`,
};

before(async () => {
  if (skip) return;
  await rm(folder, {recursive: true, force: true});
  await mkdir(folder, {recursive: true});
  execFileSync(CLI, ['synth', '-o', folder + 'sample', '--size', '129', '-q']);
  const sample = folder + 'sample/';
  execFileSync(CLI, ['encode', sample + 'height.tif', '--texture', sample + 'texture.png', '--bytes',
    '64k', '-o', folder + 'alps.tks', '-q']);
  const vectors = new URL('../../conformance/vectors/', import.meta.url);
  await cp(new URL('regions_joint_index_40x33_50x47.tks', vectors), folder + 'nowhere.tks');
  await Promise.all(Object.entries(LIBRARIES).map(([name, contents]) => build({
    stdin: {contents, resolveDir: web}, bundle: true, format: 'esm', outfile: `${folder}${name}.js`,
    external: ['node:*'], logLevel: 'error',
  })));
  // Cesium looks for both in one folder.
  await symlink(web + 'node_modules/@cesium/engine/Build/Workers', folder + 'Workers');
  await symlink(web + 'node_modules/@cesium/engine/Source/Assets', folder + 'Assets');
  server = await serve(web);
  browser = await chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
});
after(async () => {
  await browser?.close();
  await server?.close();
  await rm(folder, {recursive: true, force: true});
});

/** Opens the page with an adapter; gives its heights and its picture. */
async function drawn(adapter) {
  const page = await browser.newPage({viewport: {width: 256, height: 256}});
  try {
    const errors = [];
    page.on('pageerror', (error) => errors.push(error.message));
    await page.goto(`${server.url}test/adapters.html?adapter=${adapter}`);
    await page.waitForFunction(() => document.body.dataset.state === 'done', null, {timeout: 60000})
      .catch((error) => assert.fail(`${error.message} ${errors}`));
    const {failure, refusal, got, wanted} = await page.evaluate(() => ({
      failure: window.failure, refusal: window.refusal, got: window.got, wanted: window.wanted,
    }));
    assert.equal(failure, undefined);
    const missing = server.requests.filter(({status}) => status === 404);
    assert.deepEqual([errors, missing], [[], []]);
    if (adapter === 'cesium') assert.match(refusal, /does not say where it lies/);
    const picture = await page.screenshot();
    if (PICTURES) await writeFile(`${PICTURES}/${adapter}.png`, picture);
    return {got, wanted, picture};
  } finally {
    await page.close();
  }
}

/** dB between two pictures, away from their borders. */
async function psnr(a, b) {
  const page = await browser.newPage();
  try {
    return await page.evaluate(async (pictures) => {
      const pixels = async (base64) => {
        const blob = await (await fetch('data:image/png;base64,' + base64)).blob();
        const image = await createImageBitmap(blob), {width, height} = image;
        const context = new OffscreenCanvas(width, height).getContext('2d');
        context.drawImage(image, 0, 0);
        return context.getImageData(16, 16, width - 32, height - 32).data;
      };
      const [x, y] = await Promise.all(pictures.map(pixels));
      const squares = x.reduce((sum, value, i) => sum + (value - y[i]) ** 2, 0);
      return 10 * Math.log10(255 ** 2 / ((squares * 4) / 3 / x.length));
    }, [a, b].map((picture) => picture.toString('base64')));
  } finally {
    await page.close();
  }
}

// Metres: maps and globes draw triangles of other vertices than the samples.
for (const [adapter, metres, least] of [
  ['three', 0.01, Infinity], ['deck', 0.01, 30], ['maplibre', 15, 30], ['cesium', 10, 30],
]) {
  test(`${adapter} delivers and draws the surface that the others do`, {skip}, async () => {
    const {got, wanted, picture} = await drawn(adapter);
    reference ??= picture;
    const error = Math.sqrt(got.reduce((sum, height, i) => sum + (height - wanted[i]) ** 2, 0) /
      got.length);
    assert.ok(error <= metres, `heights are ${error} m off`);
    const alike = await psnr(reference, picture);
    if (PICTURES) console.log(adapter, error.toFixed(3), 'm', alike.toFixed(1), 'dB');
    assert.ok(alike >= least, `the picture is ${alike} dB from that of three.js`);
  });
}
