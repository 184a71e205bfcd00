// SPDX-License-Identifier: Apache-2.0
// The names of what encode() and encodeObject() are given. One that is misspelt is refused:
// ignored, it would make another stream than was asked for.
import {TksError} from './error.js';

const RASTER = ['data', 'width', 'height', 'crs', 'geotransform', 'registration', 'geoKeys',
  'domain', 'project'];
const HEIGHTS = [...RASTER, 'nodata', 'unit', 'spacing', 'scale', 'offset', 'step',
  'verticalDatum', 'description'];
const TEXTURE = [...RASTER, 'channels', 'opaque', 'whiteLevel'];
const INPUT = ['heights', 'texture', 'bytes', 'psnr', 'maxError', 'lossless', 'triangles',
  'regions', 'index', 'weights'];
const OBJECT = ['positions', 'triangles', 'texcoords', 'texture', 'maps', 'material', 'unit',
  'description', 'kind', 'sketch', 'bytes', 'psnr', 'maxError', 'index'];
const TEXELS = ['data', 'width', 'height', 'channels', 'opaque', 'whiteLevel'];
const OPTIONS = ['signal', 'worker', 'wasm', 'progress'];

function check(given, known, what) {
  const unknown = Object.keys(given ?? {}).filter((name) => !known.includes(name));
  if (unknown.length === 0) return;
  throw new TksError('usage', `${what} cannot have ${unknown.join(', ')}: it knows ` +
    `${known.join(', ')}.`);
}

export function checkNames(input, options) {
  check(input, INPUT, 'What is encoded');
  check(input.heights, HEIGHTS, '`heights`');
  check(input.texture, TEXTURE, '`texture`');
  check(options, OPTIONS, 'The second argument of encode()');
}

export function checkObjectNames(mesh, options) {
  check(mesh, OBJECT, 'A mesh');
  check(mesh.texture, TEXELS, 'The texture of a mesh');
  for (const [name, map] of Object.entries(mesh.maps ?? {})) check(map, TEXELS.slice(0, 4), name);
  check(options, OPTIONS, 'The second argument of encodeObject()');
}
