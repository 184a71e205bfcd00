// SPDX-License-Identifier: Apache-2.0
// The viewer draws what the native renderer draws of the same stream from the same places. It needs
// a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {cp, mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {launch} from './chromium.js';
import {psnr} from './pictures.js';
import {serve} from './server.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
const [WIDTH, HEIGHT, FIELD] = [1000, 600, 45];
/** The middle of the viewer's picture lies so far left of that of the page. */
const ASIDE = 150;
const LEAST = 35;  // dB
/** The panels are hidden, and behind the ground lies the sky of the native renderer. */
const STYLE = `aside, header, #message, #bearings { display: none }
  #picture { background: linear-gradient(rgb(172 199 226), rgb(240 243 245)) }`;
/** Of a terrain of 3840 m: down on it, and across it to the sky. */
const PLACES = [
  {eye: [0, 2600, 500], target: [0, 500, -200]},
  {eye: [-700, 1900, 900], target: [300, 400, -300]},
];
let browser, reader, folder, native;

before(async () => {
  if (skip) return;
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await cp(new URL('../dist/viewer/', import.meta.url), folder, {recursive: true});
  const sample = join(folder, 'sample'), stream = join(folder, 'a.tks');
  const original = ['--texture', sample + '/texture.png'];
  execFileSync(CLI, ['synth', '-o', sample, '--size', '129', '-q']);
  execFileSync(CLI,
    ['encode', sample + '/height.tif', ...original, '--bytes', '64k', '-o', stream, '-q']);
  const cameras = PLACES.map((place) => ({...place, fov_y: FIELD, width: WIDTH, height: HEIGHT}));
  await writeFile(join(folder, 'cameras.json'), JSON.stringify({cameras}));
  execFileSync(CLI, ['compare', stream, '--height', sample + '/height.tif', ...original,
    '--cameras', join(folder, 'cameras.json'), '--pictures', join(folder, 'seen')]);
  native = await Promise.all(
    PLACES.map((_, i) => readFile(join(folder, `seen/picture-${i + 1}.png`))));
  browser = await launch();
  reader = await browser.newPage();
});
after(async () => {
  await browser?.close();
  if (folder) await rm(folder, {recursive: true});
});

/** The viewer's picture with all triangles, unlit, from a place. */
const drawn = (server, {eye, target}) => browser.withPage(async (page) => {
  await page.goto(`${server.url}index.html?tks=a.tks&eye=${eye}&target=${target}`);
  const done = () => page.waitForFunction(() => document.body.dataset.state === 'done');
  await done();
  await page.locator('#triangles').fill('1000');
  await done();
  await page.locator('#shaded').click();
  await page.waitForTimeout(300);
  return page.locator('#picture').screenshot({style: STYLE});
});

test('the viewer draws what the native renderer does', {skip}, async () => {
  const server = await serve(folder);
  const area = {y: 0, width: WIDTH - ASIDE, height: HEIGHT};
  try {
    for (const [i, place] of PLACES.entries()) {
      const picture = await drawn(server, place);
      if (PICTURES) {
        await writeFile(`${PICTURES}/viewer-${i}.png`, picture);
        await writeFile(`${PICTURES}/native-${i}.png`, native[i]);
      }
      const dB = await psnr(reader, [picture, native[i]], [{...area, x: 0}, {...area, x: ASIDE}]);
      if (PICTURES) console.log(`${dB.toFixed(1)} dB`);
      assert.ok(dB >= LEAST, `${dB} dB from ${place.eye}`);
    }
  } finally {
    await server.close();
  }
});
