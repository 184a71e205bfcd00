// SPDX-License-Identifier: Apache-2.0
// The package as users install it, in a project of its own: README's example for three.js, and the
// encoder, in headless Chromium by way of each bundler, and of none. Nothing is configured. The
// bundlers (apps/web/bundlers) are installed when this runs first; without a network all is
// skipped.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {cp, mkdir, readFile, readdir, rm, stat, symlink, writeFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {after, before, test} from 'node:test';
import * as esbuild from 'esbuild';
import {chromium} from 'playwright-core';

import {serve} from './server.js';

const web = new URL('..', import.meta.url).pathname;
const bundlers = web + 'bundlers/', project = web + 'dist/bundlers-test/';
const vector = '../../conformance/vectors/joint_budget_97x97_128x128.tks';
const load = createRequire(bundlers);
let browser;

/** Whether npm has installed, or now installs, what apps/web/bundlers names. */
async function areInstalled() {
  const changed = (name) => stat(bundlers + name).then(({mtimeMs}) => mtimeMs, () => 0);
  if (await changed('node_modules/.package-lock.json') > await changed('package-lock.json')) {
    return true;
  }
  try {
    execFileSync('npm', ['ci', '--loglevel=error', '--no-fund', '--no-audit'],
      {cwd: bundlers, stdio: 'ignore', timeout: 300000});
    return true;
  } catch {
    return false;
  }
}
const skip = await areInstalled() ? false : 'npm cannot install the bundlers';

/** What README's example leaves to its page, the example, and an encoding. */
async function script() {
  const readme = await readFile(web + 'README.md', 'utf8');
  const [, example] = /## three\.js\n\n```js\n(.*?)```/s.exec(readme);
  return `
import {AmbientLight, DirectionalLight, PerspectiveCamera, Scene, WebGLRenderer} from 'three';
import {open} from 'tetrakis';
import {encode} from 'tetrakis/encode';

const renderer = new WebGLRenderer(), scene = new Scene(), sun = new DirectionalLight();
const camera = new PerspectiveCamera(50, 1, 1, 1e6);
camera.position.set(0, 2e4, 0);
camera.lookAt(0, 0, 0);
document.body.append(renderer.domElement);
${example}
async function coded() {
  const heights = {data: Uint8Array.from({length: 16}, (_, i) => i), width: 4, height: 4};
  const terrain = await open(await encode({heights}));
  const {surface} = await terrain.decode({mesh: false, surface: true});
  terrain.dispose();
  return surface.data.join();
}
coded().then((data) => (window.coded = data), (error) => (window.failure = error.message));
window.scene = scene;
`;
}

/** As npm packs it; `files` of package.json says the same. */
async function install() {
  const packed = project + 'node_modules/tetrakis/';
  await mkdir(packed + 'dist', {recursive: true});
  await cp(web + 'package.json', packed + 'package.json');
  await cp(web + 'src', packed + 'src', {recursive: true});
  const made = await readdir(web + 'dist');
  for (const name of made.filter((each) => /\.wasm$|^packed.*\.js$/.test(each))) {
    await cp(`${web}dist/${name}`, `${packed}dist/${name}`);
  }
  // Those for browsers without SIMD, which scripts/web makes for a release only.
  for (const name of ['tetrakis', 'tetrakis-encode', 'tetrakis-encode-object']) {
    await cp(`${web}dist/${name}.wasm`, `${packed}dist/${name}-plain.wasm`, {force: false});
  }
  await symlink(web + 'node_modules/three', project + 'node_modules/three');
}

const page = (head) => `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<body>${head}</body>`;
const MAP = {three: '/node_modules/three/build/three.module.js',
  tetrakis: '/node_modules/tetrakis/src/index.js',
  'tetrakis/three': '/node_modules/tetrakis/src/three.js',
  'tetrakis/encode': '/node_modules/tetrakis/src/encode.js'};

before(async () => {
  if (skip) return;
  await rm(project, {recursive: true, force: true});
  await mkdir(project + 'public', {recursive: true});
  await install();
  await writeFile(project + 'package.json', '{"private": true, "type": "module"}');
  await writeFile(project + 'main.js', await script());
  await writeFile(project + 'index.html', page('<script type="module" src="/main.js"></script>'));
  await writeFile(project + 'map.html', page(`<script type="importmap">
${JSON.stringify({imports: MAP})}</script><script type="module" src="/main.js"></script>`));
  await cp(web + vector, project + 'public/alps.tks');
  await cp(web + vector, project + 'alps.tks');
  browser = await chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
});
after(async () => {
  await browser?.close();
  await rm(project, {recursive: true, force: true});
});

/** Opens a page; it shows the stream, coded one, and decoded that. Gives what was fetched. */
async function shows(url) {
  const tab = await browser.newPage(), said = [], fetched = [];
  try {
    tab.on('pageerror', (error) => said.push(error.message));
    tab.on('console', (message) => said.push(message.text()));
    tab.on('response', (answer) => answer.ok() && fetched.push(new URL(answer.url()).pathname));
    await tab.goto(url);
    await tab.waitForFunction(() => window.failure ||
      (window.coded && window.scene.children.some(({material}) => material?.map)),
    null, {timeout: 60000}).catch((error) => assert.fail(`${error.message}: ${said.join('\n')}`));
    const {failure, coded} =
      await tab.evaluate(() => ({failure: window.failure, coded: window.coded}));
    assert.equal(failure, undefined);
    assert.equal(coded, Array.from({length: 16}, (_, i) => i).join());
    assert.ok(tab.workers().length > 0, 'the terrain has a worker');
    return fetched;
  } finally {
    await tab.close();
  }
}
/** Shows a folder; `follows`: of files of the package's own, without those packed in scripts. */
async function showsFolder(folder, follows, name = 'index.html') {
  const server = await serve(folder);
  try {
    const fetched = await shows(server.url + name);
    const modules = fetched.filter((path) => path.endsWith('.wasm'));
    assert.equal(modules.length, follows ? 2 : 0, fetched.join('\n'));
  } finally {
    await server.close();
  }
}
/** Beside the script that a bundler made: the page and the stream. */
async function showsBundle(folder, follows) {
  await writeFile(folder + 'index.html', page('<script type="module" src="main.js"></script>'));
  await cp(web + vector, folder + 'alps.tks');
  await showsFolder(folder, follows);
}

const timeout = 240000;
for (const version of [5, 6, 7, 8]) {
  const settings = {root: project, configFile: false, logLevel: 'silent',
    cacheDir: `${project}node_modules/.vite${version}`};
  const vite = () => import(`${bundlers}node_modules/vite${version}/dist/node/index.js`);
  test(`Vite ${version}, while developing`, {skip, timeout}, async () => {
    const server = await (await vite()).createServer(settings);
    try {
      await server.listen(0);
      await shows(server.resolvedUrls.local[0]);
    } finally {
      await server.close();
    }
  });
  test(`Vite ${version}, built`, {skip, timeout}, async () => {
    const outDir = `${project}vite${version}`;
    await (await vite()).build({...settings, build: {outDir}});
    await showsFolder(outDir, true);
  });
}

test('webpack', {skip, timeout}, async () => {
  const webpack = load('webpack'), path = project + 'webpack/';
  const stats = await new Promise((resolve, reject) => webpack({
    context: project, entry: './main.js', mode: 'production', output: {path},
    optimization: {minimize: false},  // most of the time
  }, (error, made) => (error ? reject(error) : resolve(made))));
  assert.deepEqual(stats.toJson({errors: true}).errors, []);
  await showsBundle(path, true);
});

test('esbuild', {skip, timeout}, async () => {
  const outdir = project + 'esbuild/';
  await esbuild.build({entryPoints: [project + 'main.js'], bundle: true, outdir});
  await showsBundle(outdir, false);
});

test('Rollup', {skip, timeout}, async () => {
  const {rollup} = load('rollup'), {nodeResolve} = load('@rollup/plugin-node-resolve');
  const bundle = await rollup({input: project + 'main.js', plugins: [nodeResolve()]});
  await bundle.write({dir: project + 'rollup', format: 'es'});
  await showsBundle(project + 'rollup/', false);
});

test('no bundler: an import map', {skip, timeout}, () => showsFolder(project, true, 'map.html'));
