// SPDX-License-Identifier: Apache-2.0
// Streams of several rasters: which there are, and frames of others than the first ones.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {before, test} from 'node:test';

import {TksError, open} from '../src/index.js';
import {Decoder} from '../src/stream_decoder.js';

const dist = new URL('../dist/tetrakis.wasm', import.meta.url);
const vectors = new URL('../../../conformance/vectors/', import.meta.url);
const read = async (name) => new Uint8Array(await readFile(new URL(name, vectors)));
let bytes, indexed, plain;

before(async () => {
  bytes = await read('components_40x30.tks');
  indexed = await read('components_index_70x60.tks');
  plain = await read('joint_budget_97x97_128x128.tks');
});

const rejects = (promise, code, pattern) =>
  assert.rejects(promise, (error) => {
    assert.ok(error instanceof TksError, String(error));
    assert.equal(error.code, code, error.message);
    assert.match(error.message, pattern);
    return true;
  });

/** A terrain that is closed behind the test. */
async function opened(t, input, options) {
  const terrain = await open(input, options);
  t.after(() => terrain.dispose());
  return terrain;
}

const ALL = {surface: true, samples: Infinity, texels: Infinity};

test('components are listed, with their bytes', async (t) => {
  const terrain = await opened(t, bytes);
  const {info} = await terrain.decode({mesh: false});
  const facts = info.components.map(({number, name, kind, width, height, taken}) =>
    [number, name, kind, width, height, taken]);
  assert.deepEqual(facts, [
    [0, '', 'heights', 40, 30, true],
    [1, '', 'texture', 61, 47, true],
    [2, 'later', 'heights', 40, 30, false],
    [3, 'classes', 'texture', 40, 30, false],
    [4, 'normals', 'texture', 33, 20, false],
  ]);
  assert.equal(info.components[0].bytes, info.geometryBytes);
  assert.equal(info.components[1].bytes, info.textureBytes);
  const sum = info.components.reduce((all, one) => all + one.bytes, 0);
  assert.ok(sum < info.streamBytes - info.headerBytes && sum > 0.9 * info.streamBytes - 500);
  const alone = await opened(t, plain);
  assert.deepEqual(alone.info.components.map(({kind, taken}) => [kind, taken]),
    [['heights', true], ['texture', true]]);
});

test('a frame of others is about these, and leaves the first ones as they were', async (t) => {
  const terrain = await opened(t, bytes);
  const first = await terrain.decode(ALL);
  const later = await terrain.decode({...ALL, component: 'later', normals: true});
  const normals = await terrain.decode({...ALL, component: 4});
  const both = await terrain.decode({...ALL, component: ['later', 'normals']});
  assert.deepEqual(terrain.info, first.info);
  assert.ok(later.info.hasVoids && !first.info.hasVoids);
  assert.deepEqual(later.info.components.map(({taken}) => taken),
    [false, true, true, false, false]);
  assert.notDeepEqual(later.surface.data, first.surface.data);
  assert.ok(later.surface.data.some(Number.isNaN) && later.mesh.normals.length > 0);
  assert.deepEqual(later.texture, first.texture);
  assert.deepEqual([normals.texture.width, normals.texture.height], [33, 20]);
  assert.deepEqual(normals.mesh, first.mesh);
  assert.deepEqual(both.surface, later.surface);
  assert.deepEqual(both.texture, normals.texture);
  assert.deepEqual(await terrain.decode(ALL), first);
});

test('prefixes of others are those of a terrain that was cut', async (t) => {
  const terrain = await opened(t, bytes);
  const {headerBytes} = terrain.info;
  for (let size = headerBytes; size < bytes.length; size += 531) {
    const cut = await opened(t, bytes.subarray(0, size));
    for (const component of ['later', 'normals', null]) {
      const asked = {...ALL, component};
      const [made, expected] =
        [await terrain.decode({...asked, bytes: size}), await cut.decode(asked)];
      assert.deepEqual(made, expected);
    }
  }
  const frames = [];
  for await (const frame of terrain.refine({component: 'later', surface: true})) frames.push(frame);
  assert.ok(frames.at(-1).complete && frames.at(-1).info.hasVoids);
});

test('levels are those of the component', async (t) => {
  const terrain = await opened(t, bytes);
  const {info} = await terrain.decode({component: 'normals', mesh: false});
  const {textureCoarsestLevel} = info;
  const asked = {component: 'normals', mesh: false, textureLevel: textureCoarsestLevel};
  assert.equal((await terrain.decode(asked)).texture.level, textureCoarsestLevel);
  await rejects(terrain.decode({...asked, textureLevel: textureCoarsestLevel + 1}), 'usage',
    /`textureLevel` is a mip level/);
});

test('plans and windows ask for bytes of the component', async (t) => {
  const module = await WebAssembly.compile(await readFile(dist));
  const terrain = await opened(t, indexed), {headerBytes} = terrain.info;
  // From aslant: heights that are off are not seen from above.
  const clip = [2 / 69, 0, 0, -1, 0, 2 / 59, 1e-4, -1, 0, 0, 0, 0, 0, 0, 0, 1];
  const view = {clip, width: 400, height: 400}, window = {x: 0, y: 0, width: 16, height: 16};
  const asked = {view, bytes: 1500, triangles: 20000, requestBytes: 0};
  const taken = [];
  for (const [component, heights] of [[['dem'], {}], [['dsm'], {component: 'dsm'}]]) {
    const decoder = new Decoder(module, 2 ** 30);
    decoder.append(indexed.subarray(0, headerBytes));
    const plan = decoder.plan({...asked, component}).filter(({gain}) => gain > 0);
    const needed = await terrain.needed({window, ...heights});
    assert.deepEqual(needed[0], [plan[0].begin, plan[0].end]);
    taken.push(plan.map(({begin, end}) => [begin, end]));
    for (const {begin, end} of plan) {
      decoder.put({place: begin, chunk: indexed.subarray(begin, end)});
    }
    const of = (name) => decoder.opened(Infinity, (o) => o.surface(o.info()), name);
    const flat = (surface) => new Set(surface).size === 1;
    assert.ok(!flat(of(component)) && flat(of(component[0] === 'dem' ? ['dsm'] : ['dem'])));
  }
  const [first, second] = taken;
  const apart = first.every(([b, e]) => second.every(([begin, end]) => e <= begin || end <= b));
  assert.ok(apart, JSON.stringify(taken));
});

test('what is no component is refused, and the terrain goes on', async (t) => {
  const terrain = await opened(t, bytes);
  for (const component of ['', 'Later', '5', 5, [0, 'x']]) {
    await rejects(terrain.decode({component}), 'usage', /no component/);
  }
  for (const component of [-1, 1.5, NaN, {}, true, 2 ** 32, [0, null]]) {
    await rejects(terrain.decode({component}), 'usage', /`component` is a name or a number/);
    await rejects(terrain.load(100, {component}), 'usage', /`component`/);
  }
  const unnamed = await opened(t, plain);
  await rejects(unnamed.decode({component: ''}), 'usage', /no component ""/);
  const crafted = await opened(t, await read('details_18x11.tks'));
  const kinds = crafted.info.components.map(({kind}) => kind);
  await rejects(crafted.decode({component: kinds.indexOf('unknown')}), 'unsupported', /not know/);
  assert.equal((await terrain.decode({component: '2'})).info.hasVoids, true);
});
