// SPDX-License-Identifier: Apache-2.0
// The modules decode the very samples and triangles that the native decoder does: every cut of
// every conformance vector, streams and sequences, by the digests of its manifest.
import assert from 'node:assert/strict';
import {createHash} from 'node:crypto';
import {readFile} from 'node:fs/promises';
import {existsSync} from 'node:fs';
import {test} from 'node:test';

import {Groups} from '../src/groups.js';
import {LiveSource} from '../src/live_source.js';
import {Decoder} from '../src/stream_decoder.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);
const sequences = new URL('../../../conformance/sequences/', import.meta.url);
const dist = new URL('../dist/', import.meta.url);
const STATUS = {corrupt: 3, truncated: 4, unsupported: 5, limit: 6};

/** Of the samples of all frames, one behind the other. */
function digest(frames) {
  if (!frames[0]) return undefined;
  const hash = createHash('sha256');
  for (const samples of frames) hash.update(samples);
  return hash.digest('hex');
}

/** Of a triangle mesh all corners, triangle by triangle, then their places on a texture. */
function cornersOf({positions, texcoords, triangles}) {
  const of = (values, width) => Array.from(triangles, (vertex) =>
    Array.from(values.subarray(width * vertex, width * (vertex + 1))));
  return Float64Array.from([of(positions, 3), texcoords ? of(texcoords, 2) : []].flat(2));
}

/** Of samples as Decoder gives them. */
function addDigests(all, wanted) {
  for (const part of ['heights', 'texture']) {
    const made = digest(all.map((samples) => samples[part]));
    if (made) wanted[part] = made;
  }
}

/** What a module answers at a cut, as the manifest writes it. */
function answer(decoder, cut, hasMeshes) {
  const wanted = {bytes: cut.bytes, status: 0};
  if (cut.level) wanted.level = cut.level;
  if (cut.component !== undefined) wanted.component = cut.component;
  const component = cut.component === undefined ? [] : [cut.component];
  try {
    const {frames} = decoder.opened(cut.bytes, (opened) => opened.info(), component);
    const all = Array.from({length: frames}, (_, frame) =>
      decoder.samples(cut.bytes, cut.level ?? 0, frame, component));
    addDigests(all, wanted);
    const triangles = hasMeshes && decoder.opened(cut.bytes, (opened) =>
      (opened.info().objectTriangles ? cornersOf(opened.object(0)) : null), component);
    if (triangles) wanted.triangles = digest([triangles]);
  } catch (error) {
    wanted.status = STATUS[error.code] ?? error;
  }
  return wanted;
}

/** Of a sequence, all frames of groups that decode. */
async function sequenceAnswer(decoder, bytes, cut) {
  const calls = {ready: Promise.resolve(), call: async (name, argument) => decoder[name](argument)};
  const source = new LiveSource(), groups = new Groups(source, calls);
  source.append(bytes.slice(0, cut.bytes));
  await groups.walk();
  const wanted = {bytes: cut.bytes, status: groups.frames > 0 ? 0 : STATUS.truncated}, all = [];
  if (cut.level) wanted.level = cut.level;
  for (let frame = groups.firstFrame; frame < groups.frames; ++frame) {
    const {group} = await groups.find(frame, false, {});
    const at = frame - group.firstFrame;
    if (at >= group.times.length) continue;  // its group was left out
    try {
      if (at === 0) {
        const streams = await groups.streamsBefore(group, group.offset - group.bytesBack);
        const end = Math.min(group.streamOffset + group.streamBytes, cut.bytes);
        decoder.forget({goesOn: false, streams});
        decoder.append(bytes.slice(group.streamOffset, end));
      }
      all.push(decoder.samples(Infinity, cut.level ?? 0, at));
    } catch (error) {
      wanted.status ||= STATUS[error.code] ?? error;
      decoder.forget({goesOn: false, streams: []});
    }
  }
  if (all.length > 0) addDigests(all, wanted);
  return wanted;
}

/** What a module without meshes answers: it knows of no triangles, and of no fault of theirs. */
function withoutTriangles({triangles, ...cut}) {
  return cut.texture ? {...cut, status: 0} : cut;
}

for (const name of ['tetrakis', 'tetrakis-raster', 'tetrakis-plain']) {
  const file = new URL(`${name}.wasm`, dist);
  test(`${name} passes every conformance vector`, {skip: !existsSync(file)}, async () => {
    const hasMeshes = name !== 'tetrakis-raster';
    const expected = hasMeshes ? (cut) => cut : withoutTriangles;
    const module = await WebAssembly.compile(await readFile(file));
    const manifest = JSON.parse(await readFile(new URL('manifest.json', vectors), 'utf8'));
    for (const vector of manifest.vectors) {
      const bytes = new Uint8Array(await readFile(new URL(vector.file, vectors)));
      const decoder = new Decoder(module, 8 * 2 ** 30);
      decoder.append(bytes);
      for (const cut of vector.cuts) {
        assert.deepEqual(answer(decoder, cut, hasMeshes), expected(cut), vector.name);
      }
    }
  });
  test(`${name} passes every sequence`, {skip: !existsSync(file)}, async () => {
    const decoder = new Decoder(await WebAssembly.compile(await readFile(file)), 8 * 2 ** 30);
    const manifest = JSON.parse(await readFile(new URL('manifest.json', sequences), 'utf8'));
    for (const vector of manifest.vectors) {
      const bytes = new Uint8Array(await readFile(new URL(vector.file, sequences)));
      for (const cut of vector.cuts) {
        assert.deepEqual(await sequenceAnswer(decoder, bytes, cut), cut, vector.name);
      }
    }
  });
}
