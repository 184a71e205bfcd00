// SPDX-License-Identifier: Apache-2.0
// What a stream was made of, drawn as the stream is: for the eye to compare.
import {Mesh, MeshLambertMaterial} from 'three';

import {geometryOf, textureOf} from '../src/three_frame.js';
import {tint} from './tint.js';

/** Columns and rows that are drawn at most. */
const MOST = 1025;

/** Every so many-th of `count` places, and the last one. */
function places(count) {
  const step = Math.ceil((count - 1) / (MOST - 1)) || 1, chosen = [];
  for (let i = 0; i < count - 1; i += step) chosen.push(i);
  return [...chosen, count - 1];
}

/** Heights in the unit of the stream; voids are NaN. */
function heightsOf({data, scale = 1, offset = 0}, {hasNodata, nodata}) {
  return Float32Array.from(data,
    (value) => (hasNodata && value === nodata ? NaN : value * scale + offset));
}

/** Two triangles a square, of those whose corners are heights. */
function meshOf(heights, width, height) {
  const columns = places(width), rows = places(height), gridIndex = [], triangles = [];
  for (const row of rows) for (const column of columns) gridIndex.push(row * width + column);
  const values = Float32Array.from(gridIndex, (index) => heights[index]);
  const add = (...corners) => {
    if (corners.every((i) => !Number.isNaN(values[i]))) triangles.push(...corners);
  };
  for (let j = 0; j + 1 < rows.length; ++j) {
    for (let i = 0; i + 1 < columns.length; ++i) {
      const a = j * columns.length + i, b = a + columns.length;
      add(a, b, a + 1);
      add(a + 1, b, b + 1);
    }
  }
  return {
    gridIndex: Uint32Array.from(gridIndex), triangles: Uint32Array.from(triangles),
    heights: values.map((value) => (Number.isNaN(value) ? 0 : value)),
  };
}

/** RGBA of 8 bits. */
function pictureOf({data, width, height, channels = data.length / (width * height), opaque},
  {textureWhiteLevel: white}) {
  const rgba = new Uint8ClampedArray(4 * width * height), colours = channels > 2 ? 3 : 1;
  const hasAlpha = channels % 2 === 0 && !opaque;
  const most = data instanceof Uint16Array ? 65535 : 255;
  for (let i = 0; i < width * height; ++i) {
    for (let c = 0; c < 3; ++c) {
      rgba[4 * i + c] = (255 * data[channels * i + Math.min(c, colours - 1)]) / white;
    }
    rgba[4 * i + 3] = hasAlpha ? (255 * data[channels * i + channels - 1]) / most : 255;
  }
  return {width, height, data: rgba};
}

/** An object beside that of the stream; `input`: as encode() takes it. */
export function originalOf({heights, texture}, info) {
  const values = heights && heightsOf(heights, info);
  const mesh = heights && meshOf(values, heights.width, heights.height);
  const picture = texture ? pictureOf(texture, info) : tint({...heights, data: values});
  const material = new MeshLambertMaterial({map: textureOf(picture)});
  if (info.hasTexture && !info.textureOpaque) material.alphaTest = 0.5;
  return new Mesh(geometryOf({info, mesh}), material);
}
