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
  return /\.tks$/i.test(file.name) || /^TK[SG]/.test(await beginning(file, 3));
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
  const terrain = {heights, texture, bytes, index: true};
  return {stream: await encode(terrain, {...encoder, ...options})};
}

/** "1 edge is", "3 edges are"; nothing of none. */
const counted = (count, one, many) =>
  (count === 0 ? null : count === 1 ? `1 ${one}` : `${count} ${many}`);

/** What was cleaned, as the command line says it. */
const cleaningOf = ({droppedTriangles, cutEdges}) => [
  counted(droppedTriangles, 'triangle has equal corners or is there twice and is left out',
    'triangles have equal corners or are there twice and are left out'),
  counted(cutEdges, 'edge joins more triangles than two, or two that face apart, and is cut open',
    'edges join more triangles than two, or two that face apart, and are cut open'),
].filter(Boolean).join('; ');

async function encodeMesh({mesh, remark: read}, options) {
  const bytes = budgetFor(BITS * samplesOf(mesh.texture) +
    TRIANGLE_BITS * (mesh.triangles.length / 3));
  const {stream, report} =
    await encodeObject({...mesh, bytes}, {...objectEncoder, ...options});
  return {stream, remark: [read, cleaningOf(report)].filter(Boolean).join('; ')};
}

/** {file, remark}: a stream of what inputOf() gives, as a file beside the one of that name, and
 * what there is to say. */
export async function encodedFile(input, name, options) {
  const {stream, remark} = await (input.mesh ? encodeMesh : encodeTerrain)(input, options);
  return {file: new File([stream], `${name.replace(/\.[^.]*$/, '')}.tks`), remark};
}
