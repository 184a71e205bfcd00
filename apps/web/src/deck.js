// SPDX-License-Identifier: Apache-2.0
// deck.gl: a loader of loaders.gl for meshes, for TerrainLayer and SimpleMeshLayer, which read them
// as longitude, latitude and metres, with `_instanced: false`.
import {groundAxes, normalsOn, straightAxes, trianglesOn} from './axes.js';
import {TksError, groundScale, open} from './index.js';
import {FIRST_BYTES, GROWTH} from './pace.js';
import {checkGround, isPlaced, placeOf, turnsTo} from './place.js';

export {TksError};

const TRIANGLES = 4;  // glTF's mode

/** Places of (column, row): longitude and latitude less the origin, and those on the texture. */
function placedBy(info, given, [longitude, latitude]) {
  const ground = placeOf(info, 'heights', given);
  const texture = info.hasTexture ? placeOf(info, 'texture', given) : null;
  return (column, row) => {
    // A sample is the middle of its pixel.
    const degrees = ground.degrees(column + 0.5, row + 0.5);
    // Both may count longitudes another way: from 0 to 360, or from -180 to 180.
    const [turn = 0] = texture ? turnsTo(texture.bounds, [degrees[0]]) : [];
    const [u, v] = texture?.pixels(degrees[0] + turn, degrees[1]) ?? [0, 0];
    return {
      x: degrees[0] - longitude, y: degrees[1] - latitude,
      u: u / (texture?.width ?? 1), v: v / (texture?.height ?? 1),
    };
  };
}

/** Places of (column, row) in metres around the middle: x along the rows, y against the columns. */
function placedFlat(info) {
  const scale = groundScale(info);
  return (column, row) => ({
    x: (column - (info.width - 1) / 2) * scale.x, y: ((info.height - 1) / 2 - row) * scale.y,
    u: column / (info.width - 1), v: row / (info.height - 1),
  });
}

/** Least and most of each coordinate. */
function boxOf(positions) {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, i) => {
    least[i % 3] = Math.min(least[i % 3], value);
    most[i % 3] = Math.max(most[i % 3], value);
  });
  return [least, most];
}

/** What deck.gl takes for an image. */
export function imageOf({width, height, data}) {
  const here = typeof ImageData !== 'undefined';
  return here ? new ImageData(data, width, height) : {width, height, data};
}

/** A frame with a mesh as loaders.gl's category `mesh`. */
export function meshOf(frame, {bounds, project, origin = [0, 0]} = {}) {
  const {info, mesh} = frame, count = mesh.gridIndex.length;
  const place =
    bounds || isPlaced(info) ? placedBy(info, {bounds, project}, origin) : placedFlat(info);
  const metres = groundScale(info).height, axes = bounds ? straightAxes(info) : groundAxes(info);
  const positions = new Float32Array(3 * count), texCoords = new Float32Array(2 * count);
  mesh.gridIndex.forEach((index, i) => {
    const {x, y, u, v} = place(index % info.width, Math.floor(index / info.width));
    positions.set([x, y, metres * mesh.heights[i]], 3 * i);
    texCoords.set([u, v], 2 * i);
  });
  const attributes = {
    POSITION: {value: positions, size: 3}, TEXCOORD_0: {value: texCoords, size: 2},
  };
  if (mesh.normals) {
    const normals = normalsOn(axes, mesh.normals).map((_, i, all) =>
      [all[i], -all[i + 1], all[i - 1]][i % 3]);  // z up
    attributes.NORMAL = {value: normals, size: 3};
  }
  return {
    loader: 'tks',
    loaderData: info,
    header: {vertexCount: count, boundingBox: boxOf(positions)},
    schema: {
      metadata: {},
      fields: Object.entries(attributes).map(([name, {size}]) => ({
        name,
        type: {
          type: 'fixed-size-list', listSize: size, children: [{name: 'value', type: 'float32'}],
        },
      })),
    },
    topology: 'triangle-list',
    mode: TRIANGLES,
    attributes,
    indices: {value: trianglesOn(axes, mesh.triangles), size: 1},
  };
}

/** A mesh of a stream or of a prefix of one, with its texture. */
async function parse(input, {tks, terrain: layer} = {}) {
  const {triangles, bytes, texels, origin, bounds, project, decoder} =
    {...TksLoader.options.tks, ...tks};
  const terrain = await open(input, decoder);
  try {
    const {info} = terrain;
    checkGround(info);
    if (!info.hasHeights) throw new TksError('usage', 'This stream is an image: it has no mesh.');
    const frame = await terrain.decode({bytes, triangles, texels, normals: true});
    return {
      // TerrainLayer says in `terrain` where it wants the mesh.
      ...meshOf(frame, {origin, project, bounds: bounds ?? layer?.bounds}),
      texture: frame.texture ? imageOf(frame.texture) : null,
    };
  } finally {
    terrain.dispose();
  }
}

/** Meshes of prefixes that grow fourfold, while the stream comes. */
async function* parseInBatches(chunks, options) {
  const limit = options?.tks?.bytes ?? Infinity, parts = [];
  let bytes = 0, wanted = Math.min(FIRST_BYTES, limit), shown = 0;
  const batch = async () => {
    shown = bytes;
    wanted = Math.min(GROWTH * bytes, Math.max(limit, bytes + 1));
    const data = await parse(new Blob(parts), options);
    return {batchType: 'data', shape: 'mesh', data, length: 1, bytesUsed: bytes};
  };
  for await (const chunk of chunks) {
    parts.push(chunk);
    bytes += chunk.byteLength;
    if (bytes < wanted) continue;
    try {
      yield await batch();
    } catch (error) {
      if (error.code !== 'truncated') throw error;  // the header is longer
    }
    if (bytes >= limit) return;
  }
  if (shown < bytes) yield await batch();
}

export const TksLoader = {
  dataType: null,
  batchType: null,
  name: 'Tetrakis terrain',
  id: 'tks',
  module: 'tetrakis',
  version: '0.1.0',
  category: 'mesh',
  extensions: ['tks'],
  mimeTypes: ['application/x.tks'],
  binary: true,
  tests: ['TKS\x1a'],
  options: {
    tks: {
      triangles: 20000, bytes: Infinity, texels: 4096, origin: [0, 0], bounds: undefined,
      project: undefined, decoder: {},
    },
  },
  parse,
  parseInBatches,
};
