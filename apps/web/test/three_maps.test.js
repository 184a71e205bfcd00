// SPDX-License-Identifier: Apache-2.0
// Maps of a material in three.js: where they lie, how they come, and in headless Chromium a picture
// beside that of the mesh that was encoded. Needs a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import {mkdir, readFile, rm, writeFile} from 'node:fs/promises';
import {after, before, test} from 'node:test';
import {
  MeshLambertMaterial, NoColorSpace, PerspectiveCamera, RepeatWrapping, SRGBColorSpace,
} from 'three';

import {open} from '../src/index.js';
import {factorsOf} from '../src/material.js';
import {TksLoader, TksObject} from '../src/three.js';
import {launch} from './chromium.js';
import {ballOf, pngOf, shinyGlb} from './meshes.js';
import {psnr} from './pictures.js';
import {serve} from './server.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const TIMEOUT = {timeout: 120000};
const web = new URL('..', import.meta.url).pathname, folder = web + 'dist/maps-test/';
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
const LEAST = 30;  // dB
const SLOTS = ['normalMap', 'roughnessMap', 'metalnessMap', 'aoMap', 'emissiveMap'];
let browser, server, stream;

/** Lamps on blue scales: every map shows. */
const pictures = {
  baseColorTexture: pngOf(128, (x, y) => [90 + 60 * Math.sin(25 * x), 120, 200 - 90 * y]),
  normalTexture: pngOf(128, (x, y) => {
    const u = 0.5 * Math.sin(60 * x) + 0.2, v = 0.5 * Math.cos(45 * y) + 0.3;
    const length = Math.hypot(u, v, 1);
    return [u, v, 1].map((part) => 127.5 * (1 + part / length));
  }),
  metallicRoughnessTexture: pngOf(64, (x, y) => [0, 80 + 150 * y, 255 * (x % 0.25 > 0.125)]),
  occlusionTexture: pngOf(32, (x) => Array(3).fill(255 * (0.3 + 0.7 * Math.abs(2 * x - 1)))),
  emissiveTexture: pngOf(64, (x, y) =>
    (Math.hypot((8 * x) % 1 - 0.5, (4 * y) % 1 - 0.5) < 0.2 ? [255, 160, 0] : [0, 0, 0])),
};
const factors = {
  pbr: {metallicFactor: 0.5, roughnessFactor: 0.75}, emissiveFactor: [1, 0.5, 0.25],
  normalTexture: {scale: 0.75}, occlusionTexture: {strength: 0.5},
};

before(async () => {
  await mkdir(folder, {recursive: true});
  server = await serve(web);
  browser = await launch({width: 256, height: 256});
  if (skip) return;
  await writeFile(folder + 'lamps.glb', shinyGlb(ballOf(24), pictures, factors));
  execFileSync(CLI, ['encode', 'lamps.glb', '--bytes', '60k', '--class', 'triangles', '-o',
    'lamps.tks', '-q', '-f'], {cwd: folder});
  const file = await readFile(folder + 'lamps.tks');
  stream = file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
});
after(async () => {
  await browser?.close();
  await server?.close();
  await rm(folder, {recursive: true, force: true});
});

/** Lets the object do what it does while nothing moves. */
async function settle(object, camera) {
  for (let quiet = 0; quiet < 3; ) {
    const {frame} = object;
    object.update(camera, 800);
    await new Promise((resolve) => setTimeout(resolve, 60));
    quiet = object.frame === frame ? quiet + 1 : 0;
  }
}

test('frames have the maps that their bytes tell of', {skip}, async () => {
  const terrain = await open(new Uint8Array(stream));
  const {headerBytes, streamBytes, components} = terrain.info;
  assert.deepEqual(components.map(({name}) => name),
    ['', 'normal', 'metallic_roughness', 'occlusion', 'emissive']);
  const none = await terrain.decode({bytes: headerBytes});
  assert.deepEqual(none.maps, {});
  const step = Math.ceil((streamBytes - headerBytes) / 9);
  let last = 0;
  for (let cut = headerBytes; cut <= streamBytes; cut += step) {
    const {maps} = await terrain.decode({bytes: cut, mesh: false});
    assert.ok(Object.keys(maps).length >= last);
    last = Object.keys(maps).length;
  }
  const all = await terrain.decode({texels: 32});
  assert.deepEqual(Object.keys(all.maps).sort(),
    ['emissive', 'metallic_roughness', 'normal', 'occlusion']);
  assert.deepEqual(Object.values(all.maps).map(({width}) => width), [32, 32, 32, 32]);
  assert.ok(Object.values(all.maps).every(({psnr: dB}) => dB > 30));
  for (const left of [{maps: false}, {texture: false}, {component: 'normal'}]) {
    assert.equal((await terrain.decode({mesh: false, ...left})).maps, undefined);
  }
  terrain.dispose();
});

test('a loader gives a lit material whose maps refine in place', {skip, ...TIMEOUT}, async () => {
  const object = await new TksLoader().parseAsync(stream), {material} = object;
  assert.ok(material.isMeshStandardMaterial);
  const camera = new PerspectiveCamera(50, 1, 0.1, 1e9), middle = object.fit(camera);
  camera.position.sub(middle).multiplyScalar(1e3).add(middle);
  await settle(object, camera);
  const far = material.normalMap?.image.width ?? 0;
  camera.position.sub(middle).multiplyScalar(1e-3).add(middle);
  await settle(object, camera);
  assert.equal(object.material, material);
  assert.ok(far < 128, `${far}`);
  assert.equal(material.normalMap.image.width, 128);
  assert.equal(material.roughnessMap, material.metalnessMap);
  for (const slot of SLOTS) {
    const {colorSpace, wrapS, channel} = material[slot];
    assert.equal(colorSpace, slot === 'emissiveMap' ? SRGBColorSpace : NoColorSpace, slot);
    assert.deepEqual([wrapS, channel], [RepeatWrapping, 0], slot);
  }
  assert.deepEqual(material.normalScale.toArray(), [0.75, -0.75]);
  assert.deepEqual([material.metalness, material.roughness], [0.5, 0.75]);
  assert.deepEqual(material.emissive.toArray(), [1, 0.5, 0.25]);
  assert.equal(material.aoMapIntensity, 0.5);
  let disposed = 0;
  for (const slot of SLOTS) material[slot].addEventListener('dispose', () => ++disposed);
  object.dispose();
  assert.equal(disposed, 5);  // one texture is in two slots
});

test('maps come behind a sketch, which has none', {skip, ...TIMEOUT}, async () => {
  execFileSync(CLI, ['encode', 'lamps.glb', '--bytes', '60k', '--class', 'triangles', '--sketch',
    '2k', '-o', 'sketched.tks', '-q', '-f'], {cwd: folder});
  const terrain = await open(new Uint8Array(await readFile(folder + 'sketched.tks')));
  const {leastBytes} = terrain.info;
  const sketch = await terrain.decode({bytes: leastBytes});
  assert.equal(sketch.info.showsSketch, true);
  const later = new TksObject({...terrain, info: sketch.info, dispose() {}});
  later.show(sketch);
  assert.ok(later.material.isMeshBasicMaterial);
  later.show(await terrain.decode());
  assert.ok(later.material.isMeshStandardMaterial);
  assert.ok(SLOTS.every((slot) => later.material[slot]) && later.material.map);
  later.dispose();
  terrain.dispose();
});

test('a material without such slots keeps to those that it has', {skip, ...TIMEOUT}, async () => {
  const object = await new TksLoader()
    .setTerrainOptions({material: new MeshLambertMaterial()}).parseAsync(stream);
  object.show(await object.terrain.decode());
  assert.ok(object.material.normalMap && object.material.emissiveMap);
  assert.ok(!('roughnessMap' in object.material));
  object.dispose();
});

test('without a map the material is as one without it', {skip}, async () => {
  const {headerBytes} = (await open(new Uint8Array(stream))).info;
  const object = await new TksLoader().parseAsync(stream.slice(0, headerBytes));
  const {material} = object;
  assert.deepEqual([material.metalness, material.roughness], [0, 1]);
  assert.deepEqual(material.emissive.toArray(), [0, 0, 0]);
  assert.ok(SLOTS.every((slot) => !material[slot]));
  object.dispose();
});

test('any text of a material is taken', () => {
  const usual = factorsOf('');
  for (const text of ['null', '[', '3', '{"emissiveFactor":3}', '{"pbrMetallicRoughness":null}',
    '{"normalTexture":7,"emissiveFactor":["x",-1,9]}',
    '{"pbrMetallicRoughness":{"metallicFactor":9}}']) {
    assert.deepEqual(factorsOf(text), usual, text);
  }
});

/** Draws the mesh that was encoded, or its stream, by the same lamps; `flip`: with normals that
 * point down where they should point up. */
async function draw({isOriginal, flip}) {
  const three = await import('three');
  const {GLTFLoader} = await import('/node_modules/three/examples/jsm/loaders/GLTFLoader.js');
  const {TksLoader} = await import('/src/three.js');
  const address = '/dist/maps-test/lamps', scene = new three.Scene();
  const camera = new three.PerspectiveCamera(40, 1, 0.1, 100);
  camera.position.set(1.2, 1, 2.6);
  camera.lookAt(0, 0, 0);
  const lamp = new three.DirectionalLight(0xffffff, 3);
  lamp.position.set(2, 3, 1);
  scene.add(lamp, new three.AmbientLight(0xffffff, 1));
  let mesh;
  if (isOriginal) {
    [mesh] = (await new GLTFLoader().loadAsync(`${address}.glb`)).scene.children;
    mesh.geometry.computeVertexNormals();
    mesh.material.flatShading = false;
  } else {
    mesh = await new TksLoader().loadAsync(`${address}.tks`);
    mesh.show(await mesh.terrain.decode({normals: true}));
    mesh.material.side = three.FrontSide;
  }
  if (flip) mesh.material.normalScale.y *= -1;
  scene.add(mesh);
  const renderer = new three.WebGLRenderer({preserveDrawingBuffer: true, antialias: true});
  renderer.setSize(256, 256);
  document.body.append(renderer.domElement);
  renderer.render(scene, camera);
}
const pictureOf = (asked, name) => browser.withPage(async (page) => {
  await page.goto(server.url + 'test/core.html');
  await page.addStyleTag({content: 'body { margin: 0 }'});
  await page.evaluate(draw, asked);
  return page.screenshot({path: PICTURES && `${PICTURES}/maps_${name}.png`});
});

test('it is drawn as the mesh that was encoded, by every lamp', {skip, ...TIMEOUT}, async () => {
  const drawn = [await pictureOf({isOriginal: true}, 'original'), await pictureOf({}, 'stream'),
    await pictureOf({flip: true}, 'flipped')];
  const all = {x: 0, y: 0, width: 256, height: 256};
  const likeness = (a, b) => browser.withPage((page) => psnr(page, [a, b], [all, all]));
  const [near, far] = [await likeness(drawn[0], drawn[1]), await likeness(drawn[0], drawn[2])];
  assert.ok(near > LEAST, `${near} dB`);
  assert.ok(far < near - 6, `${far} dB with normals upside down`);
});
