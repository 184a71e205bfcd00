// SPDX-License-Identifier: Apache-2.0
// Meshes that are dropped on the viewer, in headless Chromium: coded on the page, and shown.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {after, before, test} from 'node:test';

import {ballOf, glbFile, gltfOf, objOf} from './meshes.js';
import {drawn, viewerSite} from './viewer_site.js';

const TIMEOUT = {timeout: 240000};
/** Keeps the pictures, to be looked at. */
const PICTURES = process.env.TETRAKIS_PICTURES;
const vectors = new URL('../../../conformance/vectors/', import.meta.url).pathname;
const ball = ballOf(24);
ball.triangles.push(0, 0, 1);  // degenerate
let site;

before(async () => {
  site = await viewerSite({'bare.tks': await readFile(vectors + 'object_torus_9x144.tks')});
});
after(() => site.close());

const text = (page, selector) => page.locator(selector).textContent();

/** A PNG of stripes, red and green. */
const stripes = (page) => page.evaluate(async () => {
  const canvas = new OffscreenCanvas(128, 64), context = canvas.getContext('2d');
  for (let i = 0; i < 8; ++i) {
    context.fillStyle = ['#c01010', '#10a010'][i % 2];
    context.fillRect(16 * i, 0, 16, 64);
  }
  const blob = await canvas.convertToBlob({type: 'image/png'});
  return [...new Uint8Array(await blob.arrayBuffer())];
});

/** As if users dropped files: [name, bytes]. */
const drop = (page, files) => page.evaluate((all) => {
  const dataTransfer = new DataTransfer();
  for (const [name, bytes] of all) {
    dataTransfer.items.add(new File([Uint8Array.from(bytes)], name));
  }
  dispatchEvent(new DragEvent('drop', {dataTransfer, cancelable: true}));
}, files.map(([name, bytes]) => [name, [...bytes]]));

/** Waits until what was dropped is coded and shown, or refused. */
async function ended(page) {
  await page.waitForFunction(() => ['done', 'failed'].includes(document.body.dataset.state));
  await page.waitForTimeout(300);
}

/** Shares of pixels that are clearly red, and clearly green. */
async function coloured(page, name) {
  const style = 'aside, header, #bearings, #message { display: none !important }';
  const path = PICTURES && `${PICTURES}/viewer_${name}.png`;
  const base64 = (await page.screenshot({style, path})).toString('base64');
  return page.evaluate(async (png) => {
    const blob = await (await fetch('data:image/png;base64,' + png)).blob();
    const image = await createImageBitmap(blob);
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    const {data} = context.getImageData(0, 0, image.width, image.height);
    let red = 0, green = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i] > 2 * data[i + 1]) ++red;
      if (data[i + 1] > 1.5 * data[i] && data[i + 1] > 1.5 * data[i + 2]) ++green;
    }
    return {red: (4 * red) / data.length, green: (4 * green) / data.length};
  }, base64);
}

test('a dropped GLB is coded with its texture, shown, and can be saved', TIMEOUT, async () => {
  await site.withPage('tks=bare.tks', async (page) => {
    const {document, bytes} = gltfOf(ball, await stripes(page));
    document.scenes[0].nodes.push(document.nodes.push({mesh: 0, translation: [0, 2, 0]}) - 1);
    await drop(page, [['ball.glb', glbFile(document, bytes)]]);
    await page.waitForFunction(() => !document.getElementById('coding').hidden);
    await page.locator('#name').filter({hasText: 'ball.tks'}).waitFor();
    await drawn(page);
    assert.match(await text(page, '#size'), /patches|triangles/);
    assert.equal(await page.locator('#coding').isVisible(), false);
    assert.equal(await text(page, '#message'), 'ball.glb: 2 parts are joined; 2 triangles have ' +
      'equal corners or are there twice and are left out.');
    const {red, green} = await coloured(page, 'dropped_glb');
    assert.ok(red > 0.05 && green > 0.05, `${red} ${green}`);
    await page.locator('#bytes').fill('0');
    await page.waitForFunction(() => document.getElementById('psnr').textContent === '–' ||
      Number(document.body.dataset.bytes) < 8000);
    const [download] = await Promise.all(
      [page.waitForEvent('download'), page.locator('#save').click()]);
    assert.equal(download.suggestedFilename(), 'ball.tks');
    assert.equal((await readFile(await download.path())).subarray(0, 3).toString(), 'TKS');
  });
});

test('an OBJ takes the image that is dropped with it', TIMEOUT, async () => {
  await site.withPage('tks=bare.tks', async (page) => {
    await drop(page, [['ball.obj', objOf(ball)], ['stripes.png', await stripes(page)]]);
    await page.locator('#name').filter({hasText: 'ball.tks'}).waitFor();
    await drawn(page);
    const {red, green} = await coloured(page, 'dropped_obj');
    assert.ok(red > 0.05 && green > 0.05, `${red} ${green}`);
  });
});

test('the texture is the picture times the base colour, and no larger than a page encodes', TIMEOUT,
  async () => {
    await site.withPage('tks=bare.tks', async (page) => {
      /** Of a ball whose picture is of one colour: the size of its texture, and a texel. */
      const textureOf = async (colour, size, baseColorFactor) => {
        const picture = await page.evaluate(async ([fillStyle, [width, height]]) => {
          const canvas = new OffscreenCanvas(width, height), context = canvas.getContext('2d');
          Object.assign(context, {fillStyle}).fillRect(0, 0, width, height);
          const blob = await canvas.convertToBlob({type: 'image/png'});
          return [...new Uint8Array(await blob.arrayBuffer())];
        }, [colour, size]);
        const {document, bytes} = gltfOf(ball, picture);
        Object.assign(document.materials[0].pbrMetallicRoughness, {baseColorFactor});
        return page.evaluate(async (file) => {
          const {readMesh} = await import(new URL('read_mesh.js', document.baseURI));
          const {mesh} = await readMesh(new File([Uint8Array.from(file)], 'ball.glb'));
          const {width, height, channels, data} = mesh.texture;
          return {size: [width, height, channels], texel: [...data.subarray(0, 3)]};
        }, [...glbFile(document, bytes)]);
      };
      assert.deepEqual(await textureOf('rgb(200 100 0)', [16, 8], [1, 1, 1, 1]),
        {size: [16, 8, 3], texel: [200, 100, 0]});
      // A fifth of the light of 200, by sRGB, is that of 95.
      assert.deepEqual((await textureOf('rgb(200 100 0)', [16, 8], [0.2, 1, 1, 1])).texel,
        [95, 100, 0]);
      assert.deepEqual((await textureOf('rgb(200 100 0)', [16, 8], [0, 0, 0, 1])).texel,
        [200, 100, 0]);
      assert.deepEqual(await textureOf('rgb(8 16 32)', [8192, 4096], [1, 1, 1, 1]),
        {size: [4096, 2048, 3], texel: [8, 16, 32]});
    });
  });

test('coding can be cancelled, and what was shown stays', TIMEOUT, async () => {
  await site.withPage('tks=bare.tks', async (page) => {
    const shown = await text(page, '#size');
    const {document, bytes} = gltfOf(ballOf(60));
    await drop(page, [['ball.glb', glbFile(document, bytes)]]);
    await page.locator('#cancel').click();
    assert.equal(await page.locator('#coding').isVisible(), false);
    assert.deepEqual([await text(page, '#name'), await text(page, '#size')], ['bare.tks', shown]);
    await ended(page);
    await page.waitForTimeout(500);
    assert.equal(await text(page, '#name'), 'bare.tks');
  });
});

test('a mesh that cannot be read is refused with a sentence', TIMEOUT, async () => {
  await site.withPage('tks=bare.tks', async (page) => {
    const {document, bytes} = gltfOf(ball), whole = glbFile(document, bytes);
    const apart = {...document, buffers: [{byteLength: 9, uri: 'ball.bin'}]};
    const cases = [
      [[['cut.glb', whole.subarray(0, 3000)]], /^cut\.glb cannot be read as a mesh: it is damaged/],
      [[['ball.gltf', Buffer.from(JSON.stringify(apart))]], /another file, ball\.bin/],
      [[['none.obj', Buffer.from('v 0 0 0\n')]], /it has no triangles\.$/],
      [[['short.stl', Buffer.from('solid')]], /it is damaged/],
      [[['ball.obj', objOf(ball)], ['ball.mtl', Buffer.from('newmtl a')]],
        /ball\.mtl, which was given with it, is no image/],
      [[['a.glb', whole], ['b.glb', whole]], /^Drop one mesh, and at most one image/],
    ];
    for (const [files, sentence] of cases) {
      await drop(page, files);
      await page.waitForFunction(() => document.body.dataset.state === 'failed');
      assert.match(await text(page, '#message'), sentence);
      await page.evaluate(() => { document.body.dataset.state = ''; });
    }
    assert.equal(await text(page, '#name'), 'bare.tks');
  });
});
