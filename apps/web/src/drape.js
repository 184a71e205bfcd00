// SPDX-License-Identifier: Apache-2.0
// Where a texture lies on the heights.
import {isForest} from './domains.js';

/** From places on the ground to columns and rows of a raster with this geotransform. */
export function pixelsOf([x0, a, b, y0, c, d]) {
  const determinant = a * d - b * c;
  return (x, y) => [
    (d * (x - x0) - b * (y - y0)) / determinant, (a * (y - y0) - c * (x - x0)) / determinant,
  ];
}

/**
 * The geotransform of a texture that has none of its own: it reaches from the middle of the first
 * sample of the heights to that of the last, as on all meshes.
 */
export function drapedTransform({geotransform, width, height, textureWidth, textureHeight}) {
  const [x0, a, b, y0, c, d] = geotransform;
  const across = Math.max(width - 1, 1) / textureWidth;
  const down = Math.max(height - 1, 1) / textureHeight;
  return [x0 + (a + b) / 2, a * across, b * down, y0 + (c + d) / 2, c * across, d * down];
}

/** A code in capitals, without a vertical part; any other text as it is. */
function plainCrs(crs) {
  return /^(\w+:\w+)(\+\w+)?$/.exec(crs)?.[1].toUpperCase() ?? crs;
}

/** On a forest, whose patches are squares of the heights' and of the texture's width each. */
function drapeOfForest({width, textureWidth, textureHeight}) {
  const scale = (textureWidth - 1) / (width - 1);
  return (column, row) => {
    const patch = Math.floor((row + 0.5) / width), down = row - patch * width;
    const texel = patch * textureWidth + scale * down;
    return [(scale * column + 0.5) / textureWidth, (texel + 0.5) / textureHeight];
  };
}

/** From (column, row) of a sample to its place on the texture, from 0 to 1 each. */
export function drapeOf(info) {
  const {width, height} = info;
  if (isForest(info.textureDomain)) return drapeOfForest(info);
  const isPlaced = info.hasGeotransform && info.textureHasGeotransform;
  if (!isPlaced || plainCrs(info.crs) !== plainCrs(info.textureCrs)) {
    return (column, row) => [column / (width - 1), row / (height - 1)];
  }
  const [x0, a, b, y0, c, d] = info.geotransform, pixels = pixelsOf(info.textureGeotransform);
  return (column, row) => {
    const across = column + 0.5, down = row + 0.5;  // of its middle
    const [u, v] = pixels(x0 + a * across + b * down, y0 + c * across + d * down);
    return [u / info.textureWidth, v / info.textureHeight];
  };
}
