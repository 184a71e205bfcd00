// SPDX-License-Identifier: Apache-2.0
// What a page asks of a module that encodes, on its own thread or in a worker: streams, and the
// positions that they take along, longitudes and latitudes for receivers that do not know the CRS.
// Only the page can call its `project`, and a worker fits what it gives: so the module is asked
// twice, at first for the places that it will ask about.
import {encodeWith} from './encoder.js';
import {TksError} from './error.js';
import {Instance} from './instance.js';
import {encodeObjectWith} from './object_encoder.js';

/** tks_fit_positions, of a raster of this size: bytes, or null where none are good enough. */
function fit(module, {width, height}, degreesAt) {
  const web_degrees = (column, row, address) => {
    const degrees = degreesAt(column, row);
    instance.view(Float64Array, address, 2).set(degrees);
    return Number(!degrees.every(Number.isFinite));
  };
  const instance = new Instance(module, {web_degrees});
  const out = instance.allocate(8);
  if (instance.calls.web_fit_positions(width, height, out) !== 0) return null;
  const [address, size] = instance.view(Uint32Array, out, 2);
  return instance.copy(Uint8Array, address, size);
}

/** Columns and rows of places, in turn: the same for all rasters of a size. */
function placesToFit(module, size) {
  const places = [];
  fit(module, size, (column, row) => {
    places.push(column, row);
    return [column / size.width, row / size.height];
  });
  return Float64Array.from(places);
}

/** Positions of {width, height, degrees}: longitudes and latitudes of these places, in turn. */
function fitPositions(module, {degrees, ...size}) {
  let next = 0;
  const positions = fit(module, size, () => [degrees[next++], degrees[next++]]);
  if (positions) return positions;
  throw new TksError('unsupported', 'Longitudes and latitudes of `project` are unknown ' +
    'somewhere, or do not fit into 200 bytes within a tenth of a sample. Leave it out.');
}

/** By name; each takes (module, input, progress). */
export const CALLS = {
  web_encode: encodeWith, web_encode_object: encodeObjectWith, placesToFit, fitPositions,
};

/** A raster with positions in the place of its `project`. */
async function withPositions({project, ...raster}, ask) {
  const {width, height, crs, geotransform} = raster;
  if (!geotransform) throw new TksError('usage', '`project` needs a geotransform.');
  const [x0, a, b, y0, c, d] = geotransform;
  const places = await ask('placesToFit', {width, height});
  const degrees = new Float64Array(places.length);
  for (let i = 0; i < places.length; i += 2) {
    const [column, row] = places.subarray(i);
    const place = project(x0 + a * column + b * row, y0 + c * column + d * row, crs);
    degrees.set(place ?? [NaN, NaN], i);
  }
  return {...raster, positions: await ask('fitPositions', {width, height, degrees})};
}

/** What encode() is given, as a worker can take it. `ask(call, input)`: the module does that. */
export async function located(input, ask) {
  const {heights, texture} = input;
  return {
    ...input,
    ...(heights?.project ? {heights: await withPositions(heights, ask)} : {}),
    ...(texture?.project ? {texture: await withPositions(texture, ask)} : {}),
  };
}
