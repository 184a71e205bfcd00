// SPDX-License-Identifier: Apache-2.0
// bench/web_requests: requests and bytes of all frames of a map, of a quarter of the ground and of
// all of it, for several costs of a request.
import {dirname, basename} from 'node:path';

import {open} from '../../web/src/index.js';
import {serve} from '../../web/test/server.js';

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
await server.close();
