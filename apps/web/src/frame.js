// SPDX-License-Identifier: Apache-2.0
// What a frame is made of: a mesh with normals, a surface, a texture, each at the level that suits.
import {globeOn} from './body.js';
import {isForest} from './domains.js';
import {groundScale} from './ground.js';
import {joinedNormals} from './joined_normals.js';
import {gridNormals, meshNormals} from './normals.js';
import {atlasOf, objectOf} from './object.js';
import {PARTS} from './parts.js';

/** Mip level at which neither side has more than `most` samples. */
function levelFor(width, height, most, coarsest) {
  let level = 0;
  while (level < coarsest && Math.max(width, height) / 2 ** level > most) ++level;
  return level;
}

/** Levels of forests are not shown: meshes count on the raster of level 0. */
const coarsestOf = (info) => (isForest(info.domain) ? 0 : info.coarsestLevel);

/** Enough for shading, in the time of a first picture. */
const NORMAL_SAMPLES = 1024;

/** The levels of texture and surface: those asked for, or else no finer ones than bytes feed. */
function levelsOf(opened, info, {textureLevel, surfaceLevel, texels, samples}) {
  const {textureWidth, textureHeight} = info;
  const fed = (part, level, coarsest) =>
    Math.min(Math.max(level, opened.fedLevel(PARTS[part])), coarsest);
  const ofTexture = isForest(info.textureDomain) ? 0 : info.textureCoarsestLevel;
  const ofHeights = coarsestOf(info);
  return {
    textureLevel: textureLevel ?? (info.hasTexture
      ? fed('texture', levelFor(textureWidth, textureHeight, texels, ofTexture), ofTexture) : 0),
    surfaceLevel: surfaceLevel ?? (info.hasHeights
      ? fed('heights', levelFor(info.width, info.height, samples, ofHeights), ofHeights) : 0),
  };
}

/** Of a mesh for each byte of heights: some 20000 are good after 18 kB. */
const TRIANGLES_OF_BYTE = 4;

/** Those that the base of an object has, which its header holds. */
const leastOf = ({isObject, width, height}) => (isObject ? (2 * height) / width : 2);

/** As many as were asked for, and no more than the bytes of a prefix feed. */
function trianglesFor({triangles}, opened, info) {
  if (info.objectTriangles) return triangles;  // the header holds all of them
  const isComplete = opened.size >= info.streamBytes;
  return isComplete ? triangles
    : Math.min(triangles, Math.max(leastOf(info), TRIANGLES_OF_BYTE * info.geometryBytes));
}

/** Makes the parts of a frame that `request` asks for, one at each step; returns them all. `centre`
 * of a request: that of the object in the frames before, if there is one. */
export function* partsOf(opened, info, request) {
  const parts = {}, {textureLevel, surfaceLevel} = levelsOf(opened, info, request);
  const atlas = atlasOf(info, request.texels);
  if (request.mesh && request.globe && (info.hasHeights || info.isObject)) {
    parts.globe = opened.globe(trianglesFor(request, opened, info), globeOn(request.globe, info));
    yield;
    if (request.normals) parts.globe.normals = joinedNormals(parts.globe);
    yield;
  } else if (request.mesh && info.isObject) {
    const mesh = opened.object(trianglesFor(request, opened, info));
    yield;
    parts.object = objectOf(mesh, info, {...request, atlas});
    yield;
  } else if (request.mesh && info.hasHeights) {
    parts.mesh = opened.mesh(trianglesFor(request, opened, info), request.cut);
    yield;
  }
  const shown = (level) => {
    opened.setLevels(Math.min(level, info.coarsestLevel), info.hasTexture ? textureLevel : 0);
    return opened.info();
  };
  const surfaceAt = (level) => {
    const at = shown(level);
    return {level, width: at.width, height: at.height, spacingX: at.spacingX,
      spacingY: at.spacingY, geotransform: at.geotransform, data: opened.surface(at)};
  };
  if (request.surface && info.hasHeights) {
    parts.surface = surfaceAt(surfaceLevel);
    yield;
    if (request.normals && !request.mesh) {
      parts.surface.normals = gridNormals(parts.surface, groundScale(info));
      yield;
    }
  }
  if (request.normals && parts.mesh) {
    const level = levelFor(info.width, info.height, NORMAL_SAMPLES, coarsestOf(info));
    const surface = parts.surface?.level === level ? parts.surface : surfaceAt(level);
    parts.mesh.normals = meshNormals(parts.mesh, info.width, surface, groundScale(info));
    yield;
  }
  if (request.texture && info.hasTexture) {
    const at = shown(0), data = opened.rgba(at);
    parts.texture = atlas?.pictureOf(data) ?? {level: textureLevel, width: at.textureWidth,
      height: at.textureHeight, geotransform: at.textureGeotransform, data};
    if (info.objectTriangles) parts.texture.repeats = true;
  }
  return parts;
}

/** The buffers of a frame, to be handed over between threads instead of copied. */
export function buffersOf(frame) {
  const {mesh, globe, object, texture, surface} = frame;
  const parts = [mesh, globe, object, texture, surface];
  const values = parts.flatMap((part) => Object.values(part ?? {}));
  return values.filter(ArrayBuffer.isView).map((array) => array.buffer);
}
