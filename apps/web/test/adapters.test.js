// SPDX-License-Identifier: Apache-2.0
// The four adapters in headless Chromium: they deliver the heights of the stream and draw the
// picture that the native renderer draws. It needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {cp, mkdir, readFile, rm, symlink, writeFile} from 'node:fs/promises';
import {after, before, test} from 'node:test';
import {build} from 'esbuild';

import {launch} from './chromium.js';
import {psnr} from './pictures.js';
import {serve} from './server.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const web = new URL('..', import.meta.url).pathname;
const folder = web + 'dist/adapters-test/', sample = folder + 'sample/';
/** Maps draw edges of tiles, and the ground ends somewhere. */
const BORDER = 16;
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
let browser, reader, server, reference;

/** What the page takes of libraries that browsers cannot load as they are. */
const LIBRARIES = {
  deck: `export {Deck, MapView} from '@deck.gl/core';
    export {TerrainLayer} from '@deck.gl/geo-layers';
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
  execFileSync(CLI, ['encode', sample + 'height.tif', '--texture', sample + 'texture.png',
    '--bytes', '64k', '-o', folder + 'alps.tks', '-q']);
  const vectors = new URL('../../../conformance/vectors/', import.meta.url);
  await cp(new URL('regions_joint_index_40x33_50x47.tks', vectors), folder + 'nowhere.tks');
  await Promise.all(Object.entries(LIBRARIES).map(([name, contents]) => build({
    stdin: {contents, resolveDir: web}, bundle: true, format: 'esm', outfile: `${folder}${name}.js`,
    external: ['node:*'], logLevel: 'error',
  })));
  // Cesium looks for both in one folder.
  await symlink(web + 'node_modules/@cesium/engine/Build/Workers', folder + 'Workers');
  await symlink(web + 'node_modules/@cesium/engine/Source/Assets', folder + 'Assets');
  server = await serve(web);
  browser = await launch({width: 256, height: 256});
  reader = await browser.newPage();
});
after(async () => {
  await browser?.close();
  await server?.close();
  await rm(folder, {recursive: true, force: true});
});

/** Opens the page with an adapter; gives its heights and its picture. */
async function drawn(adapter) {
  const page = await browser.newPage();
  try {
    const errors = [];
    page.on('pageerror', (error) => errors.push(error.message));
    await page.goto(`${server.url}test/adapters.html?adapter=${adapter}`);
    await page.waitForFunction(() => document.body.dataset.state === 'done', null, {timeout: 60000})
      .catch((error) => assert.fail(`${error.message} ${errors}`));
    const {failure, refusal, got, wanted, camera} = await page.evaluate(() => ({
      failure: window.failure, refusal: window.refusal, got: window.got, wanted: window.wanted,
      camera: window.camera,
    }));
    assert.equal(failure, undefined);
    const missing = server.requests.filter(({status}) => status === 404);
    assert.deepEqual([errors, missing], [[], []]);
    if (adapter === 'cesium') assert.match(refusal, /does not say where it lies/);
    const picture = await page.screenshot();
    if (PICTURES) await writeFile(`${PICTURES}/${adapter}.png`, picture);
    return {got, wanted, camera, picture};
  } finally {
    await page.close();
  }
}

/** What the native renderer draws of the stream for a camera. */
async function nativePicture(camera) {
  await writeFile(folder + 'camera.json', JSON.stringify({cameras: [camera]}));
  execFileSync(CLI, ['compare', folder + 'alps.tks', '--height', sample + 'height.tif', '--texture',
    sample + 'texture.png', '--cameras', folder + 'camera.json',
    '--pictures', folder + 'seen', '-f']);
  const picture = await readFile(folder + 'seen/picture-1.png');
  if (PICTURES) await writeFile(`${PICTURES}/native.png`, picture);
  return picture;
}

// Metres: maps and globes draw triangles of other vertices than the samples.
for (const [adapter, metres, least] of [
  ['three', 0.01, 35], ['deck', 0.01, 35], ['terrainLayer', 0.01, 35], ['maplibre', 15, 35],
  ['cesium', 10, 35],
]) {
  test(`${adapter} delivers and draws what the native renderer does`, {skip}, async () => {
    const {got, wanted, camera, picture} = await drawn(adapter);
    reference ??= await nativePicture(camera);
    const error = Math.sqrt(got.reduce((sum, height, i) => sum + (height - wanted[i]) ** 2, 0) /
      got.length);
    assert.ok(error <= metres, `heights are ${error} m off`);
    const area = {x: BORDER, y: BORDER, width: 256 - 2 * BORDER, height: 256 - 2 * BORDER};
    const alike = await psnr(reader, [reference, picture], [area, area]);
    if (PICTURES) console.log(adapter, error.toFixed(3), 'm', alike.toFixed(1), 'dB');
    assert.ok(alike >= least, `the picture is ${alike} dB from the native one`);
  });
}
