// SPDX-License-Identifier: Apache-2.0
// A stream: asked for, and its decoder started, while what draws it is still on its way.
import {open} from '../../../web/src/index.js';

const {data, wasm, worker} = Object.fromEntries(new URLSearchParams(location.search));
const opening = open(data, {wasm, worker});
opening.catch(() => {});  // told where it is awaited
const {refine} = await import('./tks_scene.js');
refine(opening);
