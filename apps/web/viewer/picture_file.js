// SPDX-License-Identifier: Apache-2.0
// Pictures as the browser reads them.

/** A page's memory holds no more while it encodes. */
const MOST_SAMPLES = 2 ** 24;

export function checkSize(name, width, height) {
  if (width * height <= MOST_SAMPLES) return;
  throw new Error(`${name} has ${width} × ${height} samples, more than a page can encode (4096 × ` +
    '4096). The command line can: tetrakis encode.');
}

/** Those bands of each pixel, one after the other. */
export function chosenBands(data, channels, bands) {
  const result = new data.constructor((data.length / channels) * bands.length);
  let out = 0;
  for (let pixel = 0; pixel < data.length; pixel += channels) {
    for (const band of bands) result[out++] = data[pixel + band];
  }
  return result;
}

const bitmapOf = (source, size = {}) => createImageBitmap(
  source, {premultiplyAlpha: 'none', colorSpaceConversion: 'none', ...size});

/** RGBA of 8 bits. Ends the bitmap. */
function pixelsIn(bitmap) {
  const {width, height} = bitmap;
  const context = new OffscreenCanvas(width, height).getContext('2d', {willReadFrequently: true});
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return {width, height, data: context.getImageData(0, 0, width, height).data};
}

/** Of a picture's file: {width, height, data}, RGBA of 8 bits as they are stored. */
export async function pixelsOf(name, file) {
  const bitmap = await bitmapOf(file);
  checkSize(name, bitmap.width, bitmap.height);
  return pixelsIn(bitmap);
}

/** Likewise of a picture of any size, halved until a page can encode it. */
export async function fewerPixelsOf(file) {
  let bitmap = await bitmapOf(file);
  while (bitmap.width * bitmap.height > MOST_SAMPLES) {
    const [resizeWidth, resizeHeight] = [bitmap.width, bitmap.height].map((n) => Math.ceil(n / 2));
    const smaller = await bitmapOf(bitmap, {resizeWidth, resizeHeight, resizeQuality: 'high'});
    bitmap.close();
    bitmap = smaller;
  }
  return pixelsIn(bitmap);
}
