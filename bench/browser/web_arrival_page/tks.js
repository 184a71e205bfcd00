// SPDX-License-Identifier: Apache-2.0
// A stream: asked for, and its first frame decoded, while what draws it is still on its way.
import {FIRST_FRAME, open} from '../../../apps/web/src/index.js';

const {data, wasm, worker} = Object.fromEntries(new URLSearchParams(location.search));
const opening = open(data, {wasm, worker});
const first = opening.then((terrain) => terrain.decode(FIRST_FRAME));
for (const each of [opening, first]) each.catch(() => {});  // told where it is awaited
const {refine} = await import('./tks_scene.js');
refine(opening, first);
