// SPDX-License-Identifier: Apache-2.0
// Heights and images as the viewer's users have them, as encode() takes them: GeoTIFFs by
// geotiff.js, other images by the browser. Loaded when the first such file is opened.
import {fromArrayBuffer} from 'geotiff';
import {isWebMercator, mercatorMetre, metresPerDegree} from '../src/ground.js';
import {tagOf, textureOf} from './geotiff_texture.js';
import {checkSize, chosenBands, pixelsOf} from './picture_file.js';

/** EPSG codes of units of length, in metres. */
const UNITS = {9001: ['m', 1], 9002: ['ft', 0.3048], 9003: ['us-ft', 1200 / 3937]};
const UNIT_NAMES = {metre: 'm', meter: 'm', metres: 'm', foot: 'ft', feet: 'ft'};
const USER_DEFINED = 32767;

const isTiff = (bytes) => {
  const [a, b, c] = bytes;
  return (a === 0x49 && b === 0x49 && (c === 42 || c === 43)) || (a === 0x4d && b === 0x4d);
};

/** As GDAL's: of the outer corner of the first sample. */
function geotransformOf(directory, isPoint) {
  const matrix = tagOf(directory, 'ModelTransformation');
  const tie = tagOf(directory, 'ModelTiepoint'), scale = tagOf(directory, 'ModelPixelScale');
  let t;
  if (matrix) t = [matrix[3], matrix[0], matrix[1], matrix[7], matrix[4], matrix[5]];
  else if (scale && tie?.length === 6) {
    t = [tie[3] - tie[0] * scale[0], scale[0], 0, tie[4] + tie[1] * scale[1], 0, -scale[1]];
  } else return null;
  if (isPoint) [t[0], t[3]] = [t[0] - (t[1] + t[2]) / 2, t[3] - (t[4] + t[5]) / 2];
  return t;
}

/** Metres between columns and between rows; nothing where units are unknown. */
function spacingOf(t, keys, height) {
  if (!t) return 0;
  let east = UNITS[keys.ProjLinearUnitsGeoKey ?? 9001]?.[1], north = east;
  const middle = t[3] + (height / 2) * t[5];
  if (keys.GTModelTypeGeoKey === 2) {
    [east, north] = metresPerDegree(middle);
  } else if (isWebMercator(crsOf(keys.ProjectedCSTypeGeoKey))) {
    east = north = east * mercatorMetre(east * middle);
  } else if (keys.GTModelTypeGeoKey !== 1 && !keys.ProjLinearUnitsGeoKey) {
    return 0;  // of a local grid GDAL states no model, but a unit
  }
  const x = Math.hypot(t[1] * east, t[4] * north), y = Math.hypot(t[2] * east, t[5] * north);
  return x > 0 && y > 0 && isFinite(x) && isFinite(y) ? [x, y] : 0;
}

const crsOf = (code) => (code && code !== USER_DEFINED ? `EPSG:${code}` : undefined);

const RASTER_TYPE = 1025, DOUBLES = 34736, TEXTS = 34737;
/** With a point or an exponent, which tells them from codes. */
const numberText = (value) => (/[.e]/.test(value) ? `${value}` : `${value}.0`);

/** The keys as a stream holds them (docs/FORMAT.md, section 2, Places). */
function keysText(tags) {
  const directory = tagOf(tags, 'GeoKeyDirectory') ?? [], keys = [];
  const doubles = tagOf(tags, 'GeoDoubleParams') ?? [], texts = tagOf(tags, 'GeoAsciiParams') ?? '';
  for (let i = 4; i + 3 < directory.length; i += 4) {
    const [key, where, count, value] = directory.slice(i, i + 4), end = value + count;
    if (key === RASTER_TYPE) continue;
    if (where === 0) keys.push([key, value]);
    if (where === DOUBLES)
      keys.push([key, Array.from(doubles.slice(value, end), numberText).join()]);
    if (where === TEXTS) {
      const text = texts.slice(value, end).replace(/[|\0]+$/, '');
      keys.push([key, `"${text.replaceAll('"', '""')}"`]);
    }
  }
  return keys.sort(([a], [b]) => a - b).map((pair) => pair.join('=')).join(' ');
}

function placeOf(image) {
  const keys = image.getGeoKeys() ?? {};
  const isPoint = keys.GTRasterTypeGeoKey === 2;
  const crs = crsOf(keys.ProjectedCSTypeGeoKey) ?? crsOf(keys.GeographicTypeGeoKey);
  return {
    keys, crs,
    geotransform: geotransformOf(image.fileDirectory, isPoint),
    geoKeys: crs ? undefined : keysText(image.fileDirectory) || undefined,
    registration: isPoint ? 'point' : keys.GTRasterTypeGeoKey === 1 ? 'area' : 'unknown',
  };
}

async function readTiff(name, buffer) {
  const image = await (await fromArrayBuffer(buffer)).getImage();
  const width = image.getWidth(), height = image.getHeight();
  checkSize(name, width, height);
  const channels = image.getSamplesPerPixel();
  const {keys, ...place} = placeOf(image);
  const data = await image.readRasters({interleave: true});
  const isImage = channels > 1;
  if (isImage && !(data instanceof Uint8Array || data instanceof Uint16Array)) {
    throw new Error(`${name} has ${channels} bands of ${data.constructor.name}: neither heights ` +
      '(one band) nor an image (8 or 16 bits).');
  }
  if (isImage) return {texture: await textureOf(image, data, place)};
  // Samples may be scaled, as GDAL says it.
  const {SCALE = 1, OFFSET = 0, UNITTYPE} = {...(await image.getGDALMetadata(0))};
  const [unit = UNIT_NAMES[UNITTYPE] ?? UNITTYPE] = UNITS[keys.VerticalUnitsGeoKey] ?? [];
  return {heights: {
    ...place, width, height, unit, scale: Number(SCALE), offset: Number(OFFSET),
    nodata: image.getGDALNoData() ?? 'auto',
    data: data instanceof Float64Array ? Float32Array.from(data) : data,
    spacing: spacingOf(place.geotransform, keys, height),
    verticalDatum: crsOf(keys.VerticalCSTypeGeoKey),
  }};
}

/** RGB where nothing is transparent. */
async function readImage(name, file) {
  const {width, height, data} = await pixelsOf(name, file);
  let opaque = true;
  for (let i = 3; i < data.length && opaque; i += 4) opaque = data[i] === 255;
  return {texture: opaque
    ? {width, height, channels: 3, data: chosenBands(data, 4, [0, 1, 2])}
    : {width, height, channels: 4, data: new Uint8Array(data.buffer)}};
}

async function readOne(file) {
  const first = new Uint8Array(await file.slice(0, 4).arrayBuffer());
  try {
    return isTiff(first) ? await readTiff(file.name, await file.arrayBuffer())
      : await readImage(file.name, file);
  } catch (error) {
    if (error.message.startsWith(file.name)) throw error;
    throw new Error(`${file.name} cannot be read as a GeoTIFF or an image (${error.message}).`,
      {cause: error});
  }
}

/** {heights, texture} of one or two files. */
export async function readFiles(files) {
  const parts = [];
  for (const file of files) parts.push(await readOne(file));
  const heights = parts.filter((part) => part.heights);
  const textures = parts.filter((part) => part.texture);
  if (heights.length > 1 || textures.length > 1) {
    const two = heights.length > 1 ? 'hold heights' : 'are images';
    throw new Error(
      `Two of these files ${two}. Drop one GeoTIFF of heights and one image over it.`);
  }
  return {...heights[0], ...textures[0]};
}
