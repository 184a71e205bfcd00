// SPDX-License-Identifier: Apache-2.0
// Objects by the JS API: which streams hold one, closed meshes at any prefix, normals without
// seams, and texture coordinates and textures as `tetrakis decode` writes them (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import {fromArrayBuffer} from 'geotiff';

import {TksLoader as DeckLoader} from '../src/deck.js';
import {encode} from '../src/encode.js';
import {goesRound, open} from '../src/index.js';
import {TksProtocol} from '../src/maplibre.js';
import {centreOf} from '../src/object.js';
import {PatchAtlas} from '../src/patch_atlas.js';
import {earthOnCube} from './earth.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const vectors = new URL('../../../conformance/vectors/', import.meta.url);
const bytesOf = async (name) => new Uint8Array(await readFile(new URL(name, vectors)));
/** Their Euler characteristics and numbers of open edges. */
const OBJECTS = {
  'object_torus_9x144.tks': [0, 0], 'object_joint_9x54_17x102.tks': [2, 0],
};

async function withStream(input, use) {
  const terrain = await open(input);
  try {
    await use(terrain);
  } finally {
    terrain.dispose();
  }
}

/** For each vertex the number of its position. */
function welded({positions}) {
  const numbers = new Map();
  return Array.from({length: positions.length / 3}, (_, v) => {
    const key = positions.subarray(3 * v, 3 * v + 3).join();
    if (!numbers.has(key)) numbers.set(key, numbers.size);
    return numbers.get(key);
  });
}

/** Euler characteristic and open edges; an edge has its triangles on either side. */
function shapeOf(object) {
  const vertex = welded(object), edges = new Set(), {triangles} = object;
  for (let t = 0; t < triangles.length; ++t) {
    const a = vertex[triangles[t]], b = vertex[triangles[t % 3 === 2 ? t - 2 : t + 1]];
    assert.ok(!edges.has(`${a} ${b}`), 'triangles at an edge are of one orientation');
    edges.add(`${a} ${b}`);
  }
  const isOpen = (edge) => !edges.has(edge.split(' ').reverse().join(' '));
  const open = [...edges].filter(isOpen).length;
  const all = (edges.size + open) / 2;
  return [new Set(vertex).size - all + triangles.length / 3, open];
}

test('info tells objects from other forests, and their unit', async () => {
  for (const name of [...Object.keys(OBJECTS), 'object_open_17x68.tks']) {
    await withStream(await bytesOf(name), ({info}) => {
      assert.equal(info.isObject, true, name);
      for (const domain of [info.domain, info.hasTexture ? info.textureDomain : 'forest'])
        assert.equal(domain, 'forest', name);
      assert.equal(info.objectTriangles, 0);
      assert.equal(typeof info.unit, 'string');
      assert.equal(goesRound(info), false);
    });
  }
  for (const name of ['forest_torus_33x33.tks', 'forest_cube_17x102.tks', 'rgb_50x37.tks',
    'geometry_budget_129x97.tks']) {
    await withStream(await bytesOf(name), ({info}) => assert.equal(info.isObject, false, name));
  }
  await withStream(await encode({...earthOnCube(3), bytes: 4000}), ({info}) => {
    assert.deepEqual([info.isObject, info.domain], [false, 'cube']);
  });
});

test('at any prefix a mesh is as closed as its base, with as many triangles', async () => {
  for (const [name, shape] of Object.entries(OBJECTS)) {
    const bytes = await bytesOf(name);
    await withStream(bytes, async (terrain) => {
      for (let size = 0; size < 2 * bytes.length; size += bytes.length / 7) {
        for (const triangles of [60, 200, Infinity]) {
          const {object, mesh} = await terrain.decode({bytes: size, triangles});
          assert.equal(mesh, undefined);
          assert.ok(object.triangles.length / 3 <= triangles);
          assert.deepEqual(shapeOf(object), shape, `${name}, ${size} bytes, ${triangles}`);
        }
      }
    });
  }
});

test('positions count from one centre in all frames of a stream', async () => {
  for (const name of Object.keys(OBJECTS)) {
    await withStream(await bytesOf(name), async (terrain) => {
      const frames = [];
      for await (const frame of terrain.refine({first: {triangles: 20}})) frames.push(frame);
      frames.push(await terrain.decode({bytes: 0}));
      for (const {object: {centre}} of frames) assert.deepEqual(centre, frames[0].object.centre);
    });
  }
});

test('a centre leaves positions small, and is 0 where the origin is inside', () => {
  for (let i = 0; i < 300; ++i) {
    const random = () => ((Math.imul(i + 1, 0x9e3779b1) >>> 0) / 2 ** 32 * 997) % 1;
    const size = 10 ** (12 * random() - 6), away = 10 ** (12 * random() - 6) * (i % 3);
    const positions = Float64Array.from({length: 30}, (_, k) =>
      away * (k % 3) + size * Math.sin(k * (i + 1)));
    const centre = centreOf(positions), axes = [0, 1, 2];
    const of = (axis) => positions.filter((_, k) => k % 3 === axis);
    const reach = Math.hypot(...axes.map((a) => Math.max(...of(a)) - Math.min(...of(a))));
    for (const axis of axes) {
      for (const value of of(axis)) assert.ok(Math.abs(value - centre[axis]) <= 3 * reach);
    }
    if (axes.every((a) => Math.min(...of(a)) <= 0 && Math.max(...of(a)) >= 0)) {
      assert.deepEqual(centre, [0, 0, 0]);
    }
  }
  for (const value of [0, 7, Infinity, NaN]) {
    assert.deepEqual(centreOf(new Float64Array(6).fill(value)),
      Array(3).fill(Number.isFinite(value) ? value : 0));
  }
  assert.deepEqual(centreOf(new Float64Array(0)), [0, 0, 0]);
});

test('normals are of length 1, equal at one position, and means by areas', async () => {
  for (const name of Object.keys(OBJECTS)) {
    await withStream(await bytesOf(name), async (terrain) => {
      const {object: {positions, normals, triangles}} =
        await terrain.decode({bytes: 0, triangles: Infinity, normals: true});
      const vertex = welded({positions}), seen = [];
      const vector = (array, v) => [...array.subarray(3 * v, 3 * v + 3)];
      vertex.forEach((number, v) => {
        assert.ok(Math.abs(Math.hypot(...vector(normals, v)) - 1) < 1e-6);
        assert.deepEqual(seen[number] ??= vector(normals, v), vector(normals, v));
      });
      const sums = [];
      for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => vector(positions, triangles[t + k]));
        const [p, q] = [b, c].map((to) => to.map((value, axis) => value - a[axis]));
        const area =
          [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        for (let k = 0; k < 3; ++k) {
          const sum = sums[vertex[triangles[t + k]]] ??= [0, 0, 0];
          area.forEach((part, axis) => (sum[axis] += part));
        }
      }
      seen.forEach((normal, number) => normal.forEach((part, axis) =>
        assert.ok(Math.abs(part - sums[number][axis] / Math.hypot(...sums[number])) < 1e-4)));
    });
  }
});

/** The RGBA that a linear filter finds at a place of a picture, from 0 to 1. */
function filtered({width, height, data}, u, v) {
  const x = u * width - 0.5, y = v * height - 0.5, left = Math.floor(x), top = Math.floor(y);
  const at = (column, row, channel) => data[4 * (row * width + column) + channel];
  return [0, 1, 2, 3].map((channel) => {
    const row = (down) => (1 - x + left) * at(left, top + down, channel) +
      (x - left) * at(left + 1, top + down, channel);
    return (1 - y + top) * row(0) + (y - top) * row(1);
  });
}

test('patches of an atlas meet in equal colours, at each size that it may have', async () => {
  await withStream(await bytesOf('object_joint_9x54_17x102.tks'), async (terrain) => {
    const levels = [];
    for (const texels of [4096, 57, 56, 30, 20, 1]) {
      const {object, texture} = await terrain.decode({texels, triangles: Infinity});
      levels.push(texture.level);
      assert.equal(texture.data.length, 4 * texture.width * texture.height);
      const vertex = welded(object), colours = [];
      vertex.forEach((number, v) => {
        const colour = filtered(texture, ...object.texcoords.subarray(2 * v, 2 * v + 2));
        colours[number] ??= colour;
        assert.ok(colour.every((part, k) => Math.abs(part - colours[number][k]) < 0.01),
          `${colour} and ${colours[number]}`);
      });
      assert.ok(vertex.length > colours.length, 'there are seams');
    }
    // 3 x 2 cells of 19, 11, 7, 5 and 4 texels.
    assert.deepEqual(levels, [0, 0, 1, 2, 3, 4]);
  });
});

test('an atlas shows each texel at its place, and repeats borders around patches', () => {
  for (const patches of [1, 2, 5, 17]) {
    for (const side of [3, 9]) {
      const texels = Uint8ClampedArray.from({length: 4 * patches * side * side},
        (_, i) => Math.imul(i + 1, 0x9e3779b1) >>> 24);
      const atlas = new PatchAtlas(patches, side), last = side - 1;
      const {width, height, data} = atlas.pictureOf(texels);
      for (let patch = 0; patch < patches; ++patch) {
        for (let i = 0; i < (side + 2) ** 2; ++i) {
          const x = i % (side + 2) - 1, y = Math.floor(i / (side + 2)) - 1;
          const [u, v] = atlas.at(patch, x / last, y / last);
          const within = (place) => Math.min(Math.max(place, 0), last);
          const from = 4 * ((patch * side + within(y)) * side + within(x));
          const to = 4 * (Math.floor(v * height) * width + Math.floor(u * width));
          assert.deepEqual(data.subarray(to, to + 4), texels.subarray(from, from + 4));
        }
      }
    }
  }
});

test('an object without a texture has no place on one, and no adapter one on Earth', async () => {
  const bytes = await bytesOf('object_torus_9x144.tks');
  await withStream(bytes, async (terrain) => {
    const {object, texture} = await terrain.decode();
    assert.deepEqual([object.texcoords, texture], [undefined, undefined]);
    await assert.rejects(terrain.decode({globe: {}}), {code: 'usage'});
  });
  await assert.rejects(DeckLoader.parse(bytes.buffer, {}), {code: 'unsupported'});
  await assert.rejects(new TksProtocol().add('torus', bytes), {code: 'unsupported'});
});

/** The accessors of a .glb's mesh as arrays, and its indices. */
function partsOf(glb) {
  const view = new DataView(glb.buffer, glb.byteOffset), length = view.getUint32(12, true);
  const {meshes, accessors, bufferViews} =
    JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length)));
  const {attributes, indices} = meshes[0].primitives[0];
  const arrayOf = (accessor) => {
    const {bufferView, byteOffset = 0, count, type, componentType} = accessors[accessor];
    const begin = glb.byteOffset + 28 + length + (bufferViews[bufferView].byteOffset ?? 0);
    const size = count * {SCALAR: 1, VEC2: 2, VEC3: 3}[type];
    const Type = {5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array}[componentType];
    const end = begin + byteOffset + size * Type.BYTES_PER_ELEMENT;
    return Array.from(new Type(glb.buffer.slice(begin + byteOffset, end)));
  };
  return {
    positions: arrayOf(attributes.POSITION), normals: arrayOf(attributes.NORMAL),
    texcoords: arrayOf(attributes.TEXCOORD_0), triangles: arrayOf(indices),
  };
}

/** Calls use({folder, run, file}): a folder, the command line in it, and how its files are read. */
async function withFolder(use) {
  const folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  try {
    await use({
      folder, run: (...args) => execFileSync(CLI, [...args, '-q'], {cwd: folder}),
      file: async (name) => new Uint8Array(await readFile(join(folder, name))),
    });
  } finally {
    await rm(folder, {recursive: true});
  }
}

test('an object far from the origin lies where it lay', {skip, timeout: 60000}, async () => {
  await withFolder(async ({folder, run, file}) => {
    const away = [500, 60, -2000], corners = [[], [], []];
    run('synth', '--kind', 'blob', '--triangles', '500', '-o', 'blob.obj');
    const near = new TextDecoder().decode(await file('blob.obj'));
    await writeFile(join(folder, 'far.obj'), near.replace(/^v (.*)$/gm, (_, numbers) =>
      'v ' + numbers.split(' ').slice(0, 3).map((number, axis) => {
        corners[axis].push(Number(number) + away[axis]);
        return corners[axis].at(-1);
      }).join(' ')));
    for (const kind of ['resampled', 'triangles']) {
      run('encode', 'far.obj', '--bytes', '12k', '--class', kind, '-o', 'far.tks', '-f');
      await withStream(await file('far.tks'), async (terrain) => {
        const {object: {centre, positions}} = await terrain.decode();
        for (const axis of [0, 1, 2]) {
          const own = positions.filter((_, i) => i % 3 === axis);
          assert.ok(own.every((value) => Math.abs(value) < 12), 'some diagonals');
          for (const most of [Math.min, Math.max]) {
            const differs = most(...own) + centre[axis] - most(...corners[axis]);
            assert.ok(Math.abs(differs) < 0.02, `${differs}`);
          }
        }
      });
    }
  });
});

for (const [kind, count] of [['resampled', 3000], ['triangles', 1980]]) {
  test(`mesh and texture are those of the command line: ${kind}`, {skip, timeout: 60000},
    async () => {
      await withFolder(async ({run, file}) => {
        run('synth', '--kind', 'knot', '--triangles', '2000', '-o', 'knot.glb');
        run('encode', 'knot.glb', '--bytes', '12k', '--class', kind, '-o', 'knot.tks');
        run('decode', 'knot.tks', '--triangles', '3000', '--mesh', 'out.glb',
          '--texture', 'out.tif');
        const {buffer} = await file('out.tif'), tiff = await fromArrayBuffer(buffer);
        const image = await tiff.getImage(), rgb = await image.readRasters({interleave: true});
        const glb = partsOf(await file('out.glb'));
        await withStream(await file('knot.tks'), async (terrain) => {
          const isAsItIs = kind === 'triangles';
          const {object, texture} = await terrain.decode({triangles: 3000, normals: !isAsItIs});
          assert.ok(Math.abs(object.triangles.length / 3 - count) < 30);
          assert.deepEqual(object.centre, [0, 0, 0]);
          for (const name of ['positions', 'texcoords', 'triangles'])
            assert.deepEqual(Array.from(object[name]), glb[name], name);
          object.normals?.forEach((part, i) => assert.ok(Math.abs(part - glb.normals[i]) < 1e-6));
          assert.deepEqual([texture.width, texture.height], [image.getWidth(), image.getHeight()]);
          assert.deepEqual(Array.from(texture.data.filter((_, i) => i % 4 < 3)), Array.from(rgb));
          assert.equal(texture.repeats, isAsItIs || undefined);
        });
      });
    });
}

test('triangles that are coded as they are come all at once', {skip, timeout: 60000}, async () => {
  await withFolder(async ({run, file}) => {
    run('synth', '--kind', 'knot', '--triangles', '2000', '-o', 'knot.glb');
    run('encode', 'knot.glb', '--bytes', '20k', '--class', 'triangles', '-o', 'knot.tks');
    const bytes = await file('knot.tks');
    await withStream(bytes, async (terrain) => {
      const {info} = terrain, whole = await terrain.decode({normals: true});
      assert.deepEqual([info.isObject, info.hasHeights, info.domain], [true, false, 'plane']);
      assert.equal(info.objectTriangles, whole.object.triangles.length / 3);
      const few = await terrain.decode({triangles: 300, normals: true});
      assert.ok(few.object.triangles.length <= 3 * 300 && few.object.triangles.length > 3 * 290);
      const psnrs = [];
      for (let part = 0; part <= 1; part += 0.25) {
        const frame = await terrain.decode(
          {bytes: part * bytes.length, triangles: 300, texels: 64, normals: true});
        assert.deepEqual(frame.object, few.object);
        assert.ok(Math.max(frame.texture.width, frame.texture.height) <= 64);
        psnrs.push(frame.info.texturePsnr);
      }
      psnrs.forEach((psnr, i) => assert.ok(i === 0 || psnr > psnrs[i - 1], `${psnrs}`));
      assert.equal((await terrain.decode({mesh: false})).object, undefined);
      await assert.rejects(terrain.decode({globe: {}}), {code: 'usage'});
    });
    await assert.rejects(DeckLoader.parse(bytes.buffer, {}), {code: 'unsupported'});
    const bounds = [7, 46, 8, 47];
    await assert.rejects(new TksProtocol().add('knot', bytes, {bounds}), {code: 'unsupported'});
  });
});

test('a sketch is shown until the header is there', {skip, timeout: 60000}, async () => {
  await withFolder(async ({run, file}) => {
    run('synth', '--kind', 'knot', '--triangles', '2000', '-o', 'knot.glb');
    run('encode', 'knot.glb', '--bytes', '24k', '--class', 'triangles', '--sketch', '2k',
      '-o', 'knot.tks');
    const bytes = await file('knot.tks');
    let all;
    await withStream(bytes, async (terrain) => {
      all = (await terrain.decode()).info;
      assert.ok(all.leastBytes < 1500 && all.headerBytes > 4000, JSON.stringify(all));
      for (const cut of [0, all.leastBytes + 100, all.headerBytes - 1, all.headerBytes, 3e4]) {
        const {info, object, texture, complete} = await terrain.decode({bytes: cut});
        assert.equal(info.showsSketch, cut < all.headerBytes, `${cut}`);
        assert.equal(info.objectTriangles > 0, cut >= all.headerBytes);
        assert.equal(info.streamBytes, bytes.length);
        assert.equal(complete, cut > bytes.length);
        assert.ok(object.triangles.length > 0 && texture.width > 0);
      }
    });
    const cut = bytes.slice(0, 3000);
    await withStream(cut, async (terrain) => {
      assert.ok((await terrain.decode()).info.showsSketch);
    });
    // Bytes that come one after the other.
    await withStream(bytes, async (terrain) => {
      const shown = [];
      for await (const {info} of terrain.refine()) shown.push(info.showsSketch);
      assert.equal(shown.at(-1), false);
    });
  });
});

test('places on a texture that repeats lie beyond its corners', {skip}, async () => {
  await withFolder(async ({folder, run, file}) => {
    const places = ['-0.5 -1', '2.5 -1', '2.5 2'], corners = ['0 0 0', '4 0 0', '0 3 0'];
    const lines = [...corners.map((corner) => `v ${corner}`),
      ...places.map((place) => `vt ${place}`), 'f 1/1 2/2 3/3'];
    await writeFile(join(folder, 'tiled.obj'), lines.join('\n'));
    run('synth', '--size', '33', '-o', 'ground');
    run('encode', 'tiled.obj', '--texture', 'ground/texture.png', '--bytes', '4k',
      '--class', 'triangles', '-o', 'tiled.tks');
    await withStream(await file('tiled.tks'), async (terrain) => {
      const {object, info, texture} = await terrain.decode({normals: true});
      assert.equal(texture.repeats, true);
      assert.equal(object.positions.length, 9);
      const shifts = new Set();  // by as many whole textures for all corners
      for (let v = 0; v < 3; ++v) {
        const [x, y] = object.positions.subarray(3 * v);
        const [u, up] = places[x > 2 ? 1 : y > 1 ? 2 : 0].split(' ').map(Number);
        const [east, south] = object.texcoords.subarray(2 * v);
        const shift = [Math.round(east - u), Math.round(south - (1 - up))];
        assert.ok(Math.abs(east - u - shift[0]) <= 0.5 / info.textureWidth);
        assert.ok(Math.abs(south - (1 - up) - shift[1]) <= 0.5 / info.textureHeight);
        shifts.add(shift.join());
      }
      assert.equal(shifts.size, 1);
    });
  });
});

test('a part without a texture is all header', {skip, timeout: 60000}, async () => {
  await withFolder(async ({folder, run, file}) => {
    const corners = ['0 0 0', '2 0 0', '0 3 0', '0 0 5'];
    await writeFile(join(folder, 'part.obj'), corners.map((corner) => `v ${corner}\n`).join('') +
      'f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n');
    run('encode', 'part.obj', '--bytes', '2k', '--class', 'triangles', '-o', 'part.tks');
    await withStream(await file('part.tks'), async (terrain) => {
      const {object, texture, complete} = await terrain.decode({bytes: 0});
      assert.deepEqual([object.texcoords, texture, complete], [undefined, undefined, true]);
      assert.deepEqual(shapeOf(object), [2, 0]);
      const places = new Set();
      const rounded = object.positions.map((part) => Math.round(part * 1e3));
      for (let v = 0; v < rounded.length; v += 3) places.add(rounded.subarray(v, v + 3).join());
      const expected = corners.map((corner) => corner.split(' ').map((part) => part * 1e3).join());
      assert.deepEqual([...places].sort(), expected.sort());
      // Of a corner of three sharp edges there is a vertex for each side.
      const {object: {normals}} = await terrain.decode({normals: true});
      assert.equal(normals.length, 3 * 12);
    });
  });
});
