// SPDX-License-Identifier: Apache-2.0
// bench/web_refine: processor time of frames (whole surface and texture) while a stream grows, by a
// decoder that goes on and by one that begins anew at each frame. Least of five runs.
import {readFile} from 'node:fs/promises';

import {Decoder} from '../../apps/web/src/stream_decoder.js';

const REQUEST = {mesh: false, surface: true, texture: true, texels: 4096, samples: 4096};
const module = await WebAssembly.compile(
  await readFile(new URL('../../apps/web/dist/tetrakis.wasm', import.meta.url)));
const bytes = new Uint8Array(await readFile(process.argv[2]));

function decoderOf(length) {
  const decoder = new Decoder(module, 2 ** 30);
  decoder.append(bytes.subarray(0, length));
  return decoder;
}

/** Milliseconds for frames at these numbers of bytes. */
function time(cuts, anew) {
  const growing = decoderOf(bytes.length);
  const start = process.cpuUsage();
  for (const cut of cuts) (anew ? decoderOf(cut) : growing).decode({...REQUEST, bytes: cut});
  return process.cpuUsage(start).user / 1000;
}

/** Least of the milliseconds for one part of the whole stream. */
function part(request) {
  const times = Array.from({length: 12}, () => {
    const decoder = decoderOf(bytes.length), start = process.cpuUsage();
    decoder.decode({...REQUEST, surface: false, texture: false, ...request, bytes: bytes.length});
    return process.cpuUsage(start).user / 1000;
  });
  return Math.min(...times).toFixed(0);
}

console.log(`texture ${part({texture: true})} ms, surface ${part({surface: true})} ms, ` +
  `mesh of 20000 triangles ${part({mesh: true, triangles: 20000})} ms`);
console.log('frames  anew ms  going on ms');
for (const frames of [4, 16]) {
  const cuts = Array.from({length: frames}, (_, i) =>
    frames === 4 ? bytes.length / 4 ** (3 - i) : (bytes.length * (i + 1)) / frames);
  const least = (anew) => Math.min(...[1, 2, 3, 4, 5].map(() => time(cuts, anew)));
  console.log(`${String(frames).padStart(6)}  ${least(true).toFixed(0).padStart(7)}  ` +
    least(false).toFixed(0).padStart(11));
}
