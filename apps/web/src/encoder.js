// SPDX-License-Identifier: Apache-2.0
// Calls the encoder's WebAssembly module. Nothing here waits: it runs in a worker as well.
import {TksError} from './error.js';
import {DOMAINS} from './domains.js';
import {Instance, MESSAGE_BYTES, SAMPLES, failureOf} from './instance.js';

export const EXHAUSTED = 'The encoder ran out of memory: a page has 4 GB at most.';

const REGISTRATIONS = ['unknown', 'area', 'point'];
/** Of a forest the encoder would have to be told how its patches are glued. */
const ENCODED = DOMAINS.filter((name) => name !== 'forest');
const WEIGHTS = ['psnr', 'visual'];
const INDEXES = [false, true, 'windows'];
/** The module counts by integers of 64 and of 32 bits. */
const MOST_BYTES = 2 ** 53, MOST_TRIANGLES = 2 ** 32 - 1;

function oneOf(names, name, what) {
  const number = names.indexOf(name ?? names[0]);
  if (number < 0) throw new TksError('usage', `${what} is one of ${names.join(', ')}.`);
  return number;
}

const domainOf = ({domain}) => DOMAINS.indexOf(ENCODED[oneOf(ENCODED, domain, 'domain')]);

/** The number of tks_sample that arrays of this type are. */
function sampleOf(data, what) {
  const Type = data instanceof Uint8ClampedArray ? Uint8Array : data?.constructor;
  const sample = SAMPLES.indexOf(Type);
  if (sample < 0) {
    const types = SAMPLES.map(({name}) => name).join(', ');
    throw new TksError('usage', `The data of ${what} are one of these typed arrays: ${types}.`);
  }
  return sample;
}

function checkSize({data, width, height}, channels, what) {
  const isSide = (side) => Number.isInteger(side) && side > 0 && side < 2 ** 32;
  if (isSide(width) && isSide(height) && data.length === width * height * channels) return;
  throw new TksError('usage', `${what}: ${width} x ${height} samples of ${channels} are not the ` +
    `${data.length} of its data.`);
}

/** A geotransform as six numbers, their names beginning with `letter`. */
function placed(geotransform, flag, letter) {
  if (!geotransform) return {};
  if (geotransform.length !== 6) throw new TksError('usage', 'A geotransform has six numbers.');
  return {[flag]: 1, ...Object.fromEntries([...geotransform].map((v, i) => [letter + i, v]))};
}

/** Undeclared, declared, or to be found by the encoder. */
function nodataFields(nodata) {
  if (nodata === 'auto') return {hasNodata: 2, nodata: 0};
  return {hasNodata: nodata === undefined || nodata === null ? 0 : 1, nodata: nodata ?? 0};
}

/** Metres between columns and between rows. */
function spacingsOf(spacing) {
  const both = Array.isArray(spacing) ? spacing : [spacing, spacing];
  if (both.length === 2 && both.every((metres) => typeof metres === 'number')) return both;
  throw new TksError('usage', 'spacing is a number of metres, or two: of columns and of rows.');
}

function heightsFields(heights) {
  const {data, width, height, nodata} = heights;
  const sample = sampleOf(data, 'heights');
  checkSize(heights, 1, 'heights');
  const [spacingX, spacingY] = spacingsOf(heights.spacing ?? 0);
  const {scale = 1, offset = 0, step = 0} = heights;
  return {
    width, height, sample, scale, offset, step, spacingX, spacingY,
    ...nodataFields(nodata),
    registration: oneOf(REGISTRATIONS, heights.registration, 'registration'),
    domain: domainOf(heights),
    ...placed(heights.geotransform, 'hasGeotransform', 'g'),
  };
}

/** 0: found by the encoder. */
function whiteLevelOf({whiteLevel = 0}) {
  if (Number.isInteger(whiteLevel) && whiteLevel >= 0 && whiteLevel <= 65535) return whiteLevel;
  throw new TksError('usage', 'whiteLevel is a whole number from 0 to 65535.');
}

/** Of a texture: as said, or as the length of its data tells. */
function channelsOf({data, width, height, channels}) {
  const count = channels ?? data.length / (width * height);
  if ([1, 2, 3, 4].includes(count)) return count;
  throw new TksError('usage', `texture: ${width} x ${height} texels of 1, 2, 3 or 4 channels are ` +
    `not the ${data.length} values of its data.`);
}

function textureFields(texture) {
  const {data, width, height} = texture;
  const sample = sampleOf(data, 'the texture');
  const channels = channelsOf(texture);
  checkSize(texture, channels, 'texture');
  return {
    textureWidth: width, textureHeight: height, textureChannels: channels, textureSample: sample,
    textureOpaque: Number(texture.opaque ?? false),
    textureWhiteLevel: whiteLevelOf(texture),
    textureRegistration: oneOf(REGISTRATIONS, texture.registration, 'registration'),
    textureDomain: domainOf(texture),
    ...placed(texture.geotransform, 'textureHasGeotransform', 't'),
  };
}

/** The module takes 0 for none: as a target it is a mistake, and would make a lossless stream. */
function targetsOf({bytes, psnr, maxError, lossless}) {
  const given = Object.entries({bytes, psnr, maxError})
    .filter(([, value]) => value !== undefined && value !== null);
  for (const [name, value] of given) {
    if (value > 0 && value < Infinity) continue;
    throw new TksError('usage', `${name} is a number above 0, and finite. Without a target, or ` +
      'with `lossless: true`, streams are lossless.');
  }
  return {bytes: 0, psnr: 0, maxError: 0, lossless: Number(lossless ?? given.length === 0),
    ...Object.fromEntries(given)};
}

/** What web_encode() takes, by name. */
function fieldsOf({heights, texture, ...options}) {
  const {triangles = 0, regions = 0} = options, targets = targetsOf(options);
  for (const [name, value] of Object.entries({triangles, regions})) {
    if (value >= 0 && value < Infinity) continue;
    throw new TksError('usage', `${name} is a number that is not negative, and finite.`);
  }
  return {
    ...(heights ? heightsFields(heights) : {}), ...(texture ? textureFields(texture) : {}),
    ...targets, bytes: Math.min(targets.bytes, MOST_BYTES),
    triangles: Math.min(triangles, MOST_TRIANGLES), regions,
    index: oneOf(INDEXES, options.index, 'index'),
    weights: oneOf(WEIGHTS, options.weights, 'weights'),
  };
}

/** The texts of an input, by their names. */
function textsOf({heights, texture}) {
  const {unit, verticalDatum, crs, description, geoKeys} = heights ?? {};
  return {unit, verticalDatum, crs, description, geoKeys,
    textureCrs: texture?.crs, textureGeoKeys: texture?.geoKeys};
}

/** Memory of an instance for one encoding; the instance is then thrown away. */
class Allocation {
  constructor(instance) {
    this.instance = instance;
  }
  array(array) {
    const address = this.instance.allocate(array.byteLength);
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    this.instance.view(Uint8Array, address, bytes.length).set(bytes);
    return address;
  }
  text(text) {
    return text === undefined || text === null ? 0
      : this.array(new TextEncoder().encode(`${text}\0`));
  }
}

/** tks_encode. `progress` is told how much is done, from 0 to 1; what it throws comes back. */
export function encodeWith(module, input, progress) {
  const fields = fieldsOf(input), texts = textsOf(input);
  let thrown = null;
  const watched = (done) => {
    try {
      progress(done);
    } catch (error) {
      thrown = {error};
      throw error;
    }
  };
  try {
    // WASI's, by which the module knows when to report again: nanoseconds, as a 64-bit number.
    const clock_time_get = (clock, precision, address) => {
      instance.view(BigInt64Array, address, 1)[0] = BigInt(Math.round(performance.now() * 1e6));
      return 0;
    };
    const instance = new Instance(module, {web_progress: watched, clock_time_get});
    const {calls} = instance;
    const memory = new Allocation(instance);
    const names = (call) => instance.text(calls[call]()).split(' ');
    const numbers = memory.array(
      Float64Array.from(names('web_encode_names'), (name) => fields[name] ?? 0));
    const strings = memory.array(
      Uint32Array.from(names('web_encode_texts'), (name) => memory.text(texts[name])));
    const data = memory.array(Uint32Array.from([input.heights, input.texture],
      (part) => (part ? memory.array(part.data) : 0)));
    const out = instance.allocate(8 + MESSAGE_BYTES);
    const status = calls.web_encode(numbers, strings, data, out, out + 8, MESSAGE_BYTES);
    if (status !== 0) throw TksError.ofStatus(status, instance.text(out + 8));
    const [address, size] = instance.view(Uint32Array, out, 2);
    return instance.copy(Uint8Array, address, size);
  } catch (error) {
    throw thrown ? thrown.error : failureOf(error, EXHAUSTED);
  }
}
