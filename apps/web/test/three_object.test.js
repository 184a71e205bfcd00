// SPDX-License-Identifier: Apache-2.0
// Objects in three.js: what is built and fetched for a camera, and in headless Chromium pictures of
// what was encoded, for which it needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {mkdir, readFile, rm} from 'node:fs/promises';
import {after, before, test} from 'node:test';
import {
  DoubleSide, LinearFilter, LinearMipmapLinearFilter, PerspectiveCamera, RepeatWrapping, Vector3,
} from 'three';

import {TksLoader, TksObject} from '../src/three.js';
import {launch} from './chromium.js';
import {psnr} from './pictures.js';
import {serve} from './server.js';
import {settle} from './settle.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const TIMEOUT = {timeout: 120000};
/** What they show, by how they are coded. */
const CLASSES = {resampled: ['blob', 'knot', 'scan'], triangles: ['knot']};
const KINDS = Object.entries(CLASSES).flatMap(([coded, shapes]) =>
  shapes.map((shape) => `${shape}_${coded}`));
const web = new URL('..', import.meta.url).pathname, folder = web + 'dist/objects-test/';
const vectors = new URL('../../../conformance/vectors/', import.meta.url);
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
const LEAST = 30;  // dB
let browser, server;

const bytesOf = async (name) => {
  const file = await readFile(new URL(name, vectors));
  return file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
};

before(async () => {
  await mkdir(folder, {recursive: true});
  const run = (...args) => execFileSync(CLI, [...args, '-q'], {cwd: folder});
  for (const kind of skip ? [] : KINDS) {
    const [shape, coded] = kind.split('_');
    run('synth', '--kind', shape, '--triangles', '3000', '-o', `${kind}.glb`, '-f');
    run('encode', `${kind}.glb`, '--bytes', '20k', '--class', coded, '-o', `${kind}.tks`, '-f');
  }
  server = await serve(web);
  browser = await launch({width: 256, height: 256});
});
after(async () => {
  await browser?.close();
  await server?.close();
  await rm(folder, {recursive: true, force: true});
});

/** Lets the object do what it does while nothing moves. */
const settled = (object, camera) =>
  settle(object, camera, {height: 800, told: ({frame}) => frame, times: 3, wait: 60});

test('a loader gives an object, with its normals, and with the texture that it has', async () => {
  for (const name of ['object_joint_9x54_17x102.tks', 'object_open_17x68.tks']) {
    const object = await new TksLoader().parseAsync(await bytesOf(name));
    assert.ok(object instanceof TksObject);
    const {geometry, material, frame} = object, {count} = geometry.getAttribute('position');
    assert.equal(geometry.getAttribute('normal').count, count);
    assert.equal(geometry.getAttribute('uv')?.count, frame.info.hasTexture ? count : undefined);
    assert.equal(Boolean(material.map), frame.info.hasTexture);
    assert.equal(material.side, DoubleSide);
    assert.ok(!material.lights);
    // Mip levels would mix patches that lie beside each other by chance.
    if (material.map) assert.equal(material.map.minFilter, LinearFilter);
    assert.deepEqual(object.centre.toArray(), frame.object.centre);
    object.dispose();
  }
});

test('an object refines as far as the camera sees; its texture grows and shrinks', async () => {
  const object = await new TksLoader().parseAsync(await bytesOf('object_joint_9x54_17x102.tks'));
  const camera = new PerspectiveCamera(50, 1, 1, 1e9), middle = object.fit(camera);
  const seen = async (times) => {
    camera.position.sub(middle).multiplyScalar(times).add(middle);
    await settled(object, camera);
    return object.material.map.image.width;
  };
  const near = await seen(1), far = await seen(1e3), again = await seen(1e-3);
  assert.ok(object.frame.complete);
  assert.deepEqual([near, again], [57, 57]);
  assert.ok(far < 20, `${far}`);
  object.dispose();
});

test('a sketch gives way to the mesh', {skip, ...TIMEOUT}, async () => {
  const options = ['--bytes', '24k', '--class', 'triangles', '--sketch', '2k', '-f', '-q'];
  execFileSync(
    CLI, ['encode', 'knot_triangles.glb', ...options, '-o', 'sketched.tks'], {cwd: folder});
  const file = await readFile(`${folder}sketched.tks`);
  const object = await new TksLoader().setTerrainOptions({bytes: 1500}).parseAsync(
    file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
  assert.ok(object.frame.info.showsSketch);
  const sketched = object.geometry.index.count, camera = new PerspectiveCamera(50, 1, 1e-3, 100);
  object.bytes = Infinity;
  object.fit(camera);
  await settled(object, camera);
  const {info, complete} = object.frame;
  assert.ok(complete && !info.showsSketch);
  assert.equal(object.geometry.index.count, 3 * info.objectTriangles);
  assert.notEqual(object.geometry.index.count, sketched);
  assert.ok(object.material.map.image.width > 0);
  object.dispose();
});

test('a camera that is fitted has all of an object in its picture, from any side', async () => {
  const object = await new TksLoader().parseAsync(await bytesOf('object_torus_9x144.tks'));
  const camera = new PerspectiveCamera(50, 1.5, 1, 1e9), point = new Vector3();
  const places = object.geometry.getAttribute('position');
  for (const direction of [undefined, new Vector3(1, 0, 0), new Vector3(0, 1, 0.2)]) {
    object.fit(camera, direction);
    let most = 0;
    for (let i = 0; i < places.count; ++i) {
      point.fromBufferAttribute(places, i).project(camera);
      most = Math.max(most, Math.abs(point.x), Math.abs(point.y), Math.abs(point.z));
    }
    assert.ok(most > 0.9 && most <= 1, `${most}`);
  }
  object.dispose();
});

/** Draws the mesh that was encoded, or an object once it has got all that the camera sees. */
async function draw({kind, isOriginal}) {
  const {Color, MeshBasicMaterial, PerspectiveCamera, Scene, WebGLRenderer} = await import('three');
  const {GLTFLoader} = await import('/node_modules/three/examples/jsm/loaders/GLTFLoader.js');
  const {TksLoader} = await import('/src/three.js');
  const address = `/dist/objects-test/${kind}`, scene = new Scene();
  const camera = new PerspectiveCamera(40, 1, 0.1, 100);
  camera.position.set(1.2, 1, 3.2);
  camera.lookAt(0, 0, 0);
  scene.background = new Color(0x88aacc);
  if (isOriginal) {
    const {scene: {children: [mesh]}} = await new GLTFLoader().loadAsync(`${address}.glb`);
    mesh.material = new MeshBasicMaterial({map: mesh.material.map, side: 2});
    scene.add(mesh);
  } else {
    const object =
      await new TksLoader().setTerrainOptions({pixelError: 0}).loadAsync(`${address}.tks`);
    while (!object.frame.complete) {
      object.update(camera, 256);
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    scene.add(object);
  }
  const renderer = new WebGLRenderer({preserveDrawingBuffer: true, antialias: true});
  renderer.setSize(256, 256);
  document.body.append(renderer.domElement);
  renderer.render(scene, camera);
}
const pictureOf = (asked) => browser.withPage(async (page) => {
  await page.goto(server.url + 'test/core.html');
  await page.addStyleTag({content: 'body { margin: 0 }'});
  await page.evaluate(draw, asked);
  const name = asked.kind + (asked.isOriginal ? '_original' : '');
  return page.screenshot({path: PICTURES && `${PICTURES}/object_${name}.png`});
});

for (const kind of KINDS) {
  test(`an object is drawn as the mesh that was encoded: ${kind}`, {skip, ...TIMEOUT}, async () => {
    const pictures = [
      await pictureOf({kind, isOriginal: true}), await pictureOf({kind, isOriginal: false}),
    ];
    const all = {x: 0, y: 0, width: 256, height: 256};
    const likeness = await browser.withPage((page) => psnr(page, pictures, [all, all]));
    assert.ok(likeness > LEAST, `${likeness} dB`);
  });
}

test('of triangles as they are the texture alone refines, and repeats', {skip, ...TIMEOUT},
  async () => {
    const file = await readFile(folder + 'knot_triangles.tks');
    const object = await new TksLoader().parseAsync(
      file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
    const camera = new PerspectiveCamera(50, 1, 0.1, 1e9), middle = object.fit(camera);
    const {geometry, frame: {info}} = object, widths = [];
    assert.equal(geometry.index.count, 3 * info.objectTriangles);
    for (const times of [1e3, 1e-3, 1, 1e-3]) {
      camera.position.sub(middle).multiplyScalar(times).add(middle);
      await settled(object, camera);
      widths.push(object.material.map.image.width);
      assert.equal(object.geometry, geometry);
    }
    assert.ok(object.frame.complete);
    assert.equal(widths.at(-1), info.textureWidth);
    const few = await new TksLoader().setTerrainOptions({triangles: 500}).parseAsync(
      file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
    assert.ok(few.geometry.index.count <= 3 * 500 && few.geometry.index.count > 3 * 480);
    assert.ok(widths[0] < info.textureWidth, `${widths}`);
    assert.ok(widths.every((width, i) => i === 0 || width >= widths[i - 1]), `${widths}`);
    const {map} = object.material;
    assert.deepEqual([map.wrapS, map.wrapT], [RepeatWrapping, RepeatWrapping]);
    assert.equal(map.minFilter, LinearMipmapLinearFilter);
    object.dispose();
  });

test('a mesh waits for the slices of a large texture that it lies on', TIMEOUT, async () => {
  const seen = await browser.withPage(async (page) => {
    await page.goto(server.url + 'test/core.html');
    await page.route('**/joint.tks', async (route) =>
      route.fulfill({body: Buffer.from(await bytesOf('object_joint_9x54_17x102.tks'))}));
    return page.evaluate(async () => {
      const {PerspectiveCamera, Scene, WebGLRenderer} = await import('three');
      const {TksLoader} = await import('/src/three.js');
      const object = await new TksLoader().loadAsync('/joint.tks');
      const scene = new Scene(), camera = new PerspectiveCamera(50, 1, 1, 1e9);
      scene.add(object);
      object.fit(camera);
      const renderer = new WebGLRenderer(), counts = [];
      const draw = () => {
        object.update(camera, 0);  // fetches nothing for a picture without a height
        renderer.render(scene, camera);
      };
      for (let i = 0; i < 3; ++i) draw();
      const frame = await object.terrain.decode({triangles: 20}), before = object.geometry;
      const {map} = object.material, side = 2048;
      const texture = {width: side, height: side, data: new Uint8ClampedArray(4 * side * side)};
      object.show({...frame, texture});
      do {
        counts.push([object.geometry !== before, object.material.map !== map]);
        draw();
      } while (object.material.map === map);
      counts.push([object.geometry !== before, object.material.map !== map]);
      return counts;
    });
  });
  assert.ok(seen.length > 8, `${seen.length}`);
  for (const [isNewMesh, isNewMap] of seen) assert.equal(isNewMesh, isNewMap);
  assert.deepEqual(seen.at(-1), [true, true]);
});
