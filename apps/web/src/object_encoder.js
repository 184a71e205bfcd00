// SPDX-License-Identifier: Apache-2.0
// Meshes of triangles as the WebAssembly module takes them that encodes objects.
import {streamOf, withEncoder} from './encoder_call.js';
import {imageFields, oneOf, targetFields, texelFields} from './encoder_fields.js';
import {TksError} from './error.js';
import {MAPS} from './material.js';

/** By the numbers of tks_object_kind. */
const KINDS = ['auto', 'resampled', 'triangles'];
const INDEXES = [false, true];

/** How many items of `size` numbers there are. */
function countOf(values, size, what) {
  const count = values?.length / size;
  if (Number.isInteger(count)) return count;
  throw new TksError('usage', `${what} are a list of ${size} numbers each.`);
}

/** Places on the image of all corners of triangles. */
function cornersOf({positions, triangles, texcoords, texture}) {
  if (!texture && !texcoords) return null;
  if (!texture || texcoords?.length / 2 !== positions.length / 3) {
    throw new TksError('usage', 'A texture and texcoords, two numbers for each of the positions, ' +
      'go together.');
  }
  const corners = new Float32Array(2 * triangles.length);
  for (let i = 0; i < triangles.length; ++i) {
    corners[2 * i] = texcoords[2 * triangles[i]];
    corners[2 * i + 1] = texcoords[2 * triangles[i] + 1];
  }
  return corners;
}

/** Below 0: none; 0: chosen. */
function sketchOf(sketch = 'auto') {
  if (sketch === 'auto' || sketch === 'none') return sketch === 'none' ? -1 : 0;
  if (Number.isSafeInteger(sketch) && sketch > 0) return sketch;
  throw new TksError('usage', "sketch is a number of bytes, 'none' or 'auto'.");
}

/** The maps by MAPS; null: it is not given. */
function mapsOf({maps, texture}) {
  const names = Object.keys(maps ?? {}), unknown = names.find((name) => !MAPS.includes(name));
  if (unknown !== undefined) oneOf(MAPS, unknown, 'The name of a map');
  if (names.length > 0 && !texture) {
    throw new TksError('usage', 'maps lie on a mesh as its texture does: give one.');
  }
  return MAPS.map((name) => maps?.[name] ?? null);
}

/** JSON, as it is or of an object. */
const textOf = (material) =>
  (typeof material === 'object' && material !== null ? JSON.stringify(material) : material);

/** What web_encode_object() takes, by name. */
function fieldsOf({positions, triangles, texture, kind, sketch, index, ...options}, maps) {
  const ofMaps = maps.map((map, i) => (map ? imageFields(map, MAPS[i]) : {}));
  return {
    vertexCount: countOf(positions, 3, 'positions'),
    triangleCount: countOf(triangles, 3, 'triangles'),
    kind: oneOf(KINDS, kind, 'kind'), sketchBytes: sketchOf(sketch),
    index: oneOf(INDEXES, index, 'index'),
    ...(texture ? texelFields(texture) : {}), ...Object.assign({}, ...ofMaps),
    ...targetFields(options),
  };
}

/** What became of a mesh, by name. */
function reportOf(instance) {
  const {calls} = instance;
  const names = instance.text(calls.web_encode_object_report_names()).split(' ');
  const values = instance.view(Float64Array, calls.web_encode_object_report(), names.length);
  const report = Object.fromEntries(names.map((name, i) => [name, values[i]]));
  return {...report, kind: KINDS[report.kind]};
}

/** tks_encode_object: {stream, report}. */
export function encodeObjectWith(module, input, progress) {
  const maps = mapsOf(input), {unit, description, material} = input;
  const given = {
    numbers: fieldsOf(input, maps), texts: {unit, description, material: textOf(material)},
    arrays: [Float64Array.from(input.positions), Uint32Array.from(input.triangles),
      cornersOf(input), input.texture?.data, ...maps.map((map) => map?.data)],
  };
  return withEncoder(module, progress, (instance) => {
    const stream = streamOf(instance, 'web_encode_object', given);
    return {stream, report: reportOf(instance)};
  });
}
