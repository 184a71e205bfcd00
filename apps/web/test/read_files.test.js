// SPDX-License-Identifier: Apache-2.0
// GeoTIFFs as the viewer reads them.
import assert from 'node:assert/strict';
import test from 'node:test';
import {bodyOf} from '../src/body.js';
import {encode} from '../src/encode.js';
import {open} from '../src/index.js';
import {readFiles} from '../viewer/read_files.js';
import {tiffOf} from './terrain.js';

const ALPHA = 2, UNSAID = 0, RGB = 2, GREY = 1;
const text = (tag, words) => [tag, 2, words.length + 1, [...Buffer.from(words + '\0')]];
const colours = (names) => text(42112, '<GDALMetadata>' + names.map((name, band) =>
  `<Item name="COLORINTERP" sample="${band}" role="colorinterp">${name}</Item>`).join('') +
  '</GDALMetadata>');
const nodata = (value) => text(42113, String(value));

/** A file of 3 x 2 pixels of 16 bits; bands: their values, or one value for all pixels. */
function imageOf(bands, photometric, extras, ...tags) {
  const pixel = (i) => bands.map((band) => (Array.isArray(band) ? band[i] : band));
  const data = [0, 1, 2, 3, 4, 5].flatMap(pixel), each = (value) => bands.map(() => value);
  const file = tiffOf({data, width: 3, height: 2}, [
    [258, 3, bands.length, each(16)], [262, 3, 1, photometric], [277, 3, 1, bands.length],
    [339, 3, bands.length, each(1)],
    ...(extras.length > 0 ? [[338, 3, extras.length, extras]] : []), ...tags]);
  return new File([file], 'image.tif');
}

async function textureOf(...description) {
  const {texture} = await readFiles([imageOf(...description)]);
  const {channels, data} = texture, bands = [];
  assert.deepEqual([texture.width, texture.height], [3, 2]);
  for (let c = 0; c < channels; ++c) {
    const band = [...data].filter((_, i) => i % channels === c);
    bands.push(band.every((value) => value === band[0]) ? band[0] : band);
  }
  return {bands, opaque: texture.opaque ?? false};
}

test('bands of an image become RGB, then alpha or a further colour', async () => {
  const bgr = ['Blue', 'Green', 'Red'];
  const cases = [
    [[[10, 20, 30], RGB, []], [10, 20, 30], true],
    [[[10, 20, 30, [0, 9, 9, 9, 9, 9]], RGB, [ALPHA]], [10, 20, 30, [0, 9, 9, 9, 9, 9]], false],
    [[[10, 20, 30, 40], RGB, [UNSAID]], [10, 20, 30, 40], true],
    [[[10, 20, 30], GREY, [UNSAID, UNSAID], colours(bgr)], [30, 20, 10], true],
    [[[10, 20, 30, 40], GREY, [UNSAID, UNSAID, UNSAID], colours([...bgr, 'Undefined'])],
      [30, 20, 10, 40], true],
    [[[9, 10, 20, 30], GREY, [UNSAID, UNSAID, UNSAID], colours(['Alpha', ...bgr])],
      [30, 20, 10, 9], false],
    [[[1, 10, 20, 30, 2], GREY, [0, 0, 0, 0], colours(['Undefined', ...bgr, 'Undefined'])],
      [30, 20, 10, 1], true],
  ];
  for (const [given, bands, opaque] of cases) {
    assert.deepEqual(await textureOf(...given), {bands, opaque}, JSON.stringify(given));
  }
});

test('the spacing of heights is that on the ground', async () => {
  const spacingAt = async (code, north) => {
    const keys = [1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, code];
    const file = tiffOf({data: [0, 1, 2, 3, 4, 5], width: 3, height: 2}, [
      [33550, 12, 3, [40, 20, 0]], [33922, 12, 6, [0, 0, 0, 7e5, north, 0]],
      [34735, 3, keys.length, keys]]);
    return (await readFiles([new File([file], 'heights.tif')])).heights.spacing;
  };
  assert.deepEqual(await spacingAt(32633, 5e6), [40, 20]);
  // Web Mercator, at 60 degrees north.
  const [x, y] = await spacingAt(3857, 8399737.89 + 20);
  assert.ok(Math.abs(x - 20) < 1e-3 && Math.abs(y - 10) < 1e-3, `${x}, ${y}`);
});

test('a CRS without a code keeps its keys, and so the body that it is of', async () => {
  const name = 'Moon "2000"|', axes = [1737400, 1737400.5];
  const keys = [1, 1, 0, 5, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 32767,
    2049, 34737, name.length, 0, 2057, 34736, 1, 0, 2058, 34736, 1, 1];
  keys[3] = keys.length / 4 - 1;
  const file = tiffOf({data: [0, 1, 2, 3, 4, 5], width: 3, height: 2}, [
    [33550, 12, 3, [120, 90, 0]], [33922, 12, 6, [0, 0, 0, -180, 90, 0]],
    [34735, 3, keys.length, keys], [34736, 12, 2, axes], text(34737, name)]);
  const {heights} = await readFiles([new File([file], 'moon.tif')]);
  assert.equal(heights.geoKeys,
    '1024=2 2048=32767 2049="Moon ""2000""" 2057=1737400.0 2058=1737400.5');
  assert.deepEqual(bodyOf({geoKeys: heights.geoKeys}),
    {semiMajor: 1737400, semiMinor: 1737400.5});
  const stream = await encode({heights, bytes: 600});
  const terrain = await open(stream);
  assert.equal(terrain.info.geoKeys, heights.geoKeys);
  terrain.dispose();
});

test('pixels that have the nodata value in all bands are cut out', async () => {
  const first = [7, 7, 3, 4, 5, 6], second = [7, 8, 7, 4, 5, 6];
  const alpha = [0, ...Array(5).fill(65535)];
  const read = (...bands) => textureOf(bands, RGB, bands.length > 3 ? [ALPHA] : [], nodata(7));
  assert.deepEqual(await read(first, second, first),
    {bands: [first, second, first, alpha], opaque: false});
  assert.deepEqual(await read(7, 7, 7), {bands: [7, 7, 7], opaque: true});
  assert.deepEqual(await read(1, 2, 3), {bands: [1, 2, 3], opaque: true});
  assert.deepEqual(await read(first, second, first, 9), {bands: [first, second, first, 9],
    opaque: false});
});
