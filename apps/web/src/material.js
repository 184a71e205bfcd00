// SPDX-License-Identifier: Apache-2.0
// What an object is made of beside its texture: maps that further components of its stream hold,
// and factors of these, as glTF has them.

import {isForest} from './domains.js';

/** What components are called that hold maps. */
export const MAPS = ['normal', 'metallic_roughness', 'occlusion', 'emissive'];

/** Whether a texture lies on an object as its texture does: on triangles, or on the same patches.
 * Normals there would count from texture coordinates that nobody knows. */
function liesOn(info, {name, width, height}) {
  const {objectTriangles, isObject, textureDomain, textureWidth, textureHeight} = info;
  if (objectTriangles) return true;
  return isObject && isForest(textureDomain) && name !== 'normal' && width === textureWidth &&
    height === textureHeight;
}

/** Names to components of the maps that lie on an object. */
export function mapsOf(info) {
  const maps = info.components.filter((component) => {
    const {name, kind, taken} = component;
    return kind === 'texture' && !taken && MAPS.includes(name) && liesOn(info, component);
  });
  return new Map(maps.map((component) => [component.name, component]));
}

/** Whether light makes the look of an object: of others the texture holds it. */
export const hasMaterial = (info) => info.material !== '' || mapsOf(info).size > 0;

const isRecord = (value) => typeof value === 'object' && value !== null;

function parsed(text) {
  try {
    const material = JSON.parse(text || '{}');
    return isRecord(material) ? material : {};
  } catch {
    return {};
  }
}

const within = (value, least, most, usual) =>
  (Number.isFinite(value) && value >= least && value <= most ? value : usual);

/** Of the text of a stream, which may be any; what it does not say is as usual. */
export function factorsOf(text) {
  const material = parsed(text);
  const {metallicFactor, roughnessFactor, baseColorFactor} = material.pbrMetallicRoughness ?? {};
  const colour = Array.isArray(baseColorFactor) ? baseColorFactor : [];
  const emissive = Array.isArray(material.emissiveFactor) ? material.emissiveFactor : [];
  return {
    metalness: within(metallicFactor, 0, 1, 1),
    roughness: within(roughnessFactor, 0, 1, 1),
    colour: [0, 1, 2].map((i) => within(colour[i], 0, 1, 1)),
    opacity: material.alphaMode === 'BLEND' ? within(colour[3], 0, 1, 1) : 1,
    emissive: [0, 1, 2].map((i) => within(emissive[i], 0, 1, 0)),
    normalScale: within(material.normalTexture?.scale, -1e6, 1e6, 1),
    occlusionStrength: within(material.occlusionTexture?.strength, 0, 1, 1),
    /** Occlusion is red of the map of metalness and roughness, if it has none of its own. */
    hasOcclusion: 'occlusionTexture' in material,
  };
}
