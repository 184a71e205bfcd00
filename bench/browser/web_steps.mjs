// SPDX-License-Identifier: Apache-2.0
// bench/web_steps: what each step costs while a stream arrives in doubled prefixes: processor time
// and memory of the decoder, and the longest task of a page's thread that shows it with three.js.
import {mkdtemp, readFile, rm, symlink, writeFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {basename, join, resolve} from 'node:path';

import {Decoder} from '../../apps/web/src/stream_decoder.js';
import {serve} from '../../apps/web/test/server.js';

const web = new URL('../../apps/web/', import.meta.url).pathname;
const {chromium} = createRequire(web + 'package.json')('playwright-core');
const FIRST = 4096, TRIANGLES = 20000, PIXELS = 512;
const module = await WebAssembly.compile(await readFile(web + 'dist/tetrakis.wasm'));

/** The memory of the instance that is made next. */
let memory;
WebAssembly.Instance = class extends WebAssembly.Instance {
  constructor(...given) {
    super(...given);
    ({memory} = this.exports);
  }
};

/** Steps of a decoder in this thread, as the worker of a page takes them. */
function steps(bytes) {
  const decoder = new Decoder(module, 2 ** 30), found = [];
  for (let here = 0, there = FIRST; here < bytes.length; there *= 2) {
    const end = Math.min(there, bytes.length), start = process.cpuUsage();
    decoder.append(bytes.subarray(here, end));
    const {texture} = decoder.decode({
      bytes: end, mesh: true, triangles: TRIANGLES, normals: true, texture: true, surface: false,
      texels: Infinity, samples: Infinity,
    });
    const {user, system} = process.cpuUsage(start);
    found.push({kB: end / 1000, side: texture.width, ms: (user + system) / 1000,
      MB: memory.buffer.byteLength / 2 ** 20});
    here = end;
  }
  return found;
}

const PAGE = `<!doctype html><link rel="icon" href="data:,"><script type="importmap">
{"imports": {"three": "/node_modules/three/build/three.module.js"}}</script>`;

/** Shows the first frame of a stream. `window.refine` shows the others. */
async function begin([url, pixels]) {
  const {PerspectiveCamera, Scene, WebGLRenderer} = await import('three');
  const {TksLoader} = await import('/src/three.js');
  const renderer = new WebGLRenderer(), camera = new PerspectiveCamera(), scene = new Scene();
  renderer.setSize(pixels, pixels);
  document.body.append(renderer.domElement);
  const terrain = await new TksLoader().loadAsync(url);
  scene.add(terrain);
  terrain.fit(camera);
  renderer.render(scene, camera);
  window.refine = async () => {
    const last = new Promise((resolve, reject) => {
      terrain.addEventListener('frame', ({frame}) => frame.complete && resolve());
      terrain.addEventListener('error', ({error}) => reject(error));
    });
    renderer.setAnimationLoop(() => {
      terrain.update(camera, 64 * pixels);  // as if texels were seen one by one
      renderer.render(scene, camera);
    });
    await last;
    await new Promise((resolve) => setTimeout(resolve, 3000));  // the texture comes in slices
    renderer.setAnimationLoop(null);
  };
}

/** Serves the page, the package and a stream as stream.tks. */
async function siteOf(file) {
  const folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  await writeFile(join(folder, 'index.html'), PAGE);
  for (const name of ['src', 'dist', 'node_modules']) await symlink(web + name, join(folder, name));
  await symlink(resolve(file), join(folder, 'stream.tks'));
  const {url, close} = await serve(folder);
  return {url, close: () => close().then(() => rm(folder, {recursive: true}))};
}

/** Processor time, in ms, of the tasks of the page's main thread behind the first frame, from the
 * longest on. */
async function tasks(file) {
  const site = await siteOf(file);
  const browser = await chromium.launch(
    {executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
  const page = await browser.newPage();
  await page.goto(site.url + 'index.html');
  await page.evaluate(begin, ['/stream.tks', PIXELS]);
  await browser.startTracing(page, {categories: ['toplevel', '__metadata']});
  await page.evaluate(() => window.refine());
  const {traceEvents} = JSON.parse(await browser.stopTracing());
  await browser.close();
  await site.close();
  const main = new Set(traceEvents.filter(({name, args}) =>
    name === 'thread_name' && args.name === 'CrRendererMain').map(({pid, tid}) => `${pid} ${tid}`));
  return traceEvents.filter(({pid, tid, tdur}) => tdur && main.has(`${pid} ${tid}`))
    .map(({tdur}) => tdur / 1000).sort((a, b) => b - a);
}

for (const file of process.argv.slice(2)) {
  console.log(basename(file));
  console.log('      kB  texels  processor ms  wasm MB');
  for (const {kB, side, ms, MB} of steps(new Uint8Array(await readFile(file)))) {
    console.log([kB.toFixed(0).padStart(8), String(side).padStart(7), ms.toFixed(0).padStart(13),
      MB.toFixed(0).padStart(8)].join(' '));
  }
  const longest = (await tasks(file)).slice(0, 5).map((ms) => ms.toFixed(0));
  console.log(`longest tasks of the page's thread: ${longest.join(', ')} ms`);
}
