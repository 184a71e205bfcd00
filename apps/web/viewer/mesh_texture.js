// SPDX-License-Identifier: Apache-2.0
// The texture that a mesh shows: its picture without alpha, multiplied by a base colour that is a
// factor of light. Light of stored values: sRGB (IEC 61966-2-1).
import {chosenBands, fewerPixelsOf} from './picture_file.js';

const WHITE = 255;

/** Both from 0 to 1. */
const lightOf = (value) =>
  (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const valueOf = (light) =>
  (light <= 0.0031308 ? light * 12.92 : 1.055 * light ** (1 / 2.4) - 0.055);

/** What the values of a channel become. */
const multiplied = (factor) => Uint8ClampedArray.from({length: WHITE + 1},
  (_, value) => WHITE * valueOf(factor * lightOf(value / WHITE)));

/** Of a picture's file, as encodeObject() takes it, halved where it is too large. Black counts as
 * white: programs write it beside textures, which would leave nothing of them. */
export async function textureOf(file, colour) {
  const {width, height, data} = await fewerPixelsOf(file);
  const texels = new Uint8Array(chosenBands(data, 4, [0, 1, 2]).buffer);
  const [red, green, blue] = colour;
  if (![0, 1].includes(red) || red !== green || red !== blue) {
    const values = [red, green, blue].map(multiplied);
    for (let i = 0; i < texels.length; ++i) texels[i] = values[i % 3][texels[i]];
  }
  return {width, height, channels: 3, data: texels};
}
