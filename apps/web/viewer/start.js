// SPDX-License-Identifier: Apache-2.0
// The first script of the page: asks for the stream (?tks=URL) and decodes a first frame of it
// while what draws it is still on its way.
import {FIRST_FRAME, open} from '../src/index.js';
import {givenFrame} from './camera_link.js';
import {decoder} from './decoder.js';
import {globeFor} from './globe_view.js';
import {hasTint} from './tint.js';

const address = new URLSearchParams(location.search).get('tks');
let asked = null;
if (address) {
  const stop = new AbortController();
  const {signal} = stop, terrain = open(address, {...decoder, signal});
  const first = terrain.then((opened) => opened.decode({
    ...FIRST_FRAME, frame: givenFrame(opened), bytes: opened.loaded.bytes, samples: 1024,
    normals: true,
    surface: hasTint(opened.info), globe: globeFor(opened.info), signal,
  }));
  asked = {address, stop, terrain, first};
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
