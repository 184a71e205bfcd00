// SPDX-License-Identifier: Apache-2.0
// The adapter of three.js without a screen: what it builds, and what it fetches for a camera.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';
import {PerspectiveCamera} from 'three';

import {TksLoader} from '../src/three.js';

const vectors = new URL('../../conformance/vectors/', import.meta.url);
const bytesOf = async (name) => {
  const file = await readFile(new URL(name, vectors));
  return file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
};

/** Lets the object do what it does while nothing moves. */
async function settle(object, camera) {
  for (let quiet = 0; quiet < 3; ) {
    let shown = false;
    const note = () => (shown = true);
    object.addEventListener('frame', note);
    object.update(camera, 800);
    await new Promise((resolve) => setTimeout(resolve, 60));
    object.removeEventListener('frame', note);
    quiet = shown ? 0 : quiet + 1;
  }
}

test('a terrain refines as far as the camera sees, and no further', async () => {
  const loader = new TksLoader().setTerrainOptions({triangles: 3000});
  const object = await loader.parseAsync(await bytesOf('joint_budget_97x97_128x128.tks'));
  const {info} = object.terrain;
  const positions = object.geometry.getAttribute('position');
  assert.equal(positions.count, object.frame.mesh.heights.length);
  assert.ok(object.geometry.index.count <= 9000);
  assert.equal(object.material.map.image.width, info.textureWidth);
  // x and z span the ground around the middle.
  object.geometry.computeBoundingBox();
  const {min, max} = object.geometry.boundingBox;
  assert.ok(Math.abs(min.x + max.x) < 1e-3 && Math.abs(min.z + max.z) < 1e-3);

  const camera = new PerspectiveCamera(50, 1, 0.1, 1e9);
  camera.position.set(0, 1e6, 0);
  camera.updateMatrixWorld();
  await settle(object, camera);
  assert.equal(object.terrain.loaded.bytes, 4096);
  camera.position.set(0, max.y + 1, 0);
  camera.updateMatrixWorld();
  await settle(object, camera);
  assert.ok(object.frame.complete);
  object.dispose();
});

test('triangles face up', async () => {
  const object = await new TksLoader().parseAsync(await bytesOf('geometry_budget_129x97.tks'));
  const p = object.geometry.getAttribute('position'), index = object.geometry.index.array;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = index.subarray(i, i + 3);
    const up = (p.getZ(b) - p.getZ(a)) * (p.getX(c) - p.getX(a)) -
      (p.getX(b) - p.getX(a)) * (p.getZ(c) - p.getZ(a));
    assert.ok(up > 0);
  }
  object.dispose();
});

test('an image alone lies flat', async () => {
  const object = await new TksLoader().parseAsync(await bytesOf('rgb_50x37.tks'));
  assert.equal(object.geometry.index.count, 6);
  assert.equal(object.material.map.image.width, 50);
  object.dispose();
});

test('failures come through the callback', async () => {
  const error = await new Promise((resolve, reject) =>
    new TksLoader().parse(new TextEncoder().encode('nothing').buffer, reject, resolve));
  assert.equal(error.code, 'corrupt');
});
