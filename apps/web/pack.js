// SPDX-License-Identifier: Apache-2.0
// Packs each module of WebAssembly, with the source of its worker, into a script, dist/packed*.js:
// what src/compile.js and src/own_worker.js take where a bundler leaves other files behind.
import {build} from 'esbuild';
import {readFile, writeFile} from 'node:fs/promises';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';

const web = fileURLToPath(new URL('.', import.meta.url));

async function pack(worker, module, out) {
  const {outputFiles: [script]} = await build({
    entryPoints: [`${web}src/${worker}.js`],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2022',
    write: false,
  });
  const packed = gzipSync(await readFile(`${web}dist/${module}.wasm`), {level: 9});
  await writeFile(`${web}dist/${out}.js`, '// SPDX-License-Identifier: Apache-2.0\n' +
    `export const module = '${packed.toString('base64')}';\n` +
    `export const worker = ${JSON.stringify(script.text)};\n`);
}

await pack('worker', 'tetrakis', 'packed');
await pack('encode_worker', 'tetrakis-encode', 'packed_encode');
await pack('encode_worker', 'tetrakis-encode-object', 'packed_encode_object');
