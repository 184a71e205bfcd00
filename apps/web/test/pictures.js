// SPDX-License-Identifier: Apache-2.0
// How far pictures are from each other.

/** dB between areas {x, y, width, height} of two pictures (PNG) of one size, over R, G and B; any
 * page reads them. */
export const psnr = (page, pictures, areas) => page.evaluate(async ([files, parts]) => {
  const pixels = async (base64, {x, y, width, height}) => {
    const blob = await (await fetch('data:image/png;base64,' + base64)).blob();
    const image = await createImageBitmap(blob, {colorSpaceConversion: 'none'});
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(x, y, width, height).data;
  };
  const [a, b] = await Promise.all(files.map((file, i) => pixels(file, parts[i])));
  const squares = a.reduce((sum, value, i) => sum + (value - b[i]) ** 2, 0);
  return 10 * Math.log10(255 ** 2 / ((squares * 4) / 3 / a.length));
}, [pictures.map((picture) => picture.toString('base64')), areas]);
