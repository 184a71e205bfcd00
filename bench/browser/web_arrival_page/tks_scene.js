// SPDX-License-Identifier: Apache-2.0
// Draws a stream, refined as its bytes come.
import {FIRST_FRAME, TksTerrain} from '../../../apps/web/src/three.js';
import {material, measure, query} from './scene.js';

const OPTIONS = {triangles: Number(query.triangles)};

export const refine = (opening, beginning) => measure(async function* () {
  const terrain = await opening;
  terrain.load(terrain.info.streamBytes).catch(() => {});  // told where frames are awaited
  const object = new TksTerrain(terrain, {material: material()});
  const shown = (frame) => {
    object.show(frame);
    return object;
  };
  const mark = (frame, options) => {
    let first = frame;  // drawn again later, decoded anew: the frames themselves would fill memory
    const {bytes} = frame;
    // Behind the first request there is one for the rest, which is under way meanwhile.
    const rounds = bytes > FIRST_FRAME.bytes ? terrain.loaded.requests : 1;
    return {bytes, rounds, show: async () => {
      const drawn = shown(first ?? (await terrain.decode({...options, bytes})));
      first = null;
      return drawn;
    }};
  };
  const first = await beginning;
  yield mark(first, FIRST_FRAME);
  for await (const frame of terrain.refine({...OPTIONS, after: first.bytes})) {
    yield mark(frame, OPTIONS);
  }
});
