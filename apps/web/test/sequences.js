// SPDX-License-Identifier: Apache-2.0
// Sequences for tests, which the command line makes (TETRAKIS_CLI: a built `tetrakis`).
import assert from 'node:assert/strict';
import {execFile} from 'node:child_process';
import {mkdtemp, readFile, readdir, rm} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {promisify} from 'node:util';
import {fromArrayBuffer} from 'geotiff';

export const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const run = promisify(execFile);

/** Of decode(): the heights alone. */
export const HEIGHTS = {mesh: false, surface: true};

/** Calls use(opened), and disposes that. */
export async function using(opening, use) {
  const opened = await opening;
  try {
    return await use(opened);
  } finally {
    opened.dispose();
  }
}
/** Samples of synth are tenths of metres. */
export const equal = ({data}, raster) =>
  assert.deepEqual(data.map((height) => Math.round(10 * height)), Float32Array.from(raster));

async function samplesOf(file) {
  const tiff = await fromArrayBuffer((await readFile(file)).buffer);
  return (await (await tiff.getImage()).readRasters())[0];
}

/**
 * Frames of synth's kind `heights` with, or without it alone, a texture of kind `texture`, coded
 * with further arguments of encode: {bytes, rasters}, rasters being the samples of the heights.
 */
export async function sequenceOf({heights, texture, frames, size}, ...options) {
  const folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  try {
    const inputs = [];
    for (const [kind, ending, first] of
      [[heights, 'tif', []], [texture, 'png', ['--texture']]]) {
      if (!kind) continue;
      await run(CLI, ['synth', '-q', '--kind', kind, '--frames', frames, '--size', size,
        '-o', join(folder, kind)].map(String));
      inputs.push(...first, join(folder, kind, `*.${ending}`));
    }
    const out = join(folder, 'out.tks');
    await run(CLI, ['encode', '-q', ...inputs, ...options.map(String), '-o', out]);
    const names = heights ? (await readdir(join(folder, heights))).sort() : [];
    const rasters = await Promise.all(names.map((name) => samplesOf(join(folder, heights, name))));
    return {bytes: new Uint8Array(await readFile(out)), rasters};
  } finally {
    await rm(folder, {recursive: true});
  }
}

/** Runs use({modules, size}): how many modules were instantiated within, and how much memory they
 * have. */
export async function countingMemory(use) {
  const memories = [], {Instance} = WebAssembly;
  WebAssembly.Instance = class extends Instance {
    constructor(...parts) {
      super(...parts);
      memories.push(this.exports.memory);
    }
  };
  try {
    await use({
      modules: () => memories.length,
      size: () => memories.reduce((sum, {buffer}) => sum + buffer.byteLength, 0),
    });
  } finally {
    WebAssembly.Instance = Instance;
  }
}
