// SPDX-License-Identifier: Apache-2.0
// The adapter of three.js without a screen: what it builds, and what it fetches for a camera.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';
import {
  MeshBasicMaterial, OrthographicCamera, PerspectiveCamera, Vector3,
} from 'three';

import {TksLoader} from '../src/three.js';
import {serve} from './server.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);
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
  // x and z span the ground around the middle: samples of unknown spacing lie 30 m apart.
  object.geometry.computeBoundingBox();
  const {min, max} = object.geometry.boundingBox;
  assert.equal(max.x - min.x, 96 * 30);
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

test('a terrain that is scaled along the ground alone refines by its heights', async () => {
  const object = await new TksLoader().parseAsync(await bytesOf('geometry_budget_129x97.tks'));
  object.scale.set(1e-3, 1, 1e-3);
  const camera = new PerspectiveCamera(50, 1, 0.1, 1e9);
  camera.position.set(0, 1000 * object.frame.info.heightsRmse, 0);
  await settle(object, camera);
  assert.ok(object.frame.bytes > 4096, `${object.frame.bytes}`);
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

test('heights are those of what is drawn, everywhere on it', async () => {
  const object = await new TksLoader().parseAsync(await bytesOf('joint_budget_97x97_128x128.tks'));
  const p = object.geometry.getAttribute('position'), index = object.geometry.index.array;
  const middleOf = (t, axis) =>
    [0, 1, 2].reduce((sum, k) => sum + p.array[3 * index[t + k] + axis] / 3, 0);
  for (let t = 0; t < index.length; t += 3) {
    const away = object.heightAt(middleOf(t, 0), middleOf(t, 2)) - middleOf(t, 1);
    assert.ok(Math.abs(away) < 1e-2, `${away}`);
  }
  for (let i = 0; i < p.count; ++i) {
    assert.ok(Math.abs(object.heightAt(p.getX(i), p.getZ(i)) - p.getY(i)) < 0.5);
  }
  for (const [x, z] of [[1e5, 0], [0, -1441], [NaN, 0], [0, Infinity]]) {
    assert.ok(Number.isNaN(object.heightAt(x, z)), `${x} ${z}`);
  }
  const before = object.heightAt(100, 200);
  object.show(await object.terrain.decode({normals: true}));
  assert.notEqual(object.heightAt(100, 200), before);
  object.dispose();
});

/** The largest |x| or |y| of an object in the picture of a camera; infinite if some of it is behind
 * the near or the far plane. */
function extentIn(camera, object) {
  const places = object.geometry.getAttribute('position'), point = new Vector3();
  let most = 0;
  camera.updateMatrixWorld();
  for (let i = 0; i < places.count; ++i) {
    point.fromBufferAttribute(places, i).applyMatrix4(object.matrixWorld).project(camera);
    most = Math.max(most, Math.abs(point.z) < 1 ? Math.max(...[point.x, point.y].map(Math.abs))
      : Infinity);
  }
  return most;
}

test('a camera that is fitted has all of the terrain in its picture, and fills it', async () => {
  for (const name of ['joint_budget_97x97_128x128.tks', 'geometry_budget_129x97.tks']) {
    const object = await new TksLoader().parseAsync(await bytesOf(name));
    object.position.set(1e4, -500, 7);
    object.scale.y = 3;
    const cameras = [new PerspectiveCamera(50, 2, 1, 10), new PerspectiveCamera(20, 0.5, 1, 10),
      new OrthographicCamera(-8, 8, 5, -5)];
    for (const camera of cameras) {
      for (const direction of [undefined, new Vector3(1, -0.2, 0.3), new Vector3(0, -1, 0)]) {
        const middle = object.fit(camera, direction);
        assert.ok(middle.distanceTo(new Vector3(1e4, middle.y, 7)) < 200);
        const extent = extentIn(camera, object);
        assert.ok(extent <= 1, `${extent}`);
        if (camera.isOrthographicCamera) {
          assert.ok(extent > 0.6, `${extent}`);
        } else {  // a little nearer, and some of it is not in the picture
          camera.translateZ(-0.15 * camera.position.distanceTo(middle));
          assert.ok(extentIn(camera, object) > 1, `${extent}`);
        }
      }
    }
    object.dispose();
  }
});

test('terrains need no light', async () => {
  for (const name of ['rgb_50x37.tks', 'geometry_budget_129x97.tks']) {
    const object = await new TksLoader().parseAsync(await bytesOf(name));
    assert.ok(!object.material.lights);
    object.dispose();
  }
});

test('an image alone lies flat', async () => {
  const object = await new TksLoader().parseAsync(await bytesOf('rgb_50x37.tks'));
  assert.equal(object.geometry.index.count, 6);
  assert.equal(object.material.map.image.width, 50);
  object.dispose();
});

test('a decoder that was preloaded is taken once; dispose() ends one that was not', async (t) => {
  const started = [];
  const worker = () => {
    const thread = {postMessage({id, operation}) {
      started.push(operation);
      queueMicrotask(() => thread.onmessage({data: {id, error: {code: 'io', message: operation}}}));
    }, terminate: t.mock.fn()};
    return thread;
  };
  const [first, second] = [worker(), worker()];
  const loader = new TksLoader().setDecoderOptions({worker: first}).preload().preload();
  while (started.length === 0) await new Promise((resolve) => setTimeout(resolve, 5));
  assert.deepEqual(started, ['start']);
  loader.setDecoderOptions({worker: second});
  assert.equal(first.terminate.mock.callCount(), 1);
  loader.preload();
  await assert.rejects(loader.parseAsync(await bytesOf('rgb_50x37.tks')), {message: 'start'});
  assert.equal(second.terminate.mock.callCount(), 1);
  loader.dispose();
  assert.equal(second.terminate.mock.callCount(), 1);  // taken, and ended with its terrain
  const object = await new TksLoader().setDecoderOptions({worker: false}).preload()
    .parseAsync(await bytesOf('rgb_50x37.tks'));
  assert.equal(object.material.map.image.width, 50);
  object.dispose();
});

test('terrains of one loader have materials of their own, as the one that was given', async () => {
  const material = new MeshBasicMaterial({color: 0x123456});
  const stream = await bytesOf('rgb_50x37.tks');
  material.onBeforeCompile = () => {};
  let disposed = 0;
  material.addEventListener('dispose', () => ++disposed);
  const loader = new TksLoader().setTerrainOptions({material});
  const [first, second] = [await loader.parseAsync(stream), await loader.parseAsync(stream)];
  assert.notEqual(first.material.map, second.material.map);
  assert.equal(second.material.color.getHex(), 0x123456);
  assert.equal(second.material.onBeforeCompile, material.onBeforeCompile);
  first.material.addEventListener('dispose', () => ++disposed);
  second.dispose();
  assert.deepEqual([disposed, material.map], [0, null]);
  first.dispose();
  assert.equal(disposed, 1);
});

test('requests are made as the loader says, and end when it is told so', async () => {
  const server = await serve(vectors.pathname, {stall: 10});
  try {
    const loader = new TksLoader().setRequestHeader({'X-Key': 'abc'});
    const loading = loader.loadAsync(server.url + 'rgb_50x37.tks');
    while (server.requests.length === 0) await new Promise((resolve) => setTimeout(resolve, 5));
    loader.abort();
    await assert.rejects(loading, {name: 'AbortError'});
    assert.equal(server.requests[0].headers['x-key'], 'abc');
    assert.equal(await server.requests[0].ended, false);
    server.faults.stall = Infinity;
    (await loader.loadAsync(server.url + 'rgb_50x37.tks')).dispose();
  } finally {
    await server.close();
  }
});

test('failures come through the callback', async () => {
  const error = await new Promise((resolve, reject) =>
    new TksLoader().parse(new TextEncoder().encode('nothing').buffer, reject, resolve));
  assert.equal(error.code, 'corrupt');
});
