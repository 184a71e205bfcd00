// SPDX-License-Identifier: Apache-2.0
// How frames of a sequence are decoded and drawn while they play: a grid of heights that moves, or
// the mesh of a globe.
import {FIRST_FRAME, textureOf} from '../src/three.js';
import {globeFor} from './globe_view.js';
import {$} from './page.js';
import {readSliders} from './sliders.js';
import {hasTint, tinted} from './tint.js';

/** Of a globe; a terrain says what it plays. */
const ON_GLOBE = {normals: true, texels: 1024, samples: 512};

/** The bytes that the slider says, of groups that differ in length. */
function bytesOf(info) {
  const {bytes} = readSliders(info);
  return $('bytes').value === $('bytes').max ? Infinity : bytes;
}

/** A frame, by its number. One that is to be soon has what the first bytes of its group tell, or
 * all that are here. */
export async function decodePlayed({terrain, object}, {frame, signal, isSoon}) {
  const {info} = object.frame, asked = {frame, signal}, height = Number($('exaggeration').value);
  let bytes = bytesOf(info);
  if (isSoon) {
    const have = await terrain.load(Math.min(bytes, FIRST_FRAME.bytes), asked);
    bytes = Math.min(bytes, Math.max(have, terrain.loaded.bytes));
  }
  const drawn = object.isGlobe
    ? {...ON_GLOBE, globe: globeFor(info, height), surface: hasTint(info)} : object.playing;
  const texture = info.hasTexture && $('textured').checked;
  return terrain.decode({...drawn, ...asked, bytes, texture});
}

export function drawPlayed({terrain, object}, frame) {
  const colours = hasTint(frame.info) && frame.surface && $('textured').checked
    ? tinted(terrain, frame.surface) : null;
  if (object.isGlobe) {
    object.show(frame);
    if (colours) object.setMap(textureOf(colours));
  } else {
    object.play(frame);
    if (colours) object.takeTurn(colours);
  }
}
