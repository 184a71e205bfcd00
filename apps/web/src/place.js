// SPDX-License-Identifier: Apache-2.0
// Where on Earth a raster lies: from longitude and latitude to its columns and rows, and back, for
// the CRSs that web maps meet (degrees, web Mercator, UTM), for streams that take their longitudes
// and latitudes along, and for pages that project themselves.
import {straightAxes} from './axes.js';
import {isForest} from './domains.js';
import {drapedTransform, pixelsOf} from './drape.js';
import {TksError} from './error.js';
import {isWebMercator} from './ground.js';
import {givenProjection, storedProjection} from './positions.js';

const RADIANS = Math.PI / 180;
const MERCATOR_RADIUS = 6378137;
/** Once around the Earth, in degrees. */
const TURN = 360;
/** Of a column, by which those that go round miss the first one. */
const TOLERANCE = 0.01;
/** A millimetre or so, by which places that end at 180° miss it. */
const NEAR = 1e-8;

const degrees = {
  forward: (longitude, latitude) => [longitude, latitude],
  inverse: (x, y) => [x, y],
};
const mercator = {
  forward: (longitude, latitude) => [
    MERCATOR_RADIUS * longitude * RADIANS,
    MERCATOR_RADIUS * Math.asinh(Math.tan(latitude * RADIANS)),
  ],
  inverse: (x, y) => [
    x / MERCATOR_RADIUS / RADIANS, Math.atan(Math.sinh(y / MERCATOR_RADIUS)) / RADIANS,
  ],
};

/** Krüger's series to the third order of the flattening: less than a millimetre within a zone. */
function utm(zone, south) {
  const f = 1 / 298.257223563, n = f / (2 - f), e = (2 * Math.sqrt(n)) / (1 + n);
  const radius = (MERCATOR_RADIUS / (1 + n)) * (1 + n ** 2 / 4 + n ** 4 / 64);
  const alpha = [
    n / 2 - (2 / 3) * n ** 2 + (5 / 16) * n ** 3, (13 / 48) * n ** 2 - (3 / 5) * n ** 3,
    (61 / 240) * n ** 3,
  ];
  const beta = [
    n / 2 - (2 / 3) * n ** 2 + (37 / 96) * n ** 3, n ** 2 / 48 + n ** 3 / 15, (17 / 480) * n ** 3,
  ];
  const delta = [
    2 * n - (2 / 3) * n ** 2 - 2 * n ** 3, (7 / 3) * n ** 2 - (8 / 5) * n ** 3, (56 / 15) * n ** 3,
  ];
  const meridian = 6 * zone - 183, scale = 0.9996 * radius, north = south ? 1e7 : 0;
  /** What a series adds to (xi, eta). */
  const sums = (series, xi, eta) => series.reduce(([y, x], factor, i) => {
    const k = 2 * (i + 1);
    return [
      y + factor * Math.sin(k * xi) * Math.cosh(k * eta),
      x + factor * Math.cos(k * xi) * Math.sinh(k * eta),
    ];
  }, [0, 0]);
  return {
    forward(longitude, latitude) {
      const sine = Math.sin(latitude * RADIANS), away = (longitude - meridian) * RADIANS;
      const t = Math.sinh(Math.atanh(sine) - e * Math.atanh(e * sine));
      const xi = Math.atan2(t, Math.cos(away));
      const eta = Math.atanh(Math.sin(away) / Math.hypot(1, t));
      const [y, x] = sums(alpha, xi, eta);
      return [500000 + scale * (eta + x), north + scale * (xi + y)];
    },
    inverse(x, y) {
      const eta = (x - 500000) / scale, xi = (y - north) / scale;
      const [less, lessAcross] = sums(beta, xi, eta);
      const up = xi - less, across = eta - lessAcross;
      const conformal = Math.asin(Math.sin(up) / Math.cosh(across));
      const [latitude] = sums(delta, conformal, 0);
      return [
        meridian + Math.atan2(Math.sinh(across), Math.cos(up)) / RADIANS,
        (conformal + latitude) / RADIANS,
      ];
    },
  };
}

/** From (longitude, latitude) to a CRS such as "EPSG:32611" or "EPSG:4326+5773", and back; null of
 * other CRSs. */
export function projectionOf(crs) {
  if (isWebMercator(crs)) return mercator;
  const code = Number(/^EPSG:(\d+)/i.exec(crs)?.[1] ?? 0);
  if (code === 4326 || code === 4269 || code === 4258 || code === 4979) return degrees;
  if (code > 32600 && code <= 32660) return utm(code - 32600, false);
  if (code > 32700 && code <= 32760) return utm(code - 32700, true);
  if (code >= 26901 && code <= 26923) return utm(code - 26900, false);
  if (code >= 25828 && code <= 25838) return utm(code - 25800, false);
  return null;
}

/**
 * From (longitude, latitude) to columns and rows, where (0, 0) is the outer corner of the first
 * sample, and back.
 */
export function gridOf(transform, {forward, inverse, holdsPoles = false}) {
  const [x0, a, b, y0, c, d] = transform, pixels = pixelsOf(transform);
  return {
    holdsPoles,
    pixels: (longitude, latitude) => pixels(...forward(longitude, latitude)),
    degrees: (column, row) => inverse(x0 + a * column + b * row, y0 + c * column + d * row),
  };
}

const isAscending = ([west, south, east, north]) =>
  west < east && east - west <= TURN && Math.abs(west) <= TURN &&
  -90 <= south && south < north && north <= 90;

/** `bounds` as callers give them: west lies east of `east` where they go across 180°. */
function checkedBounds(bounds) {
  let [west, south, east, north] = Array.from(bounds);
  if (west > east && east + TURN - west < TURN / 2) east += TURN;
  const checked = [west, south, east, north];
  if (bounds.length === 4 && checked.every(Number.isFinite) && isAscending(checked)) return checked;
  throw new TksError('usage', '`bounds` are [west, south, east, north] in degrees, of a place ' +
    'with an area; across 180° as [170, -10, -170, 10].');
}

/** A geotransform for `width` x `height` samples between degrees, in the order of `axes`. */
function transformOfBounds([west, south, east, north], width, height, {along, down}) {
  const [x, across] = along[0] > 0 ? [west, east - west] : [east, west - east];
  const [y, up] = down[1] > 0 ? [north, south - north] : [south, north - south];
  return [x, across / width, 0, y, 0, up / height];
}

/** West, south, east and north of a raster, by walking along its border. */
export function boundsOf(degrees, width, height) {
  const bounds = [Infinity, Infinity, -Infinity, -Infinity], STEPS = 16;
  for (let i = 0; i < 4 * STEPS; ++i) {
    const side = Math.floor(i / STEPS), share = (i % STEPS) / STEPS;
    const [longitude, latitude] = degrees(...[
      [share * width, 0], [width, share * height], [(1 - share) * width, height],
      [0, (1 - share) * height],
    ][side]);
    bounds[0] = Math.min(bounds[0], longitude);
    bounds[1] = Math.min(bounds[1], latitude);
    bounds[2] = Math.max(bounds[2], longitude);
    bounds[3] = Math.max(bounds[3], latitude);
  }
  return bounds;
}

/** Those of a raster that a pole may lie in: around it are all longitudes. */
function boundsWithPoles({pixels, degrees}, width, height) {
  const [west, south, east, north] = boundsOf(degrees, width, height);
  const holds = (latitude) => {
    const [column, row] = pixels(0, latitude);
    return column >= 0 && row >= 0 && column <= width && row <= height;
  };
  if (holds(90)) return [-TURN / 2, south, TURN / 2, 90];
  if (holds(-90)) return [-TURN / 2, -90, TURN / 2, north];
  return [west, south, east, north];
}

/** The parts of a place, [west, east] within -180 to 180 each: two where it goes across 180°. */
export function spansOf([west, , east]) {
  if (east - west >= TURN - NEAR) return [[-180, 180]];
  return east <= 180 + NEAR ? [[Math.max(west, -180), Math.min(east, 180)]]
    : [[west, 180], [-180, east - TURN]];
}

/** West, south, east and north of what holds all spans, as maps know it. */
export function boxOf(bounds) {
  const [, south, , north] = bounds, spans = spansOf(bounds);
  const [[west, east]] = spans.length > 1 ? [[-180, 180]] : spans;
  return [west, south, east, north];
}

/** The turns, in degrees, by which some of the longitudes, which grow, come between the bounds. */
export function turnsTo([west, , east], longitudes) {
  const turns = [];
  let turn = TURN * Math.ceil((west - longitudes.at(-1)) / TURN);
  for (; longitudes[0] + turn <= east; turn += TURN) turns.push(turn);
  return turns;
}

/**
 * A grid whose longitudes begin between -180 and 180, with its bounds, and whether its last column
 * lies beside its first one. Across 180° longitudes go on, to 190 and further: only so a place is
 * one piece.
 */
function turnedGrid({pixels, degrees, holdsPoles}, width, height) {
  const [west, south, east, north] = holdsPoles
    ? boundsWithPoles({pixels, degrees}, width, height) : boundsOf(degrees, width, height);
  if (![west, south, east, north].every(Number.isFinite)) {
    throw new TksError('unsupported', 'The stream states a place that its CRS does not reach. ' +
      'Give `bounds`: [west, south, east, north] in degrees.');
  }
  const turn = TURN * Math.floor((west + TURN / 2 + NEAR) / TURN);
  return {
    pixels: (longitude, latitude) => pixels(longitude + turn, latitude),
    degrees(column, row) {
      const [longitude, latitude] = degrees(column, row);
      return [longitude - turn, latitude];
    },
    bounds: [west - turn, Math.max(south, -90), east - turn, Math.min(north, 90)],
    goesRound: !holdsPoles && Math.abs((east - west) / TURN - 1) * width < TOLERANCE,
  };
}

/** Whether a stream says where it lies. */
export const isPlaced = (info) => info.hasGeotransform || info.textureHasGeotransform;

/** The place of a part as the stream states it: {transform, crs, bytes}, and whose raster it is. */
function statedPlace(info, part) {
  const heights = {
    transform: info.geotransform, crs: info.crs, bytes: info.positions,
    width: info.width, height: info.height,
  };
  const texture = {
    transform: info.textureGeotransform, crs: info.textureCrs, bytes: info.texturePositions,
    width: info.textureWidth, height: info.textureHeight,
  };
  if (part === 'texture' && info.textureHasGeotransform) {
    const shares = !texture.bytes && info.hasGeotransform && texture.crs === heights.crs;
    return {...texture, raster: shares ? heights : texture};
  }
  if (!info.hasGeotransform) {
    throw new TksError('unsupported', 'The stream does not say where it lies. Give `bounds`: ' +
      '[west, south, east, north] in degrees.');
  }
  return part === 'heights' ? {...heights, raster: heights}
    : {...texture, crs: heights.crs, transform: drapedTransform(info), raster: heights};
}

/** Between longitude and latitude and the CRS of a place. */
function projectionFor({crs, raster}, project) {
  if (project) return givenProjection((x, y) => project(x, y, crs), raster);
  const known = projectionOf(crs);
  if (known) return known;
  if (raster.bytes) return storedProjection(raster.bytes, raster);
  throw new TksError('unsupported', `This package does not know the CRS "${crs}", and the stream ` +
    'has no positions of its own (tetrakis encode adds them). Give `project`: (x, y) => ' +
    '[longitude, latitude], or `bounds`: [west, south, east, north] in degrees.');
}

/** Refuses what lies on no ground. */
export function checkGround({isObject}) {
  if (isObject) {
    throw new TksError('unsupported', 'This stream is an object, which lies on no ground.');
  }
}

/**
 * Where a part of a stream, 'heights' or 'texture', lies: {width, height, pixels, degrees, bounds,
 * goesRound}.
 * A texture without a place of its own is draped over the heights. Longitudes of its bounds, and of
 * what it gives and takes, go on behind 180 where it goes across that. `bounds`: west, south, east,
 * north of both parts in degrees, in place of what the stream says; it still says which row is the
 * northern one. `project(x, y, crs)`: longitude and latitude of coordinates of the stream's CRS.
 */
export function placeOf(info, part, {bounds, project} = {}) {
  if (isForest(info.domain)) {
    throw new TksError('unsupported', 'The heights lie on patches, as those of a cube do. Places ' +
      'are found on a grid: tetrakis decode makes one of a cube.');
  }
  const isTexture = part === 'texture';
  const width = isTexture ? info.textureWidth : info.width;
  const height = isTexture ? info.textureHeight : info.height;
  if (!bounds) {
    const place = statedPlace(info, part), projection = projectionFor(place, project);
    return {...turnedGrid(gridOf(place.transform, projection), width, height), width, height};
  }
  const own = {hasGeotransform: true, geotransform: info.textureGeotransform,
    crs: info.textureCrs, width, height};
  const axes = straightAxes(isTexture && info.textureHasGeotransform ? own : info);
  const transform = transformOfBounds(checkedBounds(bounds), width, height, axes);
  return {...turnedGrid(gridOf(transform, degrees), width, height), width, height};
}
