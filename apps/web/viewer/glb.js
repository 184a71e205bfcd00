// SPDX-License-Identifier: Apache-2.0
// A mesh as binary glTF 2.0, with its texture inside: unlit then, since a photograph holds its
// light already, as `tetrakis decode` writes it.

const FLOAT = 5126, UNSIGNED = 5125, ARRAY = 34962, INDICES = 34963, LINEAR_MIPMAPS = 9987;
const LINEAR = 9729, CLAMP = 33071, REPEAT = 10497;
const padded = (size) => size + (-size & 3);

const boundsOf = (positions) => [Math.min, Math.max].map((pick) => {
  const end = [...positions.subarray(0, 3)];
  positions.forEach((value, i) => (end[i % 3] = pick(end[i % 3], value)));
  return end;
});

/** The document, and the parts of the buffer that it speaks of. */
function documentOf({positions, normals, places, triangles, centre}, picture) {
  const parts = [positions, normals, places, triangles, ...(picture ? [picture.bytes] : [])];
  let offset = 0;
  const bufferViews = parts.map(({byteLength}, i) => {
    const view = {buffer: 0, byteOffset: offset, byteLength};
    offset += padded(byteLength);
    return i < 4 ? {...view, target: i < 3 ? ARRAY : INDICES} : view;
  });
  const [min, max] = boundsOf(positions);
  const accessor = (bufferView, type, count, rest) =>
    ({bufferView, componentType: FLOAT, type, count, ...rest});
  const count = positions.length / 3;
  const material = picture
    ? {pbrMetallicRoughness: {baseColorTexture: {index: 0}, metallicFactor: 0, roughnessFactor: 1},
      extensions: {KHR_materials_unlit: {}}, ...(picture.hasAlpha ? {alphaMode: 'MASK'} : {})}
    : {pbrMetallicRoughness: {metallicFactor: 0, roughnessFactor: 1}};
  const document = {
    asset: {version: '2.0', generator: 'Tetrakis'},
    scene: 0, scenes: [{nodes: [0]}],
    nodes: [{mesh: 0, name: centre ? 'object' : 'terrain', translation: centre}],
    meshes: [{primitives: [
      {attributes: {POSITION: 0, NORMAL: 1, TEXCOORD_0: 2}, indices: 3, material: 0},
    ]}],
    materials: [material],
    accessors: [accessor(0, 'VEC3', count, {min, max}), accessor(1, 'VEC3', count),
      accessor(2, 'VEC2', count),
      accessor(3, 'SCALAR', triangles.length, {componentType: UNSIGNED})],
    bufferViews, buffers: [{byteLength: offset}],
  };
  if (picture) {
    const wrap = picture.repeats ? REPEAT : CLAMP;
    Object.assign(document, {
      extensionsUsed: ['KHR_materials_unlit'],
      images: [{bufferView: 4, mimeType: picture.type}],
      samplers: [{magFilter: LINEAR, minFilter: LINEAR_MIPMAPS, wrapS: wrap, wrapT: wrap}],
      textures: [{source: 0, sampler: 0}],
    });
  }
  return {document, parts, length: offset};
}

/**
 * The bytes of a mesh {positions, normals, places, triangles} in metres, y up, (0, 0) of `places`
 * the first texel. `centre`: what positions of an object count from. `picture`: {bytes, type,
 * hasAlpha, repeats} of a PNG or JPEG, or null.
 */
export function glbOf(mesh, picture = null) {
  const {document, parts, length} = documentOf(mesh, picture);
  const json = new TextEncoder().encode(JSON.stringify(document)), text = padded(json.length);
  const bytes = new Uint8Array(12 + 8 + text + 8 + length), view = new DataView(bytes.buffer);
  const words = (at, ...values) => values.forEach((v, i) => view.setUint32(at + 4 * i, v, true));
  words(0, 0x46546c67, 2, bytes.length, text, 0x4e4f534a);
  bytes.fill(0x20, 20, 20 + text).set(json, 20);
  words(20 + text, length, 0x004e4942);
  parts.forEach(({buffer, byteOffset, byteLength}, i) =>
    bytes.set(new Uint8Array(buffer, byteOffset, byteLength),
      28 + text + document.bufferViews[i].byteOffset));
  return bytes;
}
