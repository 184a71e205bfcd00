// SPDX-License-Identifier: Apache-2.0
// Meshes as the viewer reads them; what browsers alone have, pictures, is in mesh_viewer.test.js.
// Compressed ones need a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';

import {encodeObject} from '../src/encode.js';
import {open} from '../src/index.js';
import {readGltf} from '../viewer/gltf_parts.js';
import {joined} from '../viewer/joined_mesh.js';
import {readMesh} from '../viewer/read_mesh.js';
import {ballOf, glbFile, gltfOf, objOf, volumeOf} from './meshes.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const ball = ballOf(8), volume = volumeOf(ball);
const isClose = (a, b, part = 1e-5) =>
  assert.ok(Math.abs(a - b) <= part * Math.abs(b), `${a} is not ${b}`);

const read = (name, bytes) => readMesh(new File([bytes], name));
/** A .glb of the ball whose document is changed before. */
function changed(change) {
  const {document, bytes} = gltfOf(ball);
  change(document);
  return read('ball.glb', glbFile(document, bytes));
}

test('a GLB that is made by hand is read, coded, and decoded', async () => {
  const {mesh, remark} = await changed(() => {});
  assert.equal(remark, '');
  assert.deepEqual([mesh.unit, mesh.description, mesh.texture], ['m', 'ball', undefined]);
  assert.deepEqual([...mesh.triangles], ball.triangles);
  assert.ok(mesh.positions.every((value, i) => value === Math.fround(ball.positions[i])));
  const {stream} = await encodeObject({...mesh, bytes: 4000});
  assert.ok(stream.length <= 4000);
  const decoded = await open(stream);
  assert.deepEqual([decoded.info.isObject, decoded.info.unit], [true, 'm']);
  const {object} = await decoded.decode();
  isClose(volumeOf(object), volume, 0.02);
});

test('nodes move, turn and mirror their meshes, whose front stays outside', async () => {
  const half = Math.SQRT1_2;
  const {mesh, remark} = await changed((document) => {
    document.scenes[0].nodes = [0, 2];
    document.nodes = [
      {children: [1], translation: [10, 0, 0], scale: [2, 1, 1]},
      {mesh: 0, rotation: [0, 0, half, half]},
      {mesh: 0, scale: [-1, 3, 1]},
    ];
  });
  assert.equal(remark, '2 parts are joined');
  assert.equal(mesh.description, 'ball');
  isClose(volumeOf(mesh), (2 + 3) * volume);
  const [x, y, z] = mesh.positions;  // the ball's north pole, turned to the west
  assert.deepEqual([x, y, z].map((value) => Math.round(1e4 * value) / 1e4 + 0), [8, 0, 0]);
});

test('a mesh that a node draws several times is there as often', async () => {
  const name = 'EXT_mesh_gpu_instancing';
  const {mesh, remark} = await changed((document) => {
    document.extensionsUsed = [name];
    document.accessors.push({...document.accessors[0], count: 3});  // places, of some vertices
    document.nodes = [{mesh: 0, scale: [1, 2, 1], extensions: {[name]: {attributes: {
      TRANSLATION: 3}}}}];
  });
  assert.equal(remark, '3 parts are joined');
  isClose(volumeOf(mesh), 3 * 2 * volume);
  assert.equal(mesh.positions[1], 2 * (1 + 1));  // the north pole, moved by itself
});

test('the texture of most triangles counts, where its material places it', async () => {
  const scaled = {index: 0, extensions: {KHR_texture_transform: {scale: [0.5, 1],
    offset: [0.25, 0]}}};
  const describe = (document) => {
    document.images = [{uri: 'beside.png'}, {uri: 'other.png'}];
    document.textures = [{source: 0}, {source: 1}];
    document.materials = [{pbrMetallicRoughness: {baseColorTexture: scaled}},
      {extensions: {KHR_materials_pbrSpecularGlossiness: {diffuseTexture: {index: 1}}}}];
    document.accessors.push({...document.accessors[2], count: 30});
    const {primitives} = document.meshes[0];
    primitives.unshift({...primitives[0], material: 1, indices: 3});
  };
  const {remark} = await changed(describe);
  assert.equal(remark, '2 parts are joined, 1 part has a texture of its own that is left out, ' +
    'its texture is not read (it is another file)');
  const {document, bytes} = gltfOf(ball);
  describe(document);
  const {parts} = await readGltf(glbFile(document, bytes).buffer);
  const {mesh, material} = joined(parts, true), {length} = ball.texcoords;
  assert.equal(material.image, 0);
  assert.deepEqual([...mesh.texcoords.subarray(0, length)],
    [...Float32Array.from(ball.texcoords)]);
  assert.deepEqual([...mesh.texcoords.subarray(length)], [...Float32Array.from(ball.texcoords,
    (value, i) => (i % 2 === 0 ? Math.fround(value) / 2 + 0.25 : value))]);
});

test('formats agree on a mesh', async () => {
  const corner = (i) => ball.positions.slice(3 * ball.triangles[i], 3 * ball.triangles[i] + 3);
  const vertices = [], faces = [], facets = [];
  for (let i = 0; i < ball.positions.length; i += 3) {
    vertices.push(ball.positions.slice(i, i + 3).join(' '));
  }
  for (let i = 0; i < ball.triangles.length; i += 3) {
    faces.push(`3 ${ball.triangles.slice(i, i + 3).join(' ')}`);
    const corners = [0, 1, 2].map((k) => `vertex ${corner(i + k).join(' ')}`).join('\n');
    facets.push(`facet normal 0 0 0\nouter loop\n${corners}\nendloop\nendfacet`);
  }
  const files = {
    'a.obj': objOf(ball),
    'a.ply': `ply\nformat ascii 1.0\nelement vertex ${vertices.length}\nproperty float x\n` +
      `property float y\nproperty float z\nelement face ${faces.length}\n` +
      `property list uchar int vertex_indices\nend_header\n${[...vertices, ...faces].join('\n')}\n`,
    'a.stl': `solid a\n${facets.join('\n')}\nendsolid a\n`,
  };
  for (const [name, bytes] of Object.entries(files)) {
    const {mesh, remark} = await read(name, bytes);
    assert.equal(mesh.triangles.length, ball.triangles.length, name);
    isClose(volumeOf(mesh), volume);
    assert.deepEqual([mesh.unit, mesh.description], [undefined, 'a']);
    const isBare = name === 'a.obj';
    assert.equal(remark, isBare ? 'a picture for it can be dropped together with it' : '');
  }
});

test('what is damaged or not read is refused by a sentence', async () => {
  const refused = async (reading, reason) => assert.rejects(reading, ({message}) => {
    assert.match(message, /^ball\.glb cannot be read as a mesh: [^\n]*\.$/);
    assert.match(message, reason);
    return true;
  });
  await refused(changed((document) => { document.meshes[0].primitives[0].mode = 0; }),
    /it has no triangles/);
  await refused(changed((document) => { delete document.scenes; }), /it has no triangles/);
  await refused(changed((document) => { document.buffers[0].uri = 'ball.bin'; }),
    /another file, ball\.bin: make it a \.glb/);
  await refused(changed((document) => {
    document.extensionsUsed = ['KHR_draco_mesh_compression'];
  }), /Draco/);
  await refused(changed((document) => { document.accessors[0].count = 5; }),
    /triangle \d+ names a vertex that does not exist/);
  const {document, bytes} = gltfOf(ball), whole = glbFile(document, bytes);
  for (const length of [0, 10, 30, 900, whole.length - 2000]) {
    await refused(read('ball.glb', whole.subarray(0, length)), /it is damaged/);
  }
  bytes.set(new Uint8Array(Float32Array.of(NaN).buffer), 40);
  const {mesh} = await read('ball.glb', glbFile(document, bytes));
  await assert.rejects(encodeObject({...mesh, bytes: 900}), /Vertex 3 .* no finite place/);
});

test('the command line codes a file as the page does; meshopt is read, Draco is not', {skip},
  async () => {
    const folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
    const run = (...args) => execFileSync(CLI, [...args, '-q'], {cwd: folder});
    const {texcoords, ...bare} = ball;
    await writeFile(join(folder, 'ball.obj'), objOf(bare));
    run('encode', 'ball.obj', '--bytes', '2000', '-o', 'ball.tks');
    const {mesh} = await read('ball.obj', objOf(bare));
    const {stream} = await encodeObject({...mesh, bytes: 2000});
    const native = await readFile(join(folder, 'ball.tks'));
    assert.deepEqual(Buffer.from(stream), native);
    for (const compression of ['meshopt', 'draco']) {
      run('decode', 'ball.tks', '--mesh', 'ball.glb', '--compress', compression, '-f');
      const reading = read('ball.glb', await readFile(join(folder, 'ball.glb')));
      if (compression === 'draco') await assert.rejects(reading, /Draco/);
      else isClose(volumeOf((await reading).mesh), volume, 0.02);
    }
    await rm(folder, {recursive: true});
  });
