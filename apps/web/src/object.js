// SPDX-License-Identifier: Apache-2.0
// Objects: what frames have of the meshes that the decoder makes of them.
import {creased} from './creased_mesh.js';
import {isForest} from './domains.js';
import {joinedNormals} from './joined_normals.js';
import {PatchAtlas} from './patch_atlas.js';

/** What the texture of an object is laid out by, with at most so many texels a side; null: there is
 * no texture on its patches. */
export function atlasOf(info, texels) {
  const {width, height, textureWidth, textureHeight} = info, patches = height / width;
  const isTextured = info.isObject && info.hasTexture && isForest(info.textureDomain) &&
    textureHeight / textureWidth === patches;
  return isTextured ? PatchAtlas.within(texels, patches, textureWidth) : null;
}

/** The least and the most of each coordinate. */
function boxOf(positions) {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, i) => {
    if (value < least[i % 3]) least[i % 3] = value;
    if (value > most[i % 3]) most[i % 3] = value;
  });
  return [least, most];
}

/**
 * A point to count positions from, so that 32 bits suffice for them: the middle, in steps of two to
 * four diagonals. That is 0 of all that has the origin in its box, and hardly ever depends on the
 * bytes that are here.
 */
export function centreOf(positions) {
  const [least, most] = boxOf(positions);
  const diagonal = Math.hypot(...most.map((value, axis) => value - least[axis]));
  const step = 2 ** (Math.ceil(Math.log2(diagonal)) + 1);
  return most.map((value, axis) => {
    const middle = value / 2 + least[axis] / 2;
    const centre = step > 0 ? Math.round(middle / step) * step : middle;
    return Number.isFinite(centre) ? centre + 0 : 0;
  });
}

function relativeTo(centre, positions) {
  const relative = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; ++i) relative[i] = positions[i] - centre[i % 3];
  return relative;
}

/** Places on an atlas of vertices that lie on these samples of a raster `width` wide. */
function texcoordsOf(atlas, pixels, width) {
  const texcoords = new Float32Array(pixels.length);
  for (let i = 0; i < pixels.length; i += 2) {
    const column = pixels[i] - 0.5, row = pixels[i + 1] - 0.5, patch = Math.floor(row / width);
    texcoords.set(atlas.at(patch, column / (width - 1), (row - patch * width) / (width - 1)), i);
  }
  return texcoords;
}

/** The mesh with its normals. */
const withNormals = (mesh, {objectTriangles}) =>
  (objectTriangles ? creased(mesh) : {...mesh, normals: joinedNormals(mesh)});

/** `decoded`: of the decoder; atlas: of its texture, or null; centre: that of the frames before, or
 * null; normals: whether there are to be some. */
export function objectOf(decoded, info, {atlas, centre, normals}) {
  const mesh = normals ? withNormals(decoded, info) : decoded;
  const {positions, texcoords, triangles} = mesh, middle = centre ?? centreOf(positions);
  const object = {centre: middle, positions: relativeTo(middle, positions), triangles};
  if (atlas) object.texcoords = texcoordsOf(atlas, mesh.pixels, info.width);
  else if (texcoords) object.texcoords = Float32Array.from(texcoords);
  if (normals) object.normals = mesh.normals;
  return object;
}
