// SPDX-License-Identifier: Apache-2.0
// One list of triangles of all parts of a file, as encodeObject() takes it, and what was left out.

/** For as many encoding takes minutes, and a gigabyte. */
const MOST_TRIANGLES = 2 ** 20;
/** Of what has no picture. */
const PLAIN = {colour: [1, 1, 1]};

const materialOf = ({material = PLAIN}) => material;
const vertexCount = ({geometry: {attributes: {position}}}) => position?.count ?? 0;
const triangleCount = (part) => (part.isSolid
  ? Math.floor((part.geometry.index?.count ?? vertexCount(part)) / 3) : 0);
const sum = (parts, count) => parts.reduce((total, part) => total + count(part), 0);
/** "1 part is", "3 parts are". */
const counted = (count, one, many) => (count === 1 ? `1 ${one}` : `${count} ${many}`);

/** The material whose picture most triangles have. */
function mostUsed(parts) {
  const uses = new Map();
  for (const part of parts) {
    const material = materialOf(part), use = uses.get(material.image) ?? {material, triangles: 0};
    use.triangles += triangleCount(part);
    uses.set(material.image, use);
  }
  return [...uses.values()].reduce((a, b) => (b.triangles > a.triangles ? b : a)).material;
}

function addPositions({geometry: {attributes: {position}}, matrix: {elements: m}}, out) {
  for (let i = 0; i < position.count; ++i) {
    const x = position.getX(i), y = position.getY(i), z = position.getZ(i);
    for (let row = 0; row < 3; ++row) {
      out[3 * i + row] = m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row];
    }
  }
}

/** Places on the picture, from its upper left corner. Gives how many were no numbers. */
function addTexcoords(part, out, isFromTop) {
  const {texcoords = 'uv', offset = [0, 0], scale = [1, 1]} = materialOf(part);
  const places = part.geometry.attributes[texcoords];
  let unplaced = 0;
  for (let i = 0; i < out.length / 2; ++i) {
    const u = places ? places.getX(i) * scale[0] + offset[0] : 0;
    const v = places ? places.getY(i) * scale[1] + offset[1] : 1;
    const isPlaced = Number.isFinite(u) && Number.isFinite(v);
    out.set(!isPlaced ? [0, 1] : !places || isFromTop ? [u, v] : [u, 1 - v], 2 * i);
    if (!isPlaced) ++unplaced;
  }
  return unplaced;
}

/** Triangles of a mirrored part are turned over, so that their front stays outside. */
function addTriangles({geometry: {index}, matrix}, first, count, out) {
  for (let i = 0; i < out.length; ++i) {
    const vertex = index ? index.getX(i) : i;
    if (vertex >= count) {
      throw new Error(`triangle ${1 + Math.floor(i / 3)} names a vertex that does not exist`);
    }
    out[i] = first + vertex;
  }
  if (matrix.determinant() >= 0) return;
  for (let i = 0; i < out.length; i += 3) [out[i + 1], out[i + 2]] = [out[i + 2], out[i + 1]];
}

/** What there is to say, as the command line says it. */
function remarksOn(all, parts, {image}, unplaced) {
  const other = parts.filter((part) => materialOf(part).image !== image);
  const dropped = all.length - parts.length;
  return [
    parts.length > 1 && `${parts.length} parts are joined`,
    other.length > 0 && counted(other.length, 'part has a texture of its own that is left out',
      'parts have textures of their own that are left out'),
    dropped > 0 && counted(dropped, 'part has no triangles and is left out',
      'parts have no triangles and are left out'),
    unplaced > 0 && counted(unplaced, 'texture coordinate is not finite and becomes 0',
      'texture coordinates are not finite and become 0'),
    image !== undefined && parts.some((part) => materialOf(part).isTurned) &&
      'a material turns its texture, which is not done',
  ].filter(Boolean);
}

/**
 * {mesh, material, hasTexcoords, remarks}: positions, triangles and texcoords of all parts, where
 * nodes place them; the material of most triangles, to whose picture the texcoords belong.
 * isFromTop: texture coordinates count from the top, as in glTF.
 */
export function joined(all, isFromTop) {
  const parts = all.filter((part) => triangleCount(part) > 0);
  if (parts.length === 0) throw new Error('it has no triangles');
  const vertices = sum(parts, vertexCount), triangles = sum(parts, triangleCount);
  if (triangles > MOST_TRIANGLES) {
    throw new Error(`it has ${triangles} triangles, more than a page can encode ` +
      `(${MOST_TRIANGLES}); the command line can: tetrakis encode`);
  }
  const mesh = {positions: new Float64Array(3 * vertices),
    texcoords: new Float32Array(2 * vertices), triangles: new Uint32Array(3 * triangles)};
  let first = 0, corner = 0, unplaced = 0;
  for (const part of parts) {
    const count = vertexCount(part), end = first + count, corners = 3 * triangleCount(part);
    addPositions(part, mesh.positions.subarray(3 * first, 3 * end));
    unplaced += addTexcoords(part, mesh.texcoords.subarray(2 * first, 2 * end), isFromTop);
    addTriangles(part, first, count, mesh.triangles.subarray(corner, corner + corners));
    [first, corner] = [end, corner + corners];
  }
  const material = mostUsed(parts);
  const hasTexcoords = parts.some((part) =>
    part.geometry.attributes[materialOf(part).texcoords ?? 'uv']);
  return {mesh, material, hasTexcoords, remarks: remarksOn(all, parts, material, unplaced)};
}
