// SPDX-License-Identifier: Apache-2.0
// decimation_node.mjs NODE_FOLDER GRID SIDE OUT TRIANGLES...: meshes of Martini and Delatin.
// GRID: SIDE * SIDE float32. OUT: uint32 words; for each mesh: peer (0 Martini, 1 Delatin), budget,
// vertices, triangles, then column and row of each vertex, then three indices of each triangle.
// Martini: the largest mesh within the budget; Delatin: the first that reaches it.
import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const [folder, gridFile, sideText, outFile, ...budgets] = process.argv.slice(2);
const require = createRequire(resolve(folder, 'index.js'));
const Martini = require('@mapbox/martini');
const {default: Delatin} = await import(pathToFileURL(require.resolve('delatin')));
const side = Number(sideText);
const bytes = readFileSync(gridFile);
const heights = new Float32Array(bytes.buffer, bytes.byteOffset, side * side);

const words = [];
function put(peer, budget, coordinates, triangles) {
  words.push(peer, budget, coordinates.length / 2, triangles.length / 3);
  for (const c of coordinates) words.push(c);
  for (const t of triangles) words.push(t);
}

const tile = new Martini(side).createTile(heights);
for (const budget of budgets.map(Number)) {
  let low = 0, high = 1e6;  // errors: too many triangles at low, few enough at high
  let best = tile.getMesh(high);
  for (let step = 0; step < 50; ++step) {
    const middle = (low + high) / 2;
    const mesh = tile.getMesh(middle);
    if (mesh.triangles.length / 3 > budget) {
      low = middle;
    } else {
      high = middle;
      best = mesh;
    }
  }
  put(0, budget, best.vertices, best.triangles);
}

const delatin = new Delatin(heights, side, side);
for (const budget of budgets.map(Number)) {
  while (delatin.triangles.length / 3 < budget && delatin.getMaxError() > 0) delatin.refine();
  put(1, budget, delatin.coords, delatin.triangles);
}
writeFileSync(outFile, Buffer.from(Uint32Array.from(words).buffer));
