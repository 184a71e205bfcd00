// SPDX-License-Identifier: Apache-2.0
// The first script of the page: asks for the stream (?tks=URL, or ?live=URL of a server) and
// decodes a first frame of it while what draws it is still on its way.
import {FIRST_FRAME} from '../src/index.js';
import {givenFrame} from './camera_link.js';
import {globeFor} from './globe_view.js';
import {inputOfPage, opened} from './opening.js';
import {hasTint} from './tint.js';

const input = inputOfPage();
let asked = null;
if (input) {
  const stop = new AbortController();
  const {signal} = stop, terrain = opened(input, {signal});
  const first = terrain.then((its) => its.decode({
    ...FIRST_FRAME, frame: givenFrame(its), bytes: its.loaded.bytes, samples: 1024, normals: true,
    surface: hasTint(its.info), globe: globeFor(its.info), signal,
  }));
  asked = {input, stop, terrain, first};
  for (const each of [terrain, first]) each.catch(() => {});  // the viewer tells why
}
try {
  const {begin} = await import('./viewer.js');
  begin(asked);
} catch (error) {
  const message = document.getElementById('message');
  message.textContent = /WebGL/.test(error.message)
    ? 'This browser has no WebGL, with which the viewer draws. Is it switched off?'
    : `The viewer does not start: ${error.message}`;
  message.hidden = false;
  document.body.dataset.state = 'failed';
}
