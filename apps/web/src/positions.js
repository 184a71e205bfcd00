// SPDX-License-Identifier: Apache-2.0
// Longitudes and latitudes of rasters in reference systems that this package does not know: those
// that a stream takes along (docs/FORMAT.md, section 2, Ground positions), or the page's own.
import {pixelsOf} from './drape.js';
import {TangentPlane, inverseOf} from './tangent.js';

/** Integers of a byte string: zigzag varints, and bytes. Numbers up to 2^51 are exact. */
class Reader {
  #bytes;
  #at = 0;

  constructor(bytes) {
    this.#bytes = bytes;
  }
  byte() {
    return this.#bytes[this.#at++];
  }
  zigzag() {
    let value = 0, scale = 1, byte;
    do {
      byte = this.byte();
      value += (byte & 127) * scale;
      scale *= 128;
    } while (byte & 128);
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }
}

/** T_0(x) to T_degree(x), of Chebyshev. */
function chebyshev(x, degree) {
  const values = [1, x];
  for (let i = 2; i <= degree; ++i) values.push(2 * x * values[i - 1] - values[i - 2]);
  return values;
}

/** {plane, point(u, v)} of bytes that the decoder has found to be of their form. */
function polynomialsIn(bytes) {
  const reader = new Reader(bytes), plane = new TangentPlane([reader.zigzag(), reader.zigzag()]);
  const degree = reader.byte(), unit = 2 ** -reader.byte();
  const read = () => Array.from({length: degree + 1}, (_, j) =>
    Array.from({length: degree + 1 - j}, () => unit * reader.zigzag()));
  const coordinates = [read(), read()];
  const point = (u, v) => {
    const along = chebyshev(u, degree), down = chebyshev(v, degree);
    return coordinates.map((rows) => rows.reduce((sum, row, j) =>
      sum + down[j] * row.reduce((part, a, i) => part + a * along[i], 0), 0));
  };
  return {plane, point};
}

/** A projection whose places on the plane are known by column and row of a raster. */
function projectionBy(plane, point, {transform, width, height}) {
  const [x0, a, b, y0, c, d] = transform, pixels = pixelsOf(transform);
  const inverse = inverseOf(point, width, height);
  return {
    forward(longitude, latitude) {
      const [column, row] = inverse(...plane.project(longitude, latitude));
      return [x0 + a * column + b * row, y0 + c * column + d * row];
    },
    inverse: (x, y) => plane.unproject(point(...pixels(x, y))),
    holdsPoles: true,
  };
}

/** From (longitude, latitude) to the CRS of a raster {transform, width, height}, and back. */
export function storedProjection(bytes, raster) {
  const {plane, point} = polynomialsIn(bytes), {width, height} = raster;
  const at = (column, row) => point((2 * column) / width - 1, (2 * row) / height - 1);
  return projectionBy(plane, at, raster);
}

/** The same by the page's `project(x, y)`, which gives [longitude, latitude]. */
export function givenProjection(project, raster) {
  const {transform: [x0, a, b, y0, c, d], width, height} = raster;
  const degrees = (column, row) =>
    project(x0 + a * column + b * row, y0 + c * column + d * row);
  const plane = new TangentPlane(degrees(width / 2, height / 2));
  return projectionBy(plane, (column, row) => plane.project(...degrees(column, row)), raster);
}
