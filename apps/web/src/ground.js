// SPDX-License-Identifier: Apache-2.0
// Metres on the ground: as a stream states them, or as its place tells. Encoders that know no CRS
// state a place alone.
import {EARTH, bodyOf, eccentricityOf, keysOf} from './body.js';

/** Of lengths by their names, those of base/coordinates.cpp: lower case, words apart by blanks. */
const METRES = new Map([
  [1, 'm metre meter metres meters'],
  [0.01, 'cm centimetre'],
  [0.001, 'mm millimetre'],
  [1000, 'km kilometre'],
  [0.3048, 'ft foot feet international_foot international_feet'],
  [1200 / 3937, 'us-ft ftus foot_us us_survey_foot us_survey_feet'],
].flatMap(([metres, names]) =>
  names.split(' ').map((name) => [name.replaceAll('_', ' '), metres])));
const RADIANS = Math.PI / 180;

/** WKT says what a CRS is first, or behind the name of the compound that it is a part of. */
const WKT = /^(?:COMP\w+\["[^"]*",\s*)?(GEO|PROJ|LOCAL|ENG)/i;
/** Of other codes no rule tells: 4547 is in metres, 6318 in degrees. */
const DEGREES = /^EPSG:(4326|4269|4258|4979)(\D|$)/i;

/** By its code and the codes it had before, or by its projection in WKT. */
const WEB_MERCATOR =
  /^(EPSG|ESRI):(3857|3785|900913|102100|102113)(\D|$)|Pseudo[- ]Mercator|Auxiliary_Sphere/i;
export const isWebMercator = (crs) => WEB_MERCATOR.test(crs);
/** Metres on the ground of one of web Mercator's, so far north on its plane: cos(latitude). */
export const mercatorMetre = (north) => 1 / Math.cosh(north / EARTH.semiMajor);

/** Of a unit of coordinates; 0: it is no length, or unknown. */
const lengthOf = (metres) => (metres > 0 && Math.abs(metres / RADIANS - 1) > 1e-9 ? metres : 0);

/** EPSG codes of the units that the keys of a GeoTIFF state most. */
const LINEAR = {9001: 1, 9002: 0.3048, 9003: 1200 / 3937};

/**
 * The unit of coordinates, 'degree' or metres, as the keys of a GeoTIFF state it (docs/FORMAT.md,
 * section 2); 0: they do not, or not for coordinates of this kind.
 */
function unitOfKeys(text) {
  const {1024: model, 2054: angular = '9102', 3076: linear = '32767', 3077: size} = keysOf(text);
  if (model === '2') return angular === '9102' ? 'degree' : 0;
  if (model === '3') return 0;
  return linear === '32767' ? lengthOf(Number(size)) : LINEAR[linear] ?? 0;
}

/** The same of the WKT of a CRS: its own unit is the last one ahead of a vertical part. */
function unitOfWkt(crs) {
  const kind = WKT.exec(crs)?.[1].toUpperCase();
  if (!kind) return 0;
  if (kind === 'GEO') return 'degree';
  const [horizontal] = crs.split(/,\s*VERT\w*\[/i);
  const units = Array.from(horizontal.matchAll(/UNIT\["[^"]*",\s*([\d.e+-]+)/gi));
  return lengthOf(Number(units.at(-1)?.[1])) || 1;
}

/**
 * Whether coordinates are degrees: by the code of the CRS, or else if all lie where longitudes and
 * latitudes do. Metres so near to the origin of a projection are next to none.
 */
function isInDegrees({geotransform: [x0, a, b, y0, c, d], crs, width, height}) {
  if (DEGREES.test(crs)) return true;
  return [[0, 0], [width, 0], [0, height], [width, height]].every(([column, row]) =>
    Math.abs(x0 + a * column + b * row) <= 360 && Math.abs(y0 + c * column + d * row) <= 90);
}

/** Of a degree to the east and to the north: radii of curvature times a degree; 0: no latitude. */
export function metresPerDegree(latitude, body = EARTH) {
  if (!(Math.abs(latitude) < 90)) return [0, 0];
  const eccentricity = eccentricityOf(body), degree = body.semiMajor * RADIANS;
  const bend = 1 - eccentricity * Math.sin(latitude * RADIANS) ** 2;
  return [
    (degree * Math.cos(latitude * RADIANS)) / Math.sqrt(bend),
    (degree * (1 - eccentricity)) / bend ** 1.5,
  ];
}

/** The unit of coordinates: 'degree', or metres. What neither CRS, keys nor WKT tell is a metre. */
export function unitOfPlace(info) {
  const {crs, geoKeys = ''} = info, isNamed = crs || geoKeys;
  return unitOfKeys(geoKeys) || unitOfWkt(crs) || (isNamed && isInDegrees(info) ? 'degree' : 1);
}

/**
 * Metres of a unit of the coordinates to the east and to the north, of degrees and of web Mercator
 * in the middle.
 */
export function metresPerUnit(info) {
  const {geotransform: [, , , north, c, d], crs, width, height} = info;
  const middle = north + (width * c + height * d) / 2, unit = unitOfPlace(info);
  if (unit === 'degree') return metresPerDegree(middle, bodyOf(info));
  const metre = isWebMercator(crs) ? unit * mercatorMetre(unit * middle) : unit;
  return [metre, metre];
}

/** Metres between columns and between rows; nothing without a place, a CRS, or a distance. */
function placedSpacing(info) {
  const {hasGeotransform, geotransform, crs, geoKeys} = info;
  if (!hasGeotransform || !(crs || geoKeys)) return null;
  const [, a, b, , c, d] = geotransform, [east, up] = metresPerUnit(info);
  const spacing = [Math.hypot(a * east, c * up), Math.hypot(b * east, d * up)];
  return spacing.every((metres) => metres > 0 && Number.isFinite(metres)) ? spacing : null;
}

const metresOf = (unit) => METRES.get(unit.toLowerCase().replaceAll('_', ' '));

/** Metres between samples where nothing tells them, as for the command line and its cameras. */
const UNKNOWN_SPACING = [30, 30];

/** Metres of one unit of height, of one column and of one row. */
export function groundScale(info) {
  const stated = info.spacingX > 0 && [info.spacingX, info.spacingY || info.spacingX];
  const [x, y] = stated || placedSpacing(info) || UNKNOWN_SPACING;
  return {height: metresOf(info.unit) ?? 1, x, y};
}
