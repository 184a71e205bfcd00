// SPDX-License-Identifier: Apache-2.0
// Meshes as the viewer's users have them, as encodeObject() takes them. Loaded when the first such
// file is opened.
import {readGltf} from './gltf_parts.js';
import {joined} from './joined_mesh.js';
import {READERS} from './mesh_parts.js';
import {textureOf} from './mesh_texture.js';

const GLTF = ['glb', 'gltf'], WHITE = [1, 1, 1];

/** What a file says: {parts, fileOf(image), isGltf}. */
async function partsIn(file, format) {
  const buffer = await file.arrayBuffer();
  if (GLTF.includes(format)) return {...await readGltf(buffer), isGltf: true};
  return {parts: READERS[format](buffer)};
}

/** The format by the extension, or by the first bytes. */
async function formatOf(file) {
  const [extension] = /[^.]*$/.exec(file.name.toLowerCase());
  if (GLTF.includes(extension) || extension in READERS) return extension;
  return (await file.slice(0, 4).text()) === 'glTF' ? 'glb' : 'ply';
}

/** {texture, remark} of the picture that a file names. */
async function ownTexture({image, colour}, fileOf) {
  const remark = (reason) => ({remark: `its texture is not read (${reason})`});
  try {
    const file = await fileOf(image);
    return file ? {texture: await textureOf(file, colour)} : remark('it is another file');
  } catch (error) {
    return remark(error.message.replace(/\.$/, ''));
  }
}

const textureFrom = (picture) => textureOf(picture, WHITE).catch(() => {
  throw new Error(`${picture.name}, which was given with it, is no image`);
});

/** `picture`: a file that lies on the mesh, or nothing. */
async function textureFor({material, hasTexcoords}, fileOf, picture) {
  if (picture && !hasTexcoords) {
    throw new Error(`it has no texture coordinates, so that ${picture.name} cannot lie on it`);
  }
  if (picture) return {texture: await textureFrom(picture)};
  if (material.image !== undefined && hasTexcoords) return ownTexture(material, fileOf);
  const isBare = hasTexcoords && !fileOf;
  return isBare ? {remark: 'a picture for it can be dropped together with it'} : {};
}

async function read(file, picture) {
  const {parts, fileOf, isGltf = false} = await partsIn(file, await formatOf(file));
  const all = joined(parts, isGltf), {mesh: {texcoords, ...surface}, remarks} = all;
  const {texture, remark} = await textureFor(all, fileOf, picture);
  const description = (parts.length === 1 && parts[0].name) || file.name.replace(/\.[^.]*$/, '');
  const mesh = {...surface, description, ...(isGltf && {unit: 'm'}),
    ...(texture && {texture, texcoords})};
  return {mesh, remark: [...remarks, remark].filter(Boolean).join(', ')};
}

/** Loaders of three.js throw errors of their own, and stumble over what is damaged. */
function reasonOf({constructor, message}) {
  const text = message.replace(/^THREE\.\w+: /, '').replace(/\.$/, '');
  return constructor === Error ? text : `it is damaged (${text})`;
}

/** {mesh, remark} of a file and perhaps a picture for it: what encodeObject() takes, and what was
 * joined or left out, without the file's name. */
export async function readMesh(file, picture) {
  try {
    return await read(file, picture);
  } catch (error) {
    throw new Error(`${file.name} cannot be read as a mesh: ${reasonOf(error)}.`, {cause: error});
  }
}
