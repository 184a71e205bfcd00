// SPDX-License-Identifier: Apache-2.0
// The files of bench/web_arrival: GLBs without normals, which unlit ground does not need, and sets
// of tiles.
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, readdirSync} from 'node:fs';
import {createRequire} from 'node:module';

const require = createRequire(new URL('../../apps/web/package.json', import.meta.url));
const draco3d = require('draco3d');
const SCRIPT = new URL('web_arrival_images.py', import.meta.url).pathname;
const [POSITION_BITS, PLACE_BITS] = [14, 12];
const [JSON_CHUNK, BINARY_CHUNK, MAGIC] = [0x4e4f534a, 0x004e4942, 0x46546c67];
const SIDE = 256;
/** Terrain begins with the deepest level of at most so many tiles. */
const MOST_FIRST = 4;

export function image(input, quality, halvings, out) {
  execFileSync('/usr/bin/python3', [SCRIPT, input, String(quality), out, String(halvings)]);
  return readFileSync(out);
}

function parsed(glb) {
  const length = glb.readUInt32LE(12);
  return {json: JSON.parse(glb.subarray(20, 20 + length)), binary: glb.subarray(28 + length)};
}
function written(json, parts) {
  const padded = (bytes, filler) =>
    Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, filler)]);
  const binary = padded(Buffer.concat(parts), 0);
  const text = padded(Buffer.from(JSON.stringify(json)), 32);
  const words = (...values) => Buffer.from(Uint32Array.from(values).buffer);
  return Buffer.concat([
    words(MAGIC, 2, 28 + text.length + binary.length), words(text.length, JSON_CHUNK), text,
    words(binary.length, BINARY_CHUNK), binary,
  ]);
}

/** A GLB of the command line without normals, with another picture. */
export function glbOf(glb, picture) {
  const {json, binary} = parsed(glb), [{primitives: [primitive]}] = json.meshes;
  const dropped = new Set([json.accessors[primitive.attributes.NORMAL].bufferView]);
  delete primitive.attributes.NORMAL;
  const imageView = json.images[0].bufferView, parts = [];
  let length = 0;
  json.bufferViews.forEach((view, i) => {
    if (dropped.has(i)) {
      view.byteLength = 1;
      view.byteOffset = 0;
      view.buffer = 0;
      delete view.extensions;
      delete view.byteStride;
      return;
    }
    const packed = view.extensions?.EXT_meshopt_compression ?? view;
    const bytes = i === imageView
      ? picture : binary.subarray(packed.byteOffset, packed.byteOffset + packed.byteLength);
    const gap = Buffer.alloc(-length & 3);
    [packed.byteOffset, packed.byteLength] = [length + gap.length, bytes.length];
    parts.push(gap, bytes);
    length += gap.length + bytes.length;
  });
  json.buffers[0].byteLength = length;
  return written(json, parts);
}

/** Positions and places on the texture of an uncompressed GLB, as Draco codes them. */
async function dracoMesh(glb) {
  const {json, binary} = parsed(glb), [{primitives: [primitive]}] = json.meshes;
  const values = (index, Type) => {
    const {bufferView, count, type} = json.accessors[index], view = json.bufferViews[bufferView];
    const length = count * {SCALAR: 1, VEC2: 2, VEC3: 3}[type];
    return new Type(Uint8Array.from(
      binary.subarray(view.byteOffset, view.byteOffset + length * Type.BYTES_PER_ELEMENT)).buffer);
  };
  const {attributes, indices} = primitive, wide = json.accessors[indices].componentType === 5125;
  const positions = values(attributes.POSITION, Float32Array);
  const places = values(attributes.TEXCOORD_0, Float32Array);
  const triangles = Uint32Array.from(values(indices, wide ? Uint32Array : Uint16Array));
  const module = await draco3d.createEncoderModule({});
  const encoder = new module.Encoder();
  const builder = new module.MeshBuilder(), mesh = new module.Mesh();
  builder.AddFacesToMesh(mesh, triangles.length / 3, triangles);
  builder.AddFloatAttributeToMesh(mesh, module.POSITION, positions.length / 3, 3, positions);
  builder.AddFloatAttributeToMesh(mesh, module.TEX_COORD, places.length / 2, 2, places);
  encoder.SetSpeedOptions(0, 0);
  encoder.SetAttributeQuantization(module.POSITION, POSITION_BITS);
  encoder.SetAttributeQuantization(module.TEX_COORD, PLACE_BITS);
  const out = new module.DracoInt8Array(), length = encoder.EncodeMeshToDracoBuffer(mesh, out);
  const bytes = Buffer.from(Int8Array.from({length}, (_, i) => out.GetValue(i)));
  for (const object of [out, mesh, builder, encoder]) module.destroy(object);
  return {bytes, json};
}

/** A function from a picture to the GLB with Draco's mesh under it. */
export async function dracoGlb(plain) {
  const {bytes, json} = await dracoMesh(plain), [{primitives: [primitive]}] = json.meshes;
  const {POSITION, TEXCOORD_0} = primitive.attributes;
  const bare = ({componentType, count, type, max, min}) => ({componentType, count, type, max, min});
  return {geometryBytes: bytes.length, withPicture: (picture) => {
    const gap = Buffer.alloc(-bytes.length & 3);
    return written({
      ...json,
      accessors: [POSITION, TEXCOORD_0, primitive.indices].map((i) => bare(json.accessors[i])),
      bufferViews: [
        {buffer: 0, byteOffset: 0, byteLength: bytes.length},
        {buffer: 0, byteOffset: bytes.length + gap.length, byteLength: picture.length},
      ],
      buffers: [{byteLength: bytes.length + gap.length + picture.length}],
      images: [{bufferView: 1, mimeType: 'image/jpeg'}],
      extensionsUsed: [...(json.extensionsUsed ?? []), 'KHR_draco_mesh_compression'],
      extensionsRequired: ['KHR_draco_mesh_compression'],
      meshes: [{primitives: [{
        ...primitive, attributes: {POSITION: 0, TEXCOORD_0: 1}, indices: 2,
        extensions: {KHR_draco_mesh_compression: {
          bufferView: 0, attributes: {POSITION: 0, TEXCOORD_0: 1},
        }},
      }]}],
    }, [bytes, gap, picture]);
  }};
}

/** Tiles of terrain in `folder`/terrain: [{z, x, y, path}] of each level, from coarse to fine. */
function terrainLevels(folder, add) {
  const levels = readdirSync(`${folder}/terrain`).map(Number).filter(Number.isInteger)
    .sort((a, b) => a - b);
  const tiles = levels.map((z) => readdirSync(`${folder}/terrain/${z}`).flatMap((x) =>
    readdirSync(`${folder}/terrain/${z}/${x}`).map((name) => {
      const file = `${z}/${x}/${name}`;
      const path = add(file, readFileSync(`${folder}/terrain/${file}`));
      return {z, x: Number(x), y: Number.parseInt(name, 10), path};
    })));
  const first = tiles.findLastIndex((level) => level.length <= MOST_FIRST);
  return tiles.slice(first);
}

/** Likewise of pictures, with the texels that they cover. */
function pictureLevels(folder, input, quality, [columns, rows], add) {
  mkdirSync(`${folder}/pictures`, {recursive: true});
  execFileSync('/usr/bin/python3', [SCRIPT, input, String(quality), `${folder}/pictures`]);
  const levels = [];
  for (let level = 0, side = SIDE; ; ++level, side *= 2) {
    const tiles = [];
    for (let y = 0; y * side < rows; ++y) {
      for (let x = 0; x * side < columns; ++x) {
        const name = `${level}_${x}_${y}.jpg`;
        const path = add(name, readFileSync(`${folder}/pictures/${name}`));
        tiles.push({path, x: x * side, y: y * side,
          width: Math.min(side, columns - x * side), height: Math.min(side, rows - y * side)});
      }
    }
    levels.unshift(tiles);
    if (Math.max(columns, rows) <= side) return levels;
  }
}

/** What the page of tiles reads first. `add(name, bytes)` serves a file and gives its path. */
export function tilesOf(folder, input, quality, info, add) {
  const {heights, texture} = info, size = [texture.width, texture.height];
  return {
    transform: heights.geotransform, crs: heights.crs, width: heights.width, height: heights.height,
    spacing: [heights.spacing_x, heights.spacing_y], texture: size,
    terrain: terrainLevels(folder, add),
    pictures: pictureLevels(folder, input, quality, size, add),
  };
}
