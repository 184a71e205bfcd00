// SPDX-License-Identifier: Apache-2.0
// Heights as a GeoTIFF of 32-bit floats: one strip, with the place and the codes of its CRS.
import {metresPerUnit} from '../src/ground.js';

const SHORT = 3, LONG = 4, ASCII = 2, DOUBLE = 12;
const SIZES = {[ASCII]: 1, [SHORT]: 2, [LONG]: 4, [DOUBLE]: 8};
const HEADER = 8;

/** Keys and their codes, in the order of their numbers. */
function geoKeysOf(info, isPoint) {
  const [, code, vertical] = /^EPSG:(\d+)(?:\+(?:EPSG:)?(\d+))?$/i.exec(info.crs) ?? [];
  const isGeographic = metresPerUnit(info)[1] > 1e4;  // metres of a degree
  const datum = vertical ?? /^EPSG:(\d+)$/i.exec(info.verticalDatum)?.[1];
  const keys = [[1025, isPoint ? 2 : 1]];
  if (code) keys.unshift([1024, isGeographic ? 2 : 1]);
  if (code) keys.push([isGeographic ? 2048 : 3072, Number(code)]);
  if (datum) keys.push([4096, Number(datum)]);
  return [1, 1, 0, keys.length, ...keys.flatMap(([key, value]) => [key, 0, 1, value])];
}

/** Tags of where the samples lie: those of pixels that are points begin at their middle. */
function placeTags(info, isPoint) {
  if (!info.hasGeotransform) return [];
  const [x0, a, b, y0, c, d] = info.geotransform;
  const [x, y] = isPoint ? [x0 + (a + b) / 2, y0 + (c + d) / 2] : [x0, y0];
  const keys = geoKeysOf(info, isPoint);
  const place = b === 0 && c === 0 && a > 0 && d < 0
    ? [[33550, DOUBLE, [a, -d, 0]], [33922, DOUBLE, [0, 0, 0, x, y, 0]]]
    : [[34264, DOUBLE, [a, b, 0, x, c, d, 0, y, 0, 0, 0, 0, 0, 0, 0, 1]]];
  return [...place, [34735, SHORT, keys]];
}

/** The bytes of a TIFF: `tags` in rising order, the samples behind them. */
function writeTiff(tags, samples) {
  const directory = 2 + 12 * tags.length + 4;
  const long = ([, type, values]) => SIZES[type] * values.length > 4;
  const even = (size) => size + (size % 2);
  const sizes = tags.map((tag) => (long(tag) ? even(SIZES[tag[1]] * tag[2].length) : 0));
  const begin = HEADER + directory + sizes.reduce((sum, size) => sum + size, 0);
  const strip = begin + (-begin & 3);
  const view = new DataView(new ArrayBuffer(strip + samples.byteLength));
  view.setUint32(0, 0x49492a00);
  view.setUint32(4, HEADER, true);
  view.setUint16(HEADER, tags.length, true);
  const put = {
    [ASCII]: (at, v) => view.setUint8(at, v), [SHORT]: (at, v) => view.setUint16(at, v, true),
    [LONG]: (at, v) => view.setUint32(at, v, true),
    [DOUBLE]: (at, v) => view.setFloat64(at, v, true),
  };
  let behind = HEADER + directory;
  tags.forEach((tag, i) => {
    const [number, type, values] = tag, entry = HEADER + 2 + 12 * i;
    view.setUint16(entry, number, true);
    view.setUint16(entry + 2, type, true);
    view.setUint32(entry + 4, values.length, true);
    if (long(tag)) view.setUint32(entry + 8, behind, true);
    const at = long(tag) ? behind : entry + 8;
    values.forEach((value, k) => put[type](at + k * SIZES[type], number === 273 ? strip : value));
    behind += sizes[i];
  });
  samples.forEach((value, i) => view.setFloat32(strip + 4 * i, value, true));
  return new Uint8Array(view.buffer);
}

/** `surface`: of a frame, level 0; voids are NaN. */
export function geoTiffOf(surface, info) {
  const {width, height, data} = surface, isPoint = info.registration === 2;
  return writeTiff([
    [256, LONG, [width]], [257, LONG, [height]], [258, SHORT, [32]], [259, SHORT, [1]],
    [262, SHORT, [1]], [273, LONG, [0]], [277, SHORT, [1]], [278, LONG, [height]],
    [279, LONG, [data.byteLength]], [339, SHORT, [3]], ...placeTags(info, isPoint),
    [42113, ASCII, [...'nan\0'].map((letter) => letter.charCodeAt(0))],
  ], data);
}
