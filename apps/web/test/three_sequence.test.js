// SPDX-License-Identifier: Apache-2.0
// Frames of a sequence in three.js, without a screen: they change heights and texels in buffers
// that stay, and refine where one rests. It needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {before, test} from 'node:test';
import {PerspectiveCamera} from 'three';

import {TksLoader} from '../src/three.js';
import {sequenceOf} from './sequences.js';

let joint, voids, pictures;
before(async () => {
  joint = await sequenceOf({heights: 'erosion', texture: 'clouds', frames: 6, size: 65},
    '--bytes', '60k', '--group', 3);
  voids = await sequenceOf({heights: 'rover', frames: 4, size: 64}, '--lossless', '--group', 2);
  pictures = await sequenceOf({texture: 'clouds', frames: 4, size: 64}, '--bytes', '40k');
});

/** Calls use(object) with the terrain of a sequence, and disposes it. */
async function withObject({bytes}, use, options = {}) {
  const loader = new TksLoader().setTerrainOptions(options);
  const object = await loader.parseAsync(bytes.buffer);
  try {
    await use(object);
  } finally {
    object.dispose();
  }
}

test('frames move the vertices of one geometry, and two textures take turns', async () => {
  await withObject(joint, async (object) => {
    const shown = [], disposed = [];
    object.addEventListener('frame', ({frame}) => shown.push(frame.number));
    await object.setFrame(0);
    const {geometry} = object, {array} = geometry.getAttribute('position');
    const {array: normals} = geometry.getAttribute('normal'), textures = new Set();
    for (let number = 1; number < 6; ++number) {
      const heights = array.slice();
      await object.setFrame(number);
      assert.equal(object.geometry, geometry);
      assert.equal(geometry.getAttribute('position').array, array);
      assert.equal(geometry.getAttribute('normal').array, normals);
      assert.ok(array.some((value, i) => value !== heights[i]), 'heights changed');
      const {surface, texture} = object.frame;
      surface.data.forEach((height, i) =>
        assert.equal(array[3 * i + 1], height, `vertex ${i} of frame ${number}`));
      assert.deepEqual(normals, surface.normals);
      const {map} = object.material;
      assert.ok(map.image.data.every((value, i) => value === texture.data[i]), 'texels');
      if (!textures.has(map)) map.addEventListener('dispose', () => disposed.push(map));
      textures.add(map);
    }
    assert.equal(textures.size, 2);
    assert.deepEqual(disposed, []);
    assert.deepEqual(shown, [0, 1, 2, 3, 4, 5]);
  });
});

test('the box of a frame holds its heights and no others', async () => {
  await withObject(joint, async (object) => {
    for (const number of [0, 5]) {
      await object.setFrame(number);
      const {boundingBox: kept, boundingSphere} = object.geometry;
      const before = kept.clone();
      object.geometry.computeBoundingBox();
      assert.ok(before.min.distanceTo(object.geometry.boundingBox.min) < 1e-2);
      assert.ok(before.max.distanceTo(object.geometry.boundingBox.max) < 1e-2);
      assert.ok(boundingSphere.radius >= before.min.distanceTo(before.max) / 2 - 1e-2);
    }
  });
});

test('voids of a frame are left out of its triangles', async () => {
  await withObject(voids, async (object) => {
    const counts = [];
    for (const number of [0, 1, 2, 3, 0]) {
      await object.setFrame(number);
      const {data, width, height} = object.frame.surface;
      const {index, drawRange} = object.geometry;
      const drawn = index.array.subarray(0, Math.min(index.count, drawRange.count));
      assert.ok(drawn.every((vertex) => !Number.isNaN(data[vertex])));
      let expected = 0;
      for (let y = 0; y < height - 1; ++y) {
        for (let x = 0; x < width - 1; ++x) {
          const i = y * width + x, isGround = (k) => !Number.isNaN(data[k]);
          const diagonal = isGround(i + width) && isGround(i + 1);
          expected += diagonal ? Number(isGround(i)) + Number(isGround(i + width + 1)) : 0;
        }
      }
      assert.equal(drawn.length, 3 * expected);
      counts.push(expected);
    }
    assert.ok(new Set(counts).size > 2 && counts[0] === counts[4], counts.join());
    const box = object.geometry.boundingBox;
    assert.ok(isFinite(box.min.y) && isFinite(box.max.y));
  });
});

test('heights of a frame are those of its grid, everywhere on it', async () => {
  await withObject(joint, async (object) => {
    await object.setFrame(4);
    const p = object.geometry.getAttribute('position'), index = object.geometry.index.array;
    for (let i = 0; i < p.count; ++i) {
      assert.ok(Math.abs(object.heightAt(p.getX(i), p.getZ(i)) - p.getY(i)) < 1e-2);
    }
    for (let t = 0; t < index.length; t += 3) {
      const middle = [0, 1, 2].map((axis) =>
        [0, 1, 2].reduce((sum, k) => sum + p.array[3 * index[t + k] + axis] / 3, 0));
      assert.ok(Math.abs(object.heightAt(middle[0], middle[2]) - middle[1]) < 1e-1);
    }
    assert.ok(Number.isNaN(object.heightAt(1e6, 0)));
  });
});

test('update() refines the frame that rests, and no other', async () => {
  await withObject(joint, async (object) => {
    const camera = new PerspectiveCamera(50, 1, 1, 1e7);
    object.fit(camera);
    camera.updateMatrixWorld();
    await object.setFrame(5);
    const grid = object.geometry;
    object.update(camera, 800);
    assert.equal(object.geometry, grid, 'not at once');
    const until = performance.now() + 10000;
    while (object.geometry === grid && performance.now() < until) {
      await new Promise((resolve) => setTimeout(resolve, 50));
      object.update(camera, 800);
    }
    assert.equal(object.frame.number, 5);
    assert.equal(object.geometry.getAttribute('position').count, object.frame.mesh.heights.length);
    await object.setFrame(1);
    assert.equal(object.geometry, grid, 'its buffers are used again');
  });
});

test('the last of several frames that are asked for is shown', async () => {
  await withObject(joint, async (object) => {
    await Promise.all([3, 1, 4].map((number) => object.setFrame(number)));
    assert.deepEqual([object.number, object.frame.number], [4, 4]);
  });
});

test('frames of textures alone lie on flat ground', async () => {
  await withObject(pictures, async (object) => {
    await object.setFrame(1);
    const {geometry} = object;
    await object.setFrame(3);
    assert.equal(object.geometry, geometry);
    assert.equal(object.frame.number, 3);
    assert.equal(object.material.map.image.width, object.frame.texture.width);
  });
});

test('a grid of fewer samples, where fewer are asked for', async () => {
  await withObject(joint, async (object) => {
    await object.setFrame(2);
    const {width, level} = object.frame.surface;
    assert.ok(width <= 20 && level > 0);
    assert.equal(object.geometry.getAttribute('position').count, width * width);
    const {boundingBox: {min, max}} = object.geometry, samples = object.terrain.info.width;
    assert.ok(max.x - min.x <= (samples - 1) * 30 && max.x - min.x > (samples - 8) * 30);
  }, {samples: 20});
});
