// SPDX-License-Identifier: Apache-2.0
// Bundles the viewer into dist/viewer: a folder that any static host serves, and `tetrakis view`.
import {build} from 'esbuild';
import {copyFile, mkdir, rm} from 'node:fs/promises';
import {fileURLToPath} from 'node:url';

const web = fileURLToPath(new URL('..', import.meta.url));
const out = `${web}dist/viewer/`;
await rm(out, {recursive: true, force: true});
await mkdir(out, {recursive: true});
await build({
  entryPoints: [
    {in: `${web}viewer/viewer.js`, out: 'viewer'},
    {in: `${web}src/worker.js`, out: 'worker'},
  ],
  outdir: out,
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'linked',
});
for (const name of ['index.html', 'style.css']) await copyFile(`${web}viewer/${name}`, out + name);
await copyFile(`${web}dist/tetrakis.wasm`, `${out}tetrakis.wasm`);
