// SPDX-License-Identifier: Apache-2.0
// A globe on a cube, as three.js draws it: the patches of its raster lie one below the other, and
// each gets a texture of its own, since mip levels would mix the end of one with the next one.
import {textureOf} from '../src/three.js';

export const PATCHES = 6;

/** Sorts the triangles by patches, so that each is drawn with its own material. */
export function groupByPatches(geometry, {width}, pixels) {
  const corners = geometry.getIndex().array, byPatch = Array.from({length: PATCHES}, () => []);
  for (let t = 0; t < corners.length; t += 3) {
    const row = pixels[2 * corners[t] + 1];
    byPatch[Math.floor(row / width)].push(...corners.subarray(t, t + 3));
  }
  let begin = 0;
  byPatch.forEach((triangles, patch) => {
    corners.set(triangles, begin);
    geometry.addGroup(begin, triangles.length, patch);
    begin += triangles.length;
  });
}

/** Of a texture of the whole raster those of its patches, which lie where they lay on it. */
export function texturesOfPatches({image: {width, data}}) {
  return Array.from({length: PATCHES}, (_, patch) => {
    const size = 4 * width * width, texels = data.subarray(patch * size, (patch + 1) * size);
    const texture = textureOf({width, height: width, data: texels});
    texture.repeat.set(1, PATCHES);
    texture.offset.set(0, -patch);
    return texture;
  });
}
