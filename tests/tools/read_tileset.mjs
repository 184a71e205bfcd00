// SPDX-License-Identifier: Apache-2.0
// Walks a tileset of 3D Tiles 1.1, as far as its specification has rules for what is written here:
// the tree of tiles, their errors and the regions that hold them. Each content passes Khronos's
// gltf-validator (looked for in the working folder), and tiles of one level that touch share points
// of their edges, to the bit.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const validator = createRequire(join(process.cwd(), 'index.js'))('gltf-validator');
const root = process.argv[2];
const tileset = JSON.parse(readFileSync(join(root, 'tileset.json')));
assert.deepEqual(Object.keys(tileset).sort(), ['asset', 'geometricError', 'root']);
assert.equal(tileset.asset.version, '1.1');
assert(tileset.geometricError >= tileset.root.geometricError);
assert.equal(tileset.root.refine, 'REPLACE');
const levels = new Map();

// Positions in the axes of the Earth, as glTF has them: y up.
function positions(bytes) {
  const length = bytes.readUInt32LE(12);
  const gltf = JSON.parse(bytes.subarray(20, 20 + length).toString());
  const { bufferView, count } = gltf.accessors[gltf.meshes[0].primitives[0].attributes.POSITION];
  const start = 28 + length + (gltf.bufferViews[bufferView].byteOffset ?? 0);
  const { translation } = gltf.nodes[0];
  const points = [];
  for (let i = 0; i < count; ++i)
    points.push([0, 1, 2].map((k) => bytes.readFloatLE(start + 12 * i + 4 * k) + translation[k]));
  return points;
}

function inside([west, south, east, north, low, high], outer) {
  assert(west >= outer[0] && south >= outer[1] && east <= outer[2] && north <= outer[3]);
  assert(low >= outer[4] && high <= outer[5]);
}

// On WGS 84, within a micrometre of the ground: Bowring's latitude, as longitude and height in
// radians and metres.
function place([x, z, minusY]) {
  const kAxis = 6378137, kFlattening = 1 / 298.257223563, polar = kAxis * (1 - kFlattening);
  const e2 = kFlattening * (2 - kFlattening), across = Math.hypot(x, minusY);
  const reduced = Math.atan2(z * kAxis, across * polar);
  const latitude = Math.atan2(z + e2 / (1 - e2) * polar * Math.sin(reduced) ** 3,
                              across - e2 * kAxis * Math.cos(reduced) ** 3);
  const normal = kAxis / Math.sqrt(1 - e2 * Math.sin(latitude) ** 2);
  return [Math.atan2(-minusY, x), latitude, across / Math.cos(latitude) - normal];
}

// Positions are floats about the middle of a tile.
function checkPlaces(points, [west, south, east, north, low, high]) {
  for (const point of points) {
    const [longitude, latitude, height] = place(point);
    assert(longitude > west - 2e-9 && longitude < east + 2e-9, 'longitude');
    assert(latitude > south - 2e-9 && latitude < north + 2e-9, 'latitude');
    assert(height > low - 0.01 && height < high + 0.01, 'height');
  }
}

async function walk(tile, parent) {
  const { region } = tile.boundingVolume;
  assert(region[0] < region[2] && region[1] < region[3] && region[4] <= region[5]);
  assert(region.length === 6 && region.every((bound) => Number.isFinite(bound)));
  assert(Math.abs(region[0]) <= Math.PI && region[2] <= Math.PI + 1e-12);
  assert(region[1] >= -Math.PI / 2 - 1e-12 && region[3] <= Math.PI / 2 + 1e-12);
  assert(Number.isFinite(tile.geometricError) && tile.geometricError >= 0);
  if (parent) {
    inside(region, parent.boundingVolume.region);
    assert(tile.geometricError < parent.geometricError);
    assert(tile.content, 'only the root is empty');
  }
  if (tile.content) {
    const bytes = readFileSync(join(root, tile.content.uri));
    const { issues } = await validator.validateBytes(bytes, { ignoredIssues: [] });
    assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues));
    const points = positions(bytes);
    checkPlaces(points, region);
    const level = tile.content.uri.split('/')[0];
    if (!levels.has(level)) levels.set(level, []);
    levels.get(level).push({ uri: tile.content.uri, points });
  }
  for (const child of tile.children ?? []) await walk(child, tile);
}

await walk(tileset.root);
// Cells are longer than 4 m, so that points of one place are one point.
let tiles = 0, shared = 0;
for (const [level, list] of levels) {
  tiles += list.length;
  const places = new Map();
  for (const { uri, points } of list) {
    for (const point of points) {
      const place = point.map((value) => Math.round(value / 4)).join(), exact = point.join();
      if (!places.has(place)) places.set(place, exact);
      else ++shared;
      assert.equal(places.get(place), exact, `level ${level}, ${uri}: an edge differs`);
    }
  }
}
assert(shared > 0);
assert(tiles > 2);
console.log(`${tiles} tiles, ${shared} shared points`);
