// SPDX-License-Identifier: Apache-2.0
// A stream, refined as its bytes come.
import {open} from '../../../web/src/index.js';
import {FIRST_FRAME, TksTerrain} from '../../../web/src/three.js';
import {material, measure, query} from './scene.js';

const GROWTH = 4;
const OPTIONS = {triangles: Number(query.triangles)};

measure(async function* () {
  const terrain = await open(query.data, {wasm: query.wasm, worker: query.worker});
  const object = new TksTerrain(terrain, {material: material()});
  const shown = (frame) => {
    object.show(frame);
    return object;
  };
  const mark = (frame, options) => {
    let first = frame;  // drawn again later, decoded anew: the frames themselves would fill memory
    const {bytes} = frame;
    return {bytes, rounds: terrain.loaded.requests, show: async () => {
      const drawn = shown(first ?? (await terrain.decode({...options, bytes})));
      first = null;
      return drawn;
    }};
  };
  yield mark(await terrain.decode(FIRST_FRAME), FIRST_FRAME);
  await terrain.load(GROWTH * FIRST_FRAME.bytes);
  for await (const frame of terrain.refine(OPTIONS)) yield mark(frame, OPTIONS);
});
