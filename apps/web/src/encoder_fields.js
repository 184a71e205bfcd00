// SPDX-License-Identifier: Apache-2.0
// What encoders of terrain and of objects are told alike: texels, targets, names for numbers.
import {TksError} from './error.js';
import {SAMPLES} from './instance.js';

/** The modules count by integers of 64 bits. */
const MOST_BYTES = 2 ** 53;

/** The number of a name; of none, that of the first. */
export function oneOf(names, name, what) {
  const number = names.indexOf(name ?? names[0]);
  if (number < 0) throw new TksError('usage', `${what} is one of ${names.join(', ')}.`);
  return number;
}

/** The number of tks_sample that arrays of this type are. */
export function sampleOf(data, what) {
  const Type = data instanceof Uint8ClampedArray ? Uint8Array : data?.constructor;
  const sample = SAMPLES.indexOf(Type);
  if (sample < 0) {
    const types = SAMPLES.map(({name}) => name).join(', ');
    throw new TksError('usage', `The data of ${what} are one of these typed arrays: ${types}.`);
  }
  return sample;
}

export function checkSize({data, width, height}, channels, what) {
  const isSide = (side) => Number.isInteger(side) && side > 0 && side < 2 ** 32;
  if (isSide(width) && isSide(height) && data.length === width * height * channels) return;
  throw new TksError('usage', `${what}: ${width} x ${height} samples of ${channels} are not the ` +
    `${data.length} of its data.`);
}

/** 0: found by the encoder. */
function whiteLevelOf({whiteLevel = 0}) {
  if (Number.isInteger(whiteLevel) && whiteLevel >= 0 && whiteLevel <= 65535) return whiteLevel;
  throw new TksError('usage', 'whiteLevel is a whole number from 0 to 65535.');
}

/** Of an image: as said, or as the length of its data tells. */
function channelsOf({data, width, height, channels}, name) {
  const count = channels ?? data?.length / (width * height);
  if ([1, 2, 3, 4].includes(count)) return count;
  throw new TksError('usage', `${name}: ${width} x ${height} texels of 1, 2, 3 or 4 channels are ` +
    `not the ${data?.length} values of its data.`);
}

/** Of an image, without its place; their names begin with that of the image. */
export function imageFields(image, name) {
  const {data, width, height} = image, channels = channelsOf(image, name);
  checkSize(image, channels, name);
  return {
    [`${name}Width`]: width, [`${name}Height`]: height, [`${name}Channels`]: channels,
    [`${name}Sample`]: sampleOf(data, `the ${name}`),
  };
}

/** Of a texture, without its place. */
export function texelFields(texture) {
  return {
    ...imageFields(texture, 'texture'), textureOpaque: Number(texture.opaque ?? false),
    textureWhiteLevel: whiteLevelOf(texture),
  };
}

/** Those that are given. The modules take 0 for none: as a target it is a mistake. */
export function targetFields({bytes, psnr, maxError}, otherwise = '') {
  const given = Object.entries({bytes, psnr, maxError})
    .filter(([, value]) => value !== undefined && value !== null);
  for (const [name, value] of given) {
    if (value > 0 && value < Infinity) continue;
    throw new TksError('usage', `${name} is a number above 0, and finite.${otherwise}`);
  }
  const targets = Object.fromEntries(given);
  if (targets.bytes) targets.bytes = Math.min(targets.bytes, MOST_BYTES);
  return targets;
}
