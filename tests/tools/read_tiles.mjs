// SPDX-License-Identifier: Apache-2.0
// Reads a folder of quantized-mesh tiles by @here/quantized-mesh-decoder, which is looked for in
// the working folder: each tile has a normal a vertex, availability on every tenth level, and
// triangles that fill it and turn the right way.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const kSide = 32767;
const requireHere = createRequire(join(process.cwd(), 'index.js'));
const decode = requireHere('@here/quantized-mesh-decoder').default;

function twiceArea({ triangleIndices, vertexData }) {
  const count = vertexData.length / 3;
  const at = (i) => [vertexData[i], vertexData[count + i]];
  let sum = 0;
  for (let i = 0; i < triangleIndices.length; i += 3) {
    const [[ax, ay], [bx, by], [cx, cy]] = [0, 1, 2].map((k) => at(triangleIndices[i + k]));
    const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    assert(area > 0);
    sum += area;
  }
  return sum;
}

const root = process.argv[2];
let tiles = 0;
for (const path of readdirSync(root, { recursive: true })) {
  if (!path.endsWith('.terrain')) continue;
  const bytes = readFileSync(join(root, path));
  const tile = decode(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  assert.equal(twiceArea(tile), 2 * kSide * kSide, path);
  assert.equal(tile.extensions.vertexNormals.length, tile.vertexData.length / 3 * 2, path);
  assert.equal('metadata' in tile.extensions, path.split('/')[0] % 10 === 0, path);
  ++tiles;
}
assert(tiles > 2);
console.log(`${tiles} tiles`);
