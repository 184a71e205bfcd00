// SPDX-License-Identifier: Apache-2.0
// Heights and textures as the encoder's WebAssembly module takes them.
import {DOMAINS} from './domains.js';
import {streamOf, withEncoder} from './encoder_call.js';
import {checkSize, oneOf, sampleOf, targetFields, texelFields} from './encoder_fields.js';
import {TksError} from './error.js';

const REGISTRATIONS = ['unknown', 'area', 'point'];
/** Of a forest the encoder would have to be told how its patches are glued. */
const ENCODED = DOMAINS.filter((name) => name !== 'forest');
const WEIGHTS = ['psnr', 'visual'];
const INDEXES = [false, true, 'windows'];
/** The module counts them by integers of 32 bits. */
const MOST_TRIANGLES = 2 ** 32 - 1;

const domainOf = ({domain}) => DOMAINS.indexOf(ENCODED[oneOf(ENCODED, domain, 'domain')]);

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
    positions: heights.positions?.length ?? 0,
  };
}

const textureFields = (texture) => ({
  ...texelFields(texture),
  textureRegistration: oneOf(REGISTRATIONS, texture.registration, 'registration'),
  textureDomain: domainOf(texture),
  ...placed(texture.geotransform, 'textureHasGeotransform', 't'),
  texturePositions: texture.positions?.length ?? 0,
});

/** Without a target streams are lossless. */
function targetsOf(options) {
  const targets = targetFields(options,
    ' Without a target, or with `lossless: true`, streams are lossless.');
  return {...targets, lossless: Number(options.lossless ?? Object.keys(targets).length === 0)};
}

/** What web_encode() takes, by name. */
function fieldsOf({heights, texture, ...options}) {
  const {triangles = 0, regions = 0} = options;
  for (const [name, value] of Object.entries({triangles, regions})) {
    if (value >= 0 && value < Infinity) continue;
    throw new TksError('usage', `${name} is a number that is not negative, and finite.`);
  }
  return {
    ...(heights ? heightsFields(heights) : {}), ...(texture ? textureFields(texture) : {}),
    ...targetsOf(options),
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

/** tks_encode. Heights and texture may have positions in the place of `project`. */
export function encodeWith(module, input, progress) {
  const {heights, texture} = input;
  const given = {numbers: fieldsOf(input), texts: textsOf(input),
    arrays: [heights?.data, texture?.data, heights?.positions, texture?.positions]};
  return withEncoder(module, progress, (instance) => streamOf(instance, 'web_encode', given));
}
