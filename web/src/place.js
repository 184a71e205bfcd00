// SPDX-License-Identifier: Apache-2.0
// Where on Earth a raster lies: from longitude and latitude to its columns and rows, for the CRSs that
// web maps meet: degrees, web Mercator, UTM.
import {TksError} from './error.js';

const RADIANS = Math.PI / 180;
const MERCATOR_RADIUS = 6378137;

const degrees = (longitude, latitude) => [longitude, latitude];
const mercator = (longitude, latitude) => [
  MERCATOR_RADIUS * longitude * RADIANS,
  MERCATOR_RADIUS * Math.asinh(Math.tan(latitude * RADIANS)),
];

/** Krüger's series to the third order of the flattening: less than a millimetre within a zone. */
function utm(zone, south) {
  const f = 1 / 298.257223563, n = f / (2 - f), e = (2 * Math.sqrt(n)) / (1 + n);
  const radius = (MERCATOR_RADIUS / (1 + n)) * (1 + n ** 2 / 4 + n ** 4 / 64);
  const alpha = [
    n / 2 - (2 / 3) * n ** 2 + (5 / 16) * n ** 3, (13 / 48) * n ** 2 - (3 / 5) * n ** 3,
    (61 / 240) * n ** 3,
  ];
  const meridian = 6 * zone - 183;
  return (longitude, latitude) => {
    const sine = Math.sin(latitude * RADIANS), away = (longitude - meridian) * RADIANS;
    const t = Math.sinh(Math.atanh(sine) - e * Math.atanh(e * sine));
    const xi = Math.atan2(t, Math.cos(away));
    const eta = Math.atanh(Math.sin(away) / Math.hypot(1, t));
    let x = eta, y = xi;
    alpha.forEach((a, i) => {
      const k = 2 * (i + 1);
      x += a * Math.cos(k * xi) * Math.sinh(k * eta);
      y += a * Math.sin(k * xi) * Math.cosh(k * eta);
    });
    return [500000 + 0.9996 * radius * x, (south ? 1e7 : 0) + 0.9996 * radius * y];
  };
}

/** (longitude, latitude) to the coordinates of a CRS such as "EPSG:32611" or "EPSG:4326+5773". */
export function projectionOf(crs) {
  const code = Number(/^EPSG:(\d+)/i.exec(crs)?.[1] ?? 0);
  if (code === 4326 || code === 4269 || code === 4258 || code === 4979) return degrees;
  if (code === 3857) return mercator;
  if (code > 32600 && code <= 32660) return utm(code - 32600, false);
  if (code > 32700 && code <= 32760) return utm(code - 32700, true);
  if (code >= 26901 && code <= 26923) return utm(code - 26900, false);
  if (code >= 25828 && code <= 25838) return utm(code - 25800, false);
  throw new TksError('unsupported', `This package does not know the CRS "${crs}". It knows ` +
    'degrees, web Mercator and UTM; else give `bounds`: [west, south, east, north] in degrees.');
}

/** Columns and rows, where (0, 0) is the outer corner of the first sample. */
export function pixelsOf(geotransform, projection) {
  const [x0, a, b, y0, c, d] = geotransform, determinant = a * d - b * c;
  return (longitude, latitude) => {
    const [x, y] = projection(longitude, latitude);
    return [
      (d * (x - x0) - b * (y - y0)) / determinant, (a * (y - y0) - c * (x - x0)) / determinant,
    ];
  };
}

/** A geotransform for `width` x `height` samples between degrees. */
export function transformOfBounds([west, south, east, north], width, height) {
  return [west, (east - west) / width, 0, north, 0, (south - north) / height];
}

/** West, south, east and north of a raster, by walking along its border with Newton's steps. */
export function boundsOf(pixels, width, height) {
  const [west, south, east, north] = [180, 90, -180, -90];
  const bounds = [west, south, east, north];
  let start = null;
  const STEPS = 16;
  for (let i = 0; i <= 4 * STEPS; ++i) {
    const side = Math.floor(i / STEPS) % 4, share = (i % STEPS) / STEPS;
    const target = [
      [share * width, 0], [width, share * height], [(1 - share) * width, height],
      [0, (1 - share) * height],
    ][side];
    start = locate(pixels, target, start ?? firstGuess(pixels, target));
    bounds[0] = Math.min(bounds[0], start[0]);
    bounds[1] = Math.min(bounds[1], start[1]);
    bounds[2] = Math.max(bounds[2], start[0]);
    bounds[3] = Math.max(bounds[3], start[1]);
  }
  return bounds;
}

/** The place on a coarse grid of the Earth that comes nearest to a pixel. */
function firstGuess(pixels, [column, row]) {
  let best = [0, 0], least = Infinity;
  for (let latitude = -84; latitude <= 84; latitude += 2) {
    for (let longitude = -178; longitude <= 178; longitude += 2) {
      const [x, y] = pixels(longitude, latitude);
      const distance = Math.hypot(x - column, y - row);
      if (distance < least) [least, best] = [distance, [longitude, latitude]];
    }
  }
  return best;
}

function locate(pixels, [column, row], [longitude, latitude]) {
  const STEP = 1e-5;
  for (let i = 0; i < 12; ++i) {
    const [x, y] = pixels(longitude, latitude);
    const [xe, ye] = pixels(longitude + STEP, latitude), [xn, yn] = pixels(longitude, latitude + STEP);
    const a = (xe - x) / STEP, b = (xn - x) / STEP, c = (ye - y) / STEP, d = (yn - y) / STEP;
    const determinant = a * d - b * c, dx = column - x, dy = row - y;
    longitude += (d * dx - b * dy) / determinant;
    latitude += (a * dy - c * dx) / determinant;
    latitude = Math.min(85, Math.max(-85, latitude));
  }
  return [longitude, latitude];
}
