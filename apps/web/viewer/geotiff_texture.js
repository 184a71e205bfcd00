// SPDX-License-Identifier: Apache-2.0
// Images of GeoTIFFs as textures: which band is which colour, and what a nodata value leaves out.
import {chosenBands} from './picture_file.js';

/** Of a directory of the file; undefined: it has no such tag. */
export const tagOf = (directory, name) =>
  (directory.hasTag(name) ? directory.getValue(name) : undefined);

/** Of the tag ExtraSamples (TIFF 6.0): alpha that is multiplied into the colours, or is not. */
const ALPHAS = [1, 2];
const RGB = 2;
/** Where bands lie in a texture; others lie before alpha. */
const RANKS = {red: 0, green: 1, blue: 2, alpha: 4}, OTHER = 3;

/** Of each band, by the tags of TIFF 6.0 and by what GDAL writes where these cannot say it. */
async function ranksOf(image) {
  const directory = image.fileDirectory, bands = image.getSamplesPerPixel();
  const extras = tagOf(directory, 'ExtraSamples') ?? [];
  const isRgb = tagOf(directory, 'PhotometricInterpretation') === RGB;
  const ranks = [];
  for (let band = 0; band < bands; ++band) {
    const {COLORINTERP} = {...(await image.getGDALMetadata(band))};
    const isAlpha = ALPHAS.includes(extras[band - (bands - extras.length)]);
    const byTags = isAlpha ? RANKS.alpha : isRgb && band < 3 ? band : OTHER;
    ranks.push(COLORINTERP ? RANKS[COLORINTERP.toLowerCase()] ?? OTHER : byTags);
  }
  return ranks;
}

/** With an alpha of 0 where all channels have the value, unless none or all pixels do. */
function cutOut({data, channels, ...texture}, nodata) {
  const pixels = data.length / channels, hidden = new Uint8Array(pixels).fill(1);
  for (let i = 0; i < data.length; ++i) if (data[i] !== nodata) hidden[(i / channels) | 0] = 0;
  const count = hidden.reduce((sum, one) => sum + one, 0);
  if (count === 0 || count === pixels) return {...texture, data, channels, opaque: true};
  const shown = data instanceof Uint8Array ? 255 : 65535;
  const result = new data.constructor(pixels * (channels + 1));
  for (let i = 0, out = 0; i < pixels; ++i) {
    for (let c = 0; c < channels; ++c) result[out++] = data[i * channels + c];
    result[out++] = hidden[i] ? 0 : shown;
  }
  return {...texture, data: result, channels: channels + 1};
}

/** Grey or RGB, then alpha or a further colour, whatever the order of the bands. */
export async function textureOf(image, data, place) {
  const ranks = await ranksOf(image), channels = ranks.length;
  const inOrder = ranks.map((_, band) => band).sort((a, b) => ranks[a] - ranks[b] || a - b);
  const bands = inOrder.slice(0, 4);
  const texture = {...place, width: image.getWidth(), height: image.getHeight(),
    channels: bands.length, data: chosenBands(data, channels, bands)};
  if (ranks[bands.at(-1)] === RANKS.alpha) return texture;
  const nodata = image.getGDALNoData();
  return nodata !== null && bands.length % 2 === 1 ? cutOut(texture, nodata)
    : {...texture, opaque: true};
}
