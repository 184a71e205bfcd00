// SPDX-License-Identifier: Apache-2.0
// The switches of the panel: how the terrain is drawn, and how the camera moves.
import {textureOf} from '../src/three.js';
import {$, explainMoves} from './page.js';
import {tinted} from './tint.js';

/** A globe on a cube has a material for each patch. */
const materialsOf = (object) => [object.material].flat();

export function setWireframe(object) {
  for (const material of materialsOf(object)) material.wireframe = $('wireframe').checked;
}

/** The texture, or colours by height, or neither, as the switch says. */
function setTexture(object) {
  object.setMap(null);
  const {texture, surface} = object.frame ?? {};
  if ($('textured').checked && (texture || surface))
    object.setMap(textureOf(texture ?? tinted(object.terrain, surface)));
  for (const material of materialsOf(object)) material.needsUpdate = true;
}

/** `shown()`: what draws the terrain, or null. */
export function listenToLooks(picture, shown) {
  for (const [name, set] of [['wireframe', setWireframe], ['textured', setTexture]]) {
    $(name).addEventListener('change', () => {
      if (shown()) set(shown());
      picture.draw();
    });
  }
  $('shaded').addEventListener('change', () => {
    for (const part of document.querySelectorAll('.of-light')) part.hidden = !$('shaded').checked;
    picture.setShaded($('shaded').checked);
  });
  $('fly').addEventListener('change', () => {
    picture.setFlying($('fly').checked);
    explainMoves($('fly').checked);
    $('picture').focus();
  });
}
