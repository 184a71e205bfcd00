// SPDX-License-Identifier: Apache-2.0
// Meshes for tests: a lumpy ball, and files of glTF made by hand.
import {crc32, deflateSync} from 'node:zlib';

const FLOAT = 5126, UINT = 5125;

/** A closed surface of `rows` x 2 `rows` quads round the origin; texcoords as a map of a globe. */
export function ballOf(rows, lumps = 0.1) {
  const columns = 2 * rows, positions = [], texcoords = [], triangles = [];
  for (let row = 0; row <= rows; ++row) {
    for (let column = 0; column <= columns; ++column) {
      const down = (Math.PI * row) / rows, round = (2 * Math.PI * (column % columns)) / columns;
      const ring = row % rows === 0 ? 0 : Math.sin(down);
      const radius = 1 + lumps * ring * Math.sin(3 * round) * Math.sin(4 * down);
      positions.push(radius * ring * Math.cos(round), radius * Math.cos(down),
        -radius * ring * Math.sin(round));
      texcoords.push(column / columns, row / rows);
    }
  }
  const at = (row, column) => row * (columns + 1) + column;
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const [a, b] = [at(row, column), at(row + 1, column)];
      if (row > 0) triangles.push(a, b, a + 1);
      if (row < rows - 1) triangles.push(a + 1, b, b + 1);
    }
  }
  return {positions, texcoords, triangles};
}

/** Six times the signed volume, above 0 where triangles are counter-clockwise seen from outside. */
export function volumeOf({positions, triangles}) {
  const at = (i) => [0, 1, 2].map((axis) => positions[3 * triangles[i] + axis]);
  let volume = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = [at(i), at(i + 1), at(i + 2)];
    volume += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return volume;
}

/** A .glb of a document and of the bytes of its buffer. */
export function glbFile(document, bytes) {
  const text = new TextEncoder().encode(JSON.stringify(document));
  const padded = (length) => (length + 3) & ~3;
  const size = 28 + padded(text.length) + padded(bytes.length);
  const file = new Uint8Array(size), view = new DataView(file.buffer);
  const heads = [0x46546c67, 2, size, padded(text.length), 0x4e4f534a];
  heads.forEach((head, i) => view.setUint32(4 * i, head, true));
  file.fill(0x20, 20, 20 + padded(text.length)).set(text, 20);
  const body = 20 + padded(text.length);
  view.setUint32(body, padded(bytes.length), true);
  view.setUint32(body + 4, 0x004e4942, true);
  file.set(bytes, body + 8);
  return file;
}

/** Bytes one behind the other, each beginning at a multiple of 4; views of them. */
function packed(arrays) {
  const views = [];
  let byteOffset = 0;
  for (const {byteLength} of arrays) {
    views.push({buffer: 0, byteOffset, byteLength});
    byteOffset += (byteLength + 3) & ~3;
  }
  const bytes = new Uint8Array(byteOffset);
  arrays.forEach(({buffer}, i) => bytes.set(new Uint8Array(buffer), views[i].byteOffset));
  return {bytes, views};
}

/** {document, bytes} of a mesh with a picture (PNG) or without one, in one node. */
export function gltfOf({positions, texcoords, triangles}, picture = null) {
  const arrays = [Float32Array.from(positions), Float32Array.from(texcoords),
    Uint32Array.from(triangles), ...(picture ? [Uint8Array.from(picture)] : [])];
  const {bytes, views} = packed(arrays), count = positions.length / 3;
  const axis = (a) => positions.filter((_, i) => i % 3 === a);
  const [min, max] = [Math.min, Math.max].map((most) => [0, 1, 2].map((a) => most(...axis(a))));
  const document = {
    asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0}],
    meshes: [{name: 'ball', primitives: [{attributes: {POSITION: 0, TEXCOORD_0: 1}, indices: 2,
      material: 0}]}],
    materials: [{pbrMetallicRoughness: picture ? {baseColorTexture: {index: 0}} : {}}],
    ...(picture && {textures: [{source: 0}], images: [{bufferView: 3, mimeType: 'image/png'}]}),
    accessors: [
      {bufferView: 0, componentType: FLOAT, count, type: 'VEC3', min, max},
      {bufferView: 1, componentType: FLOAT, count, type: 'VEC2'},
      {bufferView: 2, componentType: UINT, count: triangles.length, type: 'SCALAR'}],
    bufferViews: views, buffers: [{byteLength: bytes.length}],
  };
  return {document, bytes};
}

/** A PNG of `side` x `side` texels, RGB of 8 bits: texel(x, y) gives three values, x and y from 0
 * to 1. */
export function pngOf(side, texel) {
  const rows = Buffer.alloc(side * (3 * side + 1));
  for (let y = 0; y < side; ++y) {
    for (let x = 0; x < side; ++x) {
      const values = texel((x + 0.5) / side, (y + 0.5) / side).map((v) =>
        Math.round(Math.min(Math.max(v, 0), 255)));
      rows.set(values, y * (3 * side + 1) + 1 + 3 * x);
    }
  }
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type), data]), ends = Buffer.alloc(8);
    ends.writeUInt32BE(data.length, 0);
    ends.writeUInt32BE(crc32(body), 4);
    return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(side, 0);
  head.writeUInt32BE(side, 4);
  head.set([8, 2], 8);
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head),
    chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

/** A .glb of a mesh whose textures, PNGs by the names of their slots, are those of a material with
 * these factors. */
export function shinyGlb(mesh, pictures, {pbr = {}, ...factors} = {}) {
  const {document, bytes} = gltfOf(mesh, pictures.baseColorTexture);
  const parts = [bytes], {bufferViews, images, textures} = document;
  let end = bytes.length;
  const material = {...factors, pbrMetallicRoughness: {baseColorTexture: {index: 0}, ...pbr}};
  for (const [slot, picture] of Object.entries(pictures)) {
    if (slot === 'baseColorTexture') continue;
    bufferViews.push({buffer: 0, byteOffset: end, byteLength: picture.length});
    parts.push(picture, Buffer.alloc(-picture.length & 3));
    end += (picture.length + 3) & ~3;
    images.push({bufferView: bufferViews.length - 1, mimeType: 'image/png'});
    textures.push({source: images.length - 1});
    const place = slot.startsWith('metallic') ? material.pbrMetallicRoughness : material;
    place[slot] = {...place[slot], index: textures.length - 1};
  }
  document.materials = [material];
  document.buffers = [{byteLength: end}];
  return glbFile(document, Buffer.concat(parts));
}

/** Wavefront OBJ, whose texture coordinates, if there are any, count from the bottom. */
export function objOf({positions, texcoords = [], triangles}) {
  const lines = [], cornerOf = (v) => (texcoords.length > 0 ? `${v + 1}/${v + 1}` : v + 1);
  for (let i = 0; i < positions.length; i += 3) {
    lines.push(`v ${positions.slice(i, i + 3).join(' ')}`);
  }
  for (let i = 0; i < texcoords.length; i += 2) {
    lines.push(`vt ${texcoords[i]} ${1 - texcoords[i + 1]}`);
  }
  for (let i = 0; i < triangles.length; i += 3) {
    lines.push(`f ${triangles.slice(i, i + 3).map(cornerOf).join(' ')}`);
  }
  return Buffer.from(lines.join('\n'));
}
