// SPDX-License-Identifier: Apache-2.0
// Codes what users have, heights, an image over them, or both, or a mesh, into a stream on this
// page.
import {encode, encodeObject} from '../src/encode.js';
import {encoder, objectEncoder} from './decoder.js';

/** What files are coded into: so many bits for each height, texel and triangle. */
const BITS = 1, TRIANGLE_BITS = 8, LEAST_BYTES = 32768;
const MESH = /\.(glb|gltf|obj|ply|stl)$/i;

/** Text of a file from its beginning. */
const beginning = async (file, length) => new TextDecoder().decode(
  await file.slice(0, length).arrayBuffer().catch(() => new ArrayBuffer(0)));

/** Whether there is nothing to code. */
export async function isStream(file) {
  return /\.tks$/i.test(file.name) || (await beginning(file, 3)) === 'TKS';
}

const isMesh = async (file) =>
  MESH.test(file.name) || /^(glTF|ply[\r\n])/.test(await beginning(file, 4));

/** What a mesh and other files give, as readMesh() does. */
async function meshOf(meshes, others) {
  if (meshes.length > 1 || others.length > 1) {
    throw new Error('Drop one mesh, and at most one image that lies on it.');
  }
  const {readMesh} = await import('./read_mesh.js');
  return readMesh(meshes[0], others[0]);
}

/** {heights, texture} of files, as encode() takes them, or {mesh, remark}. What reads them is
 * loaded now. */
export async function inputOf(files) {
  const meshes = [], others = [];
  for (const file of files) (await isMesh(file) ? meshes : others).push(file);
  if (meshes.length > 0) return meshOf(meshes, others);
  const {readFiles} = await import('./read_files.js');
  return readFiles(files);
}

const samplesOf = (raster) => (raster ? raster.width * raster.height : 0);

/** For the bits of all that is coded. */
const budgetFor = (bits) => Math.max(LEAST_BYTES, Math.round(bits / 8));

async function encodeTerrain({heights, texture}, options) {
  const bytes = budgetFor(BITS * (samplesOf(heights) + samplesOf(texture)));
  return encode({heights, texture, bytes, index: true}, {...encoder, ...options});
}

async function encodeMesh(mesh, options) {
  const bytes = budgetFor(BITS * samplesOf(mesh.texture) +
    TRIANGLE_BITS * (mesh.triangles.length / 3));
  const {stream} = await encodeObject({...mesh, bytes}, {...objectEncoder, ...options});
  return stream;
}

/** A stream of what inputOf() gives, as a file beside the one of that name. */
export async function encodedFile(input, name, options) {
  const stream = await (input.mesh ? encodeMesh(input.mesh, options)
    : encodeTerrain(input, options));
  return new File([stream], `${name.replace(/\.[^.]*$/, '')}.tks`);
}
