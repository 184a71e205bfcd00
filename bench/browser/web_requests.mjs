// SPDX-License-Identifier: Apache-2.0
// bench/web_requests: requests and bytes of all frames of a map, of a quarter of the ground and of
// all of it, for several costs of a request; then those of a terrain of three.js for a view, and
// for two more.
import {dirname, basename} from 'node:path';

import {PerspectiveCamera} from '../../apps/web/node_modules/three/build/three.module.js';
import {open} from '../../apps/web/src/index.js';
import {TksLoader} from '../../apps/web/src/three.js';
import {serve} from '../../apps/web/test/server.js';


const file = process.argv[2], server = await serve(dirname(file), {});

/** A map of a square of samples from the first one on, 960 pixels wide. */
function mapOf(side) {
  const k = 2 / side;
  return {clip: [k, 0, 0, -1, 0, -k, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1], width: 960, height: 960};
}

console.log('part     a request costs  requests  bytes');
for (const [name, share] of [['quarter', 1 / 2], ['all', 1]]) {
  for (const requestBytes of [0, 256, 1024, 4096, 16384, 65536]) {
    const before = server.requests.length;
    const terrain = await open(server.url + basename(file), {requestBytes});
    const view = mapOf(share * terrain.info.width);
    const frames = terrain.refine({view, mesh: false, texture: false});
    while (!(await frames.next()).done);
    console.log(name.padEnd(8), String(requestBytes).padStart(15),
      String(server.requests.length - before).padStart(9),
      String(terrain.loaded.bytes).padStart(7));
    terrain.dispose();
  }
}

/** Shows a camera until nothing more comes. */
async function settle(object, camera) {
  for (let quiet = 0; quiet < 5; ) {
    const before = object.terrain.loaded.bytes;
    object.update(camera, 800);
    await new Promise((resolve) => setTimeout(resolve, 200));
    quiet = object.terrain.loaded.bytes > before ? 0 : quiet + 1;
  }
}

console.log('\nview of TksLoader  requests  bytes');
const before = server.requests.length;
const object = await new TksLoader().loadAsync(server.url + basename(file));
const camera = new PerspectiveCamera(50, 1.6, 1, 1e7);
object.geometry.computeBoundingBox();
const {max, min} = object.geometry.boundingBox, side = max.x - min.x;
for (const [name, x, z] of [['first', -0.3, -0.3], ['second', -0.3, 0.2], ['third', 0.3, 0.2]]) {
  camera.position.set(x * side, max.y + 0.1 * side, z * side);
  camera.lookAt(1.4 * x * side, 0, 1.4 * z * side);
  await settle(object, camera);
  console.log(name.padEnd(17), String(server.requests.length - before).padStart(9),
    String(object.terrain.loaded.bytes).padStart(7));
}
object.dispose();
await server.close();
