// SPDX-License-Identifier: Apache-2.0
// GeoTIFFs as the viewer reads them.
import assert from 'node:assert/strict';
import test from 'node:test';
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
