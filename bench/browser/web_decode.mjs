// SPDX-License-Identifier: Apache-2.0
// bench/web_decode: processor time of a texture, a surface and a mesh by the WebAssembly module and
// by the native decoder, whose runs alternate. Least of all runs.
import {execFileSync} from 'node:child_process';
import {readFile} from 'node:fs/promises';

import {Decoder} from '../../apps/web/src/stream_decoder.js';

const [native, file] = process.argv.slice(2);
const ROUNDS = 5, RUNS = 5, TRIANGLES = 20000;
const module = await WebAssembly.compile(
  await readFile(new URL('../../apps/web/dist/tetrakis.wasm', import.meta.url)));
const bytes = new Uint8Array(await readFile(file));

const parts = {
  texture: (opened) => opened.texels(opened.info()),
  surface: (opened) => opened.surface(opened.info()),
  mesh: (opened) => opened.mesh(TRIANGLES),
};

const decoder = new Decoder(module, 2 ** 30);
decoder.append(bytes);

/** Least milliseconds of each part, by a decoder that begins anew in memory that it has had before,
 * as a native program does. */
function wasm() {
  return Object.fromEntries(Object.entries(parts).map(([name, decode]) => {
    const times = Array.from({length: RUNS}, () => {
      const {headerBytes} = decoder.opened(bytes.length, (opened) => opened.info());
      decoder.opened(headerBytes, () => {});
      const start = process.cpuUsage();
      decoder.opened(bytes.length, decode);
      const {user, system} = process.cpuUsage(start);
      return (user + system) / 1000;
    });
    return [name, Math.min(...times)];
  }));
}

wasm();  // the engine compiles again what runs often
const ours = [], theirs = [];
for (let round = 0; round < ROUNDS; ++round) {
  ours.push(wasm());
  theirs.push(JSON.parse(execFileSync(native, [file, String(RUNS)])));
}
const least = (rounds, name) => Math.min(...rounds.map((round) => round[name]));
console.log('          WebAssembly ms  native scalar ms  ratio');
for (const name of Object.keys(parts)) {
  const [web, scalar] = [least(ours, name), least(theirs, name)];
  const cells = [web.toFixed(1).padStart(14), scalar.toFixed(1).padStart(17)];
  console.log([name.padEnd(9), ...cells, (web / scalar).toFixed(2).padStart(6)].join(' '));
}
