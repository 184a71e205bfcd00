// SPDX-License-Identifier: Apache-2.0
// One mesh glides into the next: where it starts, and that it ends.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {test} from 'node:test';
import {setTimeout as wait} from 'node:timers/promises';
import {PerspectiveCamera} from 'three';

import {surfaceUnder} from '../src/glide.js';
import {open} from '../src/index.js';
import {TksTerrain} from '../src/three.js';

/** A grid of n x n vertices one apart, two triangles a square, of height f(x, z). */
function gridMesh(n, spacing, f) {
  const positions = new Float32Array(3 * n * n), normals = new Float32Array(3 * n * n);
  for (let i = 0; i < n * n; ++i) {
    const x = spacing * (i % n), z = spacing * Math.floor(i / n);
    positions.set([x, f(x, z), z], 3 * i);
    normals.set([x, 1, z], 3 * i);
  }
  const triangles = [];
  for (let i = 0; i < n * (n - 1); ++i) {
    if (i % n < n - 1) triangles.push(i, i + n, i + 1, i + 1, i + n, i + n + 1);
  }
  return {positions, normals, triangles: Uint32Array.from(triangles)};
}

test('a mesh lies under its own vertices, and a plane under all', () => {
  const mesh = gridMesh(9, 4, (x, z) => Math.sin(x) + Math.cos(3 * z));
  const own = surfaceUnder(mesh, mesh);
  for (const name of ['positions', 'normals']) {
    own[name].forEach((v, i) => assert.ok(Math.abs(v - mesh[name][i]) < 1e-3));
  }
  const plane = (x, z) => 3 * x - 2 * z + 5;
  const under = surfaceUnder(gridMesh(3, 16, plane), gridMesh(33, 1, () => 0));
  for (let i = 0; i < under.positions.length; i += 3) {
    const [x, y, z] = under.positions.subarray(i, i + 3);
    assert.ok(Math.abs(y - plane(x, z)) < 1e-3);
    assert.ok(Math.abs(under.normals[i] - x) < 1e-3 && Math.abs(under.normals[i + 2] - z) < 1e-3);
  }
});

test('where there was no mesh, vertices stay where they are', () => {
  const fine = gridMesh(33, 1, (x) => x * x);
  const {positions} = surfaceUnder(gridMesh(3, 8, () => -7), fine);
  for (let i = 0; i < positions.length; i += 3) {
    const isOver = positions[i] <= 16 && positions[i + 2] <= 16;
    assert.equal(positions[i + 1], isOver ? -7 : fine.positions[i + 1]);
  }
  const empty = {
    positions: new Float32Array(), normals: new Float32Array(), triangles: new Uint32Array(),
  };
  assert.deepEqual(surfaceUnder(empty, fine), {positions: fine.positions, normals: fine.normals});
  assert.equal(surfaceUnder(fine, empty).positions.length, 0);
});

async function opened() {
  const vectors = new URL('../../../conformance/vectors/', import.meta.url);
  const file = new URL('joint_budget_97x97_128x128.tks', vectors);
  return open(await readFile(file));
}

/** Stops the clock that surfaces glide by, for one test; returns a way to move it by ms. */
function stoppedClock(t) {
  let now = performance.now();
  t.mock.method(performance, 'now', () => now);
  return (ms) => (now += ms);
}

test('a frame that glides begins at the surface that was drawn, and arrives', async (t) => {
  const pass = stoppedClock(t);
  const object = new TksTerrain(await opened(), {glideTime: 80, triangles: 3000});
  await object.begin();
  const before = object.geometry, normals = true;
  assert.equal(object.glide(), false);
  object.show(await object.terrain.decode({triangles: 3000, normals}), {glide: true});
  const {position: [start]} = object.geometry.morphAttributes;
  const under = surfaceUnder(
    {positions: before.attributes.position.array, normals: before.attributes.normal.array,
      triangles: before.index.array},
    {positions: object.geometry.attributes.position.array,
      normals: object.geometry.attributes.normal.array});
  assert.deepEqual(start.array, under.positions);
  pass(20);
  assert.ok(object.glide() && object.morphTargetInfluences[0] > 0.5);
  pass(80);
  assert.equal(object.glide(), false);
  assert.equal(object.morphTargetInfluences[0], 0);
  object.show(await object.terrain.decode({triangles: 500, normals}));
  assert.equal(object.geometry.morphAttributes.position, undefined, 'it jumps unless asked');
  object.dispose();
});

test('update() lets surfaces glide on pages that draw all the time alone', async (t) => {
  const pass = stoppedClock(t);
  const camera = new PerspectiveCamera(50, 1, 0.1, 1e9);
  camera.position.set(0, 100, 0);
  camera.updateMatrixWorld();
  for (const [ms, glides] of [[5, true], [150, false]]) {
    const object = new TksTerrain(await opened());
    await object.begin();
    let glided = false;
    object.addEventListener('frame', () => (glided ||= object.glide()));
    for (let i = 0; i < 2000 && !object.frame.complete; ++i) {
      pass(ms);
      object.update(camera, 800);
      await wait(1);
    }
    assert.ok(object.frame.complete);
    assert.equal(glided, glides);
    object.dispose();
  }
});
