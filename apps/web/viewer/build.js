// SPDX-License-Identifier: Apache-2.0
// Bundles the viewer into dist/viewer: a folder that any static host serves, and `tetrakis view`.
import {build} from 'esbuild';
import {copyFile, mkdir, rm} from 'node:fs/promises';
import {fileURLToPath} from 'node:url';

const web = fileURLToPath(new URL('..', import.meta.url));
const out = `${web}dist/viewer/`;
await rm(out, {recursive: true, force: true});
await mkdir(out, {recursive: true});
const bundle = (names, options) => build({
  entryPoints: names.map((name) => `${web}${name}.js`),
  outdir: out,
  entryNames: '[name]',
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'linked',
  ...options,
  // The viewer says where worker and modules lie: it needs none that are packed in scripts.
  external: ['../dist/packed*', ...(options?.external ?? [])],
});
// What the first script shares with what draws is a file of its own (chunk.js). What reads GeoTIFFs
// is as large as all the rest, and loaded when such a file is opened; so is what reads meshes, with
// its own copy of the parts of three.js that it needs.
const readers = ['read_files', 'read_mesh'];
await bundle(['viewer/start', 'viewer/viewer'],
  {splitting: true, chunkNames: '[name]', external: readers.map((name) => `./${name}.js`)});
await bundle(['src/worker', 'src/encode_worker']);
for (const name of readers) await bundle([`viewer/${name}`], {platform: 'browser'});
for (const name of ['index.html', 'style.css']) await copyFile(`${web}viewer/${name}`, out + name);
for (const name of ['tetrakis', 'tetrakis-encode', 'tetrakis-encode-object']) {
  await copyFile(`${web}dist/${name}.wasm`, `${out}${name}.wasm`);
}
