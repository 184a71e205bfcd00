// SPDX-License-Identifier: Apache-2.0
// bench/web_arrival: makes the files of all methods at equal PSNR of the picture, serves them, and
// times their arrival in Chromium on a link of 10 Mb/s and 50 ms.
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';

import {dracoGlb, glbOf, image, tilesOf} from './web_arrival_files.mjs';
import {Site} from './web_arrival_site.mjs';

const web = new URL('../../apps/web/', import.meta.url).pathname;
const require = createRequire(web + 'package.json');
const {chromium} = require('playwright-core');

const [cli, input, bytes, spacing, folder] = process.argv.slice(2);
const RUNS = 3;
const LINK = {
  latency: 50, downloadThroughput: 10e6 / 8, uploadThroughput: 10e6 / 8, offline: false,
};
/** Budgets of the GLBs' meshes, least and best quality of their pictures, and our triangles. */
const TRIANGLES = [20000, 80000];
const [WORST, BEST] = [5, 98];
const OURS = 40000;
const DECODER = {wasm: '/tetrakis.wasm', worker: '/worker.js'};
const DRACO = {draco: '/draco/'};

const texture = `${input}/texture.png`;
const make = (verb, file, ...options) => {
  execFileSync(cli, [verb, file, ...options, '-q', '-f']);
  return readFileSync(options[options.findIndex((option) => /^-o$|^--mesh$/.test(option)) + 1]);
};

/** The input's heights at a place on Earth, which tiles want: in UTM, at the equator. */
function placed() {
  const quiet = {stdio: ['ignore', 'pipe', 'ignore']};  // PROJ may not know its CRS
  const {size} = JSON.parse(execFileSync('gdalinfo', ['-json', `${input}/height.tif`], quiet));
  const [across, down] = size.map((samples) => String(samples * spacing));
  execFileSync('gdal_translate', ['-q', '-a_srs', 'EPSG:32632', '-a_ullr', '0', down, across, '0',
    `${input}/height.tif`, `${folder}/placed.tif`]);
  return `${folder}/placed.tif`;
}

const heights = placed();
make('encode', heights, '--texture', texture, '--lossless', '-o', `${folder}/whole.tks`);
const info = JSON.parse(execFileSync(cli, ['info', '--json', `${folder}/whole.tks`]));
const site = await Site.open(web);
const browser = await chromium.launch(
  {executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});

/** Opens a method's page in a context and gives its marks: [{ms, bytes, dB}]. */
async function opened(context, method, query, link) {
  const page = await context.newPage();
  try {
    if (link) {
      const session = await context.newCDPSession(page);
      await session.send('Network.enable');
      await session.send('Network.emulateNetworkConditions', link);
    }
    await page.goto(`${site.url}${method}.html?${new URLSearchParams({...query, ground})}`);
    await page.waitForFunction(() => document.body.dataset.state === 'done', null, {timeout: 3e5});
    const {failure, marks} = await page.evaluate(() =>
      ({failure: window.failure, marks: window.marks}));
    if (failure) throw new Error(`${method}: ${failure}`);
    return marks;
  } finally {
    await page.close();
  }
}
async function withContext(use) {
  const context = await browser.newContext({viewport: {width: 980, height: 560}});
  try {
    return await use(context);
  } finally {
    await context.close();
  }
}

const {width, height, geotransform: [, dx, , , , dy]} = info.heights;
const {computedMin, computedMax} = JSON.parse(execFileSync('gdalinfo', ['-json', '-mm', heights]))
  .bands[0];
const metres = (value) => value * info.heights.scale + info.heights.offset;
const middle = metres((computedMin + computedMax) / 2);
const [across, down] = [(width - 1) * dx, (height - 1) * -dy];
const ground = [across, down, middle].join();

/** Told the camera of scene.js, as the GLBs are chosen by its picture. */
const distance = 0.75 * across + 0.6 * down;
writeFileSync(`${folder}/camera.json`, JSON.stringify({
  cameras: [{
    eye: [0, middle + 0.6 * distance, 0.8 * distance], target: [0, middle, 0],
    fov_y: 40, width: 960, height: 540,
  }],
}));
make('encode', heights, '--texture', texture, '--bytes', bytes, '--cameras',
  `${folder}/camera.json`, '-o', `${folder}/ours.tks`);

const JUDGE = {judge: '/data/judge'};
const evaluation = await browser.newContext({viewport: {width: 980, height: 560}});
const quality = async (method, query) =>
  (await opened(evaluation, method, {...query, ...JUDGE}, null)).at(-1).dB;

/** The least quality from WORST to `best` that `reaches(quality)`; null: not even that. */
async function leastQuality(reaches, best = BEST) {
  if (!(await reaches(best))) return null;
  let low = WORST, high = best;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (await reaches(middle)) high = middle;
    else low = middle + 1;
  }
  return high;
}

const pictures = new Map();
function pictureOf(ending, level, halvings) {
  const key = `${halvings}_${level}.${ending}`;
  if (!pictures.has(key)) pictures.set(key, image(texture, level, halvings, `${folder}/${key}`));
  return pictures.get(key);
}

/** The smallest GLB whose picture has `target` dB. `maker(triangles)`: from picture to file. */
async function smallestGlb(method, ending, maker, target) {
  let best = null, nearest = -Infinity;
  const reachesWith = (glb, halvings) => async (level) => {
    site.set('/data/trial', glb(pictureOf(ending, level, halvings)));
    const dB = await quality(method, {data: '/data/trial', ...DRACO});
    nearest = Math.max(nearest, dB);
    return dB >= target;
  };
  for (const halvings of [0, 1]) {
    let enough = BEST;
    for (const triangles of TRIANGLES) {
      const glb = await maker(triangles);
      if (best && glb(Buffer.alloc(0)).length > best.file.length) break;
      const level = await leastQuality(reachesWith(glb, halvings), enough);
      if (level === null) continue;
      enough = level;  // finer meshes need no better pictures
      const file = glb(pictureOf(ending, level, halvings));
      const what = `${triangles} △, q ${level}${halvings ? ', half' : ''}`;
      if (!best || file.length < best.file.length) best = {file, what};
    }
  }
  if (!best) throw new Error(`${method}: reaches ${nearest} dB only`);
  return best;
}
const meshFile = (triangles, ...options) =>
  make('decode', `${folder}/whole.tks`, '--triangles', String(triangles), ...options,
    '--mesh', `${folder}/mesh.glb`);
const makers = {
  draco: async (triangles) =>
    (await dracoGlb(meshFile(triangles, '--mesh-texture', 'jpeg'))).withPicture,
  meshopt: async (triangles) => {
    const glb = meshFile(triangles, '--compress', 'meshopt', '--mesh-texture', 'webp');
    return (picture) => glbOf(glb, picture);
  },
};

/** The set of tiles whose last picture has `target` dB, or the best one. */
async function tileSet(target) {
  execFileSync(cli, ['tiles', `${folder}/whole.tks`, '-o', `${folder}/terrain`, '-q', '-f']);
  const serve = (level) => {
    const set = tilesOf(folder, texture, level, info, (name, contents) =>
      site.set(`/data/tiles/${name}`, contents, name.endsWith('.terrain')));
    site.set('/data/tiles.json', Buffer.from(JSON.stringify(set)), true);
  };
  const level = await leastQuality(async (trial) => {
    serve(trial);
    return (await quality('tiles', {data: '/data/tiles.json'})) >= target;
  });
  serve(level ?? BEST);
  return {query: {data: '/data/tiles.json'}, what: `JPEG q ${level ?? BEST}`};
}

/** Seconds that the link alone takes: a latency for each round of requests, and the bytes. */
const linkSeconds = (rounds, count) =>
  (rounds * LINK.latency) / 1000 + count / LINK.downloadThroughput;
/** Rounds before the data: the page, then its script with what comes beside it. */
const CODE_ROUNDS = 2;

/** Pairs of seconds, with nothing in the cache and with the page's code there: of the link, and
 * least ones of runs in the browser. */
async function arrival(method, query) {
  const cold = [], warm = [];
  let code;
  for (let i = 0; i < RUNS; ++i) {
    await withContext(async (context) => {
      const before = site.code;
      cold.push(await opened(context, method, query, LINK));
      code = site.code - before;
      warm.push(await opened(context, method, query, LINK));
    });
  }
  const marks = await opened(evaluation, method, {...query, ...JUDGE}, null);
  const least = (runs, i) => Math.min(...runs.map((run) => run[i].ms)) / 1000;
  const at = (i) => {
    const {bytes: count, dB, rounds} = marks[i];
    return {count, dB, seconds: [least(cold, i), least(warm, i)],
      link: [linkSeconds(CODE_ROUNDS + rounds, code + count), linkSeconds(rounds, count)]};
  };
  const enough = marks.findIndex(({dB}) => dB >= 0.95 * marks.at(-1).dB);
  return {code, first: at(0), enough: at(enough), last: at(marks.length - 1)};
}

const kB = (count) => (count / 1024).toFixed(0);
function row(name, what, {code, first, enough, last}) {
  const pair = (seconds) => seconds.map((each) => each.toFixed(2)).join(' / ');
  const cells = [name, what, kB(code)];
  for (const {count, dB, link, seconds} of [first, enough, last]) {
    cells.push(kB(count), dB.toFixed(1), pair(link), pair(seconds));
  }
  console.log(`| ${cells.join(' | ')} |`);
}

site.set('/data/whole.tks', readFileSync(`${folder}/whole.tks`));
site.set('/data/ours.tks', readFileSync(`${folder}/ours.tks`));
await opened(evaluation, 'judge', {...DECODER, data: '/data/whole.tks'}, null);
const ours = {...DECODER, data: '/data/ours.tks', triangles: OURS};
const target = await quality('tks', ours);
console.error(`all are made to reach ${target.toFixed(2)} dB`);

console.log(
  `${width} x ${height} heights, ${info.texture.width} x ${info.texture.height} texels; ` +
  `10 Mb/s, 50 ms. Seconds: nothing in the cache / the page's code in it; least of ${RUNS} runs.`);
const parts = ['first', '95 %', 'last'].map((name) => `${name} kB | dB | s of the link | s`);
console.log(`| | | code kB | ${parts.join(' | ')} |\n| --- | --- |${' --- |'.repeat(13)}`);
row('Tetrakis', `${OURS} △`, await arrival('tks', ours));
for (const [method, ending] of [['draco', 'jpg'], ['meshopt', 'webp']]) {
  const {file, what} = await smallestGlb(method, ending, makers[method], target);
  const data = site.set(`/data/${method}.glb`, file);
  row(`GLB, ${method} + ${ending}`, what, await arrival(method, {data, ...DRACO}));
}
const tiles = await tileSet(target);
row('quantized-mesh + JPEG tiles', tiles.what, await arrival('tiles', tiles.query));
await browser.close();
site.close();
