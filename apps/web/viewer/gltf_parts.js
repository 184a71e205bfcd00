// SPDX-License-Identifier: Apache-2.0
// glTF, as one file (.glb, or .gltf with all data in it), with meshopt's compression or without.
// Geometry and nodes are read by three.js; materials are looked up in the document, of which only
// the base colours count, so that no other picture is decoded.
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';

import {partsOf} from './mesh_parts.js';

const DRACO = 'KHR_draco_mesh_compression', TRANSFORM = 'KHR_texture_transform';
/** What older files have in place of a base colour. */
const GLOSSY = 'KHR_materials_pbrSpecularGlossiness';
/** Extensions whose pictures browsers decode. */
const PICTURES = ['EXT_texture_webp', 'EXT_texture_avif'];

const isData = (uri) => uri.startsWith('data:');

function check({extensionsUsed = [], buffers = []}) {
  if (extensionsUsed.includes(DRACO)) {
    throw new Error('it is compressed by Draco, which this page does not read; the command line ' +
      'does: tetrakis encode');
  }
  const apart = buffers.find(({uri}) => uri !== undefined && !isData(uri));
  if (apart) throw new Error(`its data lie in another file, ${apart.uri}: make it a .glb`);
}

/** The number of a texture's image; undefined: it has none. */
function imageOf({source, extensions = {}} = {}) {
  const named = PICTURES.map((name) => extensions[name]?.source).find((image) => image >= 0);
  return named ?? source ?? extensions.KHR_texture_basisu?.source;
}

/** The base colour: a factor of light, and where its picture lies. */
function baseColourOf({pbrMetallicRoughness: own = {}, extensions}, {textures = []}) {
  const older = extensions?.[GLOSSY];
  const colour = (older ? older.diffuseFactor : own.baseColorFactor) ?? [1, 1, 1];
  const texture = older ? older.diffuseTexture : own.baseColorTexture;
  if (!texture) return {colour};
  const {index, texCoord = 0} = texture;
  const {offset = [0, 0], scale = [1, 1], rotation = 0, texCoord: channel = texCoord} =
    texture.extensions?.[TRANSFORM] ?? {};
  return {
    colour, image: imageOf(textures[index]), texcoords: channel > 0 ? `uv${channel}` : 'uv',
    offset, scale, isTurned: rotation !== 0,
  };
}

/** The file of an image; null: it is another file. */
async function fileOf(parser, image) {
  const {bufferView, uri = '', mimeType: type} = parser.json.images[image];
  if (bufferView === undefined) return isData(uri) ? (await fetch(uri)).blob() : null;
  return new Blob([await parser.getDependency('bufferView', bufferView)], {type});
}

/** Has the loader make materials that tell no more than their numbers. Gives the base colours. */
function takeMaterials(json) {
  const colours = (json.materials ?? []).map((material) => baseColourOf(material, json));
  if (json.materials) json.materials = colours.map((_, index) => ({extras: {index}}));
  return colours;
}

/** {parts, fileOf(image)}: parts as partsOf() has them, with their `material` and the `name` that
 * their mesh has. */
export async function readGltf(buffer) {
  let colours = null;
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  loader.register(({json}) => {
    check(json);
    colours = takeMaterials(json);
    return {name: 'base colours'};
  });
  const {scene, parser} = await loader.parseAsync(buffer, '');
  const parts = (scene ? partsOf(scene) : []).map((part) => {
    const {material, isMesh} = part.node, mesh = parser.associations.get(part.node)?.meshes;
    return {...part, name: parser.json.meshes[mesh]?.name,
      material: isMesh ? colours[material.userData.index] : undefined};
  });
  return {parts, fileOf: (image) => fileOf(parser, image)};
}
