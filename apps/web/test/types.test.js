// SPDX-License-Identifier: Apache-2.0
// The declarations, as TypeScript takes them beside those of the libraries.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {mkdir, readFile, rm, writeFile} from 'node:fs/promises';
import {test} from 'node:test';

const web = new URL('..', import.meta.url).pathname;
const LIB = ['--lib', 'es2022,dom,dom.iterable,esnext.disposable'];
const RESOLUTIONS = [['esnext', 'bundler'], ['nodenext', 'nodenext']];

/** What the compiler says of files and of our own declarations. */
function complaints(files, [module, resolution]) {
  const {stdout} = spawnSync('node_modules/.bin/tsc', [
    '--noEmit', '--strict', '--target', 'es2022', ...LIB,
    '--module', module, '--moduleResolution', resolution, ...files,
  ], {cwd: web, encoding: 'utf8'});
  return stdout.split('\n').filter((line) => /^(src\/|test\/|dist\/|error)/.test(line));
}

test('what users write in TypeScript is accepted, with any kind of resolution', () => {
  for (const resolution of RESOLUTIONS) {
    assert.deepEqual(complaints(['test/user.ts'], resolution), [], resolution[1]);
  }
});

/** What README's examples, by their headings, take as given. */
const GIVEN = {
  'three.js': `import type {PerspectiveCamera, Scene, WebGLRenderer} from 'three';
    declare const scene: Scene, camera: PerspectiveCamera, renderer: WebGLRenderer;`,
  'MapLibre GL JS': `import * as maplibregl from 'maplibre-gl'; declare const map: maplibregl.Map;`,
  'Cesium': `import type {Scene} from '@cesium/engine'; declare const scene: Scene;`,
  'Any renderer': 'declare const signal: AbortSignal;',
  'Sequences': `import type {Scene} from 'three'; import type {Frame} from 'tetrakis';
    declare const scene: Scene, socket: AsyncIterable<Uint8Array>;
    declare const clip: number[], width: number, height: number;
    declare function show(frame: Frame): void;`,
  'Encoding': `declare const data: Int16Array, width: number, height: number, nodata: number;
    declare const geotransform: number[], imageData: ImageData, bar: HTMLProgressElement;
    declare const positions: Float32Array, triangles: number[], texcoords: Float32Array;
    declare const signal: AbortSignal;`,
};

/** What an example that goes on from the one before it takes as given besides. */
const PROJ4 = `import type {TksProtocol} from 'tetrakis/maplibre';
  type Place = [number, number];
  declare const protocol: TksProtocol;
  declare const proj4: (from: string, to: string) => {forward(place: Place): Place};`;

test('the examples of README are accepted', async () => {
  const readme = await readFile(web + 'README.md', 'utf8'), folder = web + 'dist/types-test/';
  await mkdir(folder, {recursive: true});
  try {
    const files = [];
    for (const section of readme.split(/^## /m)) {
      const heading = section.slice(0, section.indexOf('\n'));
      if (!(heading in GIVEN)) continue;
      for (const [, example] of section.matchAll(/```js\n(.*?)```/gs)) {
        files.push(`dist/types-test/${files.length}.mts`);
        const besides = example.includes('proj4(') ? PROJ4 : '';
        await writeFile(web + files.at(-1), `${GIVEN[heading]}\n${besides}\n${example}`);
      }
    }
    assert.equal(files.length, 15);
    assert.deepEqual(complaints(files, RESOLUTIONS[0]), []);
  } finally {
    await rm(folder, {recursive: true});
  }
});
