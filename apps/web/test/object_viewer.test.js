// SPDX-License-Identifier: Apache-2.0
// Objects in the viewer, in headless Chromium: seen from all sides, with the controls that they
// have. Scans need a built `tetrakis` (TETRAKIS_CLI).
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {once} from 'node:events';
import {existsSync} from 'node:fs';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {ballOf, pngOf, shinyGlb} from './meshes.js';
import {psnr} from './pictures.js';
import {MIDDLE, drawn, viewerSite} from './viewer_site.js';

const CLI = process.env.TETRAKIS_CLI ??
  new URL('../../../build/tetrakis', import.meta.url).pathname;
const skip = !existsSync(CLI);
const TIMEOUT = {timeout: 120000};
const vectors = new URL('../../../conformance/vectors/', import.meta.url).pathname;
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
const ONLY_PICTURE = 'aside, header, #bearings { display: none !important }';
/** A part of eight flat sides and no texture, as Wavefront OBJ. */
const wedge = 'v 0 0 0\nv 3 0 0\nv 3 1 0\nv 0 2 0\nv 0 0 2\nv 3 0 2\n' +
  'f 1 3 2\nf 1 4 3\nf 1 2 6\nf 1 6 5\nf 2 3 6\nf 4 1 5\nf 3 4 5\nf 3 5 6\n';
/** A grey ball that shines yellow on one half, and is of dimpled metal on the other. */
const lamp = () => shinyGlb(ballOf(16, 0), {
  baseColorTexture: pngOf(16, (x) => [120 + 20 * x, 130, 130]),
  normalTexture: pngOf(64, (x, y) =>
    [128 + 50 * Math.sin(90 * x), 128 + 50 * Math.sin(60 * y), 230]),
  metallicRoughnessTexture: pngOf(16, (x) => [255, 60, 255 * (x > 0.5)]),
  emissiveTexture: pngOf(16, (x) => (x < 0.5 ? [255, 220, 0] : [0, 0, 0])),
}, {emissiveFactor: [1, 1, 1]});
let folder, site;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), 'tetrakis-'));
  const files = {
    'joint.tks': await readFile(vectors + 'object_joint_9x54_17x102.tks'),
    'bare.tks': await readFile(vectors + 'object_torus_9x144.tks'),
  };
  if (!skip) {
    const run = (...args) => execFileSync(CLI, [...args, '-q'], {cwd: folder});
    run('synth', '--kind', 'scan', '--triangles', '3000', '-o', 'scan.glb');
    run('synth', '--kind', 'knot', '--triangles', '3000', '-o', 'knot.glb');
    await writeFile(join(folder, 'part.obj'), wedge);
    await writeFile(join(folder, 'lamp.glb'), lamp());
    for (const [maps, stream] of [['all', 'lamp.tks'], ['none', 'matt.tks']]) {
      run('encode', 'lamp.glb', '--bytes', '40k', '--class', 'triangles', '--maps', maps, '-o',
        stream);
      files[stream] = await readFile(join(folder, stream));
    }
    for (const [name, kind] of [['scan.glb', 'resampled'], ['knot.glb', 'triangles'],
      ['part.obj', 'triangles']]) {
      const stream = name.replace(/\..*/, '.tks');
      run('encode', name, '--bytes', '30k', '--class', kind, '-o', stream);
      files[stream] = await readFile(join(folder, stream));
    }
  }
  site = await viewerSite(files);
});
after(async () => {
  await site.close();
  await rm(folder, {recursive: true});
});

const text = (page, selector) => page.locator(selector).textContent();
const isVisible = (page, selector) => page.locator(selector).isVisible();

/** Share of the pixels that an object covers, and how many colours it has there, coarsely. */
async function seen(page, name) {
  const path = PICTURES && `${PICTURES}/viewer_${name}.png`;
  const empty = `${ONLY_PICTURE} #picture { visibility: hidden }`;
  const pictures = [await page.screenshot({style: ONLY_PICTURE, path}),
    await page.screenshot({style: empty})];
  return page.evaluate(async (files) => {
    const [a, b] = await Promise.all(files.map(async (base64) => {
      const blob = await (await fetch('data:image/png;base64,' + base64)).blob();
      const image = await createImageBitmap(blob);
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }));
    const colours = new Set();
    let covered = 0;
    for (let i = 0; i < a.length; i += 4) {
      if (Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]) < 6) continue;
      ++covered;
      colours.add((a[i] >> 4 << 8) | (a[i + 1] >> 4 << 4) | a[i + 2] >> 4);
    }
    return {share: (4 * covered) / a.length, colours: colours.size};
  }, pictures.map((file) => file.toString('base64')));
}
async function assertSeen(page, name) {
  const {share, colours} = await seen(page, name);
  assert.ok(share > 0.08 && share < 0.7 && colours > 12, `${name}: ${share}, ${colours} colours`);
}
/** Three numbers that the address gives. */
const given = (page, name) => new URLSearchParams(decodeURIComponent(new URL(page.url()).hash)
  .slice(1)).get(name).split(',').map(Number);

test('an object fills the picture, with its texture or without one', TIMEOUT, async () => {
  for (const name of ['joint', 'bare']) {
    await site.withPage(`tks=${name}.tks`, async (page) => {
      await assertSeen(page, name);
      assert.match(await text(page, '#size'), /^(6|16) patches of 9 × 9 heights/);
      assert.match(await text(page, '#rmse'), /exact|\d/);
      assert.equal(await isVisible(page, '#texture-quality'), name === 'joint');
      assert.equal(await isVisible(page, '#textured'), name === 'joint');
    });
  }
});

test('maps of a material light an object, and mirror what is around it', {skip, ...TIMEOUT},
  async () => {
    const pictures = [];
    for (const name of ['lamp', 'matt']) {
      await site.withPage(`tks=${name}.tks`, async (page) => {
        const path = PICTURES && `${PICTURES}/viewer_${name}.png`;
        pictures.push(await page.screenshot({style: ONLY_PICTURE, path}));
        assert.match(await text(page, '#size'), /^\d+ triangles/);
      });
    }
    const middle = {x: MIDDLE.x - 80, y: MIDDLE.y - 80, width: 160, height: 160};
    let likeness;
    await site.withPage('tks=matt.tks', async (page) => {
      likeness = await psnr(page, pictures, [middle, middle]);
    });
    assert.ok(likeness < 20, `${likeness} dB`);
  });

test('controls of ground are hidden, and back for terrain', TIMEOUT, async () => {
  await site.withPage('tks=joint.tks', async (page) => {
    const controls = ['#north', '#exaggeration', '#exaggeration-value', 'label[for=exaggeration]',
      '[data-kind=tif]'];
    for (const name of controls) assert.equal(await isVisible(page, name), false, name);
    for (const name of ['#triangles', '[data-kind=glb]', '[data-kind=png]', '#textured'])
      assert.ok(await isVisible(page, name), name);
    await page.locator('#file').setInputFiles(vectors + 'joint_budget_97x97_128x128.tks');
    await page.waitForFunction(() => document.body.dataset.bytes === '12000');
    await drawn(page);
    for (const name of controls) assert.ok(await isVisible(page, name), name);
    await page.locator('#file').setInputFiles(vectors + 'object_torus_9x144.tks');
    await page.waitForFunction(() => document.body.dataset.bytes === '900');
    await drawn(page);
    for (const name of controls) assert.equal(await isVisible(page, name), false, name);
    await assertSeen(page, 'behind_terrain');
  });
});

test('a drag goes below an object, and the address keeps the camera', TIMEOUT, async () => {
  await site.withPage('tks=bare.tks', async (page) => {
    await page.mouse.move(MIDDLE.x, MIDDLE.y);
    await page.mouse.down();
    await page.mouse.move(MIDDLE.x + 20, 40, {steps: 5});
    await page.mouse.up();
    await page.waitForFunction(() => {  // the camera rests, on a slow machine more than once
      const hash = new URLSearchParams(decodeURIComponent(location.hash.slice(1)));
      const [eye, target] = ['eye', 'target'].map((name) => hash.get(name)?.split(',').map(Number));
      return eye?.[1] < target?.[1];
    });
    await assertSeen(page, 'below');
    const before = await page.screenshot({style: ONLY_PICTURE});
    await page.reload();
    await drawn(page);
    const all = {x: 0, y: 0, width: 1000, height: 600};
    const again = await page.screenshot({style: ONLY_PICTURE});
    const likeness = await psnr(page, [before, again], [all, all]);
    assert.ok(likeness > 35, `${likeness} dB`);
  });
});

test('the pointer tells coordinates of the surface, and a double click goes there', TIMEOUT,
  async () => {
    await site.withPage('tks=joint.tks', async (page) => {
      await page.mouse.move(3, 300);
      await page.waitForTimeout(200);
      assert.equal(await text(page, '#under'), '');
      await page.mouse.move(MIDDLE.x, MIDDLE.y);
      await page.waitForFunction(() => document.getElementById('under').textContent);
      const [x, y, z] = (await text(page, '#under')).split(' · ').map(parseFloat);
      await page.mouse.dblclick(MIDDLE.x, MIDDLE.y);
      await page.waitForTimeout(2000);
      const away = given(page, 'target').map((part, axis) => part - [x, y, z][axis]);
      assert.ok(Math.hypot(...away) < 100, `${away} of 30000 units`);
    });
  });

/** What a button saves. */
async function saved(page, kind) {
  const [download] = await Promise.all(
    [page.waitForEvent('download'), page.locator(`[data-kind=${kind}]`).click()]);
  return readFile(await download.path());
}

/** The document of a binary glTF. */
const documentOf = (glb) => JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());

test('mesh and atlas can be saved', TIMEOUT, async () => {
  await site.withPage('tks=joint.tks', async (page) => {
    const glb = await saved(page, 'glb'), png = await saved(page, 'png');
    const {nodes, accessors, images} = documentOf(glb);
    assert.deepEqual([nodes[0].name, nodes[0].translation], ['object', [0, 0, 0]]);
    assert.equal(accessors[3].count, 3 * 768);
    assert.equal(images.length, 1);
    assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [57, 38]);
  });
  await site.withPage('tks=bare.tks', async (page) => {
    const {images} = documentOf(await saved(page, 'glb'));
    assert.equal(images, undefined);
  });
});

test('a scan refines, and sliders take bytes and triangles back', {skip, ...TIMEOUT}, async () => {
  await site.withPage('tks=scan.tks', async (page) => {
    await assertSeen(page, 'scan');
    const [, patches] = /^(\d+) patches/.exec(await text(page, '#size'));
    const count = async (name) => Number((await text(page, name)).replaceAll('\u2009', ''));
    const many = await count('#triangles-here');
    await page.locator('#triangles').fill('0');
    await page.waitForTimeout(300);
    await drawn(page);
    assert.equal(await count('#triangles-value'), 100);
    const few = await count('#triangles-here');
    assert.ok(few > 80 && few <= 100, `${few}`);
    assert.ok(many > 8 * patches, `${many}`);
    await page.locator('#bytes').fill('0');
    await page.waitForFunction(() => Number(document.body.dataset.bytes) < 4096);
    await drawn(page);
    assert.equal(await text(page, '#psnr'), '–');
    await page.locator('#textured').click();
    await page.locator('#wireframe').click();
    await page.waitForTimeout(300);
    assert.ok((await seen(page, 'scan_header')).share > 0.02);
  });
});

test('triangles that are coded as they are have no slider, and refine their texture',
  {skip, ...TIMEOUT}, async () => {
    await site.withPage('tks=knot.tks', async (page) => {
      await assertSeen(page, 'knot');
      const size = /^2\u2009(\d+) triangles · 256 × 256 texels$/.exec(await text(page, '#size'));
      const isWhole = async () =>
        assert.equal(await text(page, '#triangles-here'), `2\u2009${size[1]}`);
      await isWhole();
      for (const name of ['#triangles', '#heights-quality', '[data-kind=tif]', '#exaggeration'])
        assert.equal(await isVisible(page, name), false, name);
      for (const name of ['[data-kind=glb]', '[data-kind=png]', '#textured', '#texture-quality'])
        assert.ok(await isVisible(page, name), name);
      const before = await page.screenshot({style: ONLY_PICTURE});
      const quality = await text(page, '#psnr');
      for (let i = 0; i < 2; ++i) await page.locator('#textured').click();
      await page.waitForTimeout(300);
      const all = {x: 0, y: 0, width: 1000, height: 600};
      const again = await page.screenshot({style: ONLY_PICTURE});
      assert.ok(await psnr(page, [before, again], [all, all]) > 50);
      const {accessors, samplers} = documentOf(await saved(page, 'glb'));
      assert.deepEqual([samplers[0].wrapS, samplers[0].wrapT], [10497, 10497]);
      assert.equal(accessors[3].count, 3 * Number(`2${size[1]}`));
      await page.locator('#bytes').fill('0');
      await page.waitForFunction((all) => document.getElementById('psnr').textContent !== all,
        quality);
      await drawn(page);
      await isWhole();
      assert.ok((await seen(page, 'knot_header')).share > 0.02);
    });
  });

test('a part without a texture fills the picture, too', {skip, ...TIMEOUT}, async () => {
  await site.withPage('tks=part.tks', async (page) => {
    assert.equal(await text(page, '#size'), '8 triangles');
    for (const name of ['#textured', '[data-kind=png]', '#texture-quality'])
      assert.equal(await isVisible(page, name), false, name);
    await assertSeen(page, 'part');
    const {images, accessors} = documentOf(await saved(page, 'glb'));
    assert.deepEqual([images, accessors[3].count], [undefined, 24]);
  });
});

test('tetrakis view opens an object', {skip, ...TIMEOUT}, async () => {
  for (const name of ['scan', 'part']) {
    const child = spawn(CLI, ['view', '--no-browser', join(folder, `${name}.tks`)]);
    try {
      const address = String((await once(child.stdout, 'data'))[0]).trim();
      await site.withPage('tks=bare.tks', async (page) => {
        await page.goto(address);
        await drawn(page);
        assert.match(await text(page, '#size'), /patches|triangles/);
      });
    } finally {
      child.kill();
    }
  }
});
