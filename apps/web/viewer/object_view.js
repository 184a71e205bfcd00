// SPDX-License-Identifier: Apache-2.0
// How the viewer shows an object: seen from all sides, as it is, without ground below it.
import {DoubleSide, MeshLambertMaterial, MeshStandardMaterial, Vector3} from 'three';

import {groundScale} from '../src/ground.js';
import {TksObject} from '../src/three.js';
import {$} from './page.js';
import {hitOn} from './ray.js';

/** What an orbit may do round an object, and over ground. */
const ALL_ROUND = {maxPolarAngle: Math.PI, screenSpacePanning: true};
const OVER_GROUND = {screenSpacePanning: false};
/** From where home looks: the front, a little above. */
const AHEAD = new Vector3(-0.45, -0.3, -1).normalize();
/** Of what has no texture: white would leave no room for light. */
const CLAY = 0xc9c4bb;
/** Significant digits of places, of the size of the object. */
const DIGITS = 4;

export class ViewedObject extends TksObject {
  isObject = true;
  /** From where home looks. */
  ahead = AHEAD;

  constructor(terrain) {
    const color = terrain.info.hasTexture ? 0xffffff : CLAY;
    super(terrain, {material: new MeshLambertMaterial({color, side: DoubleSide})});
  }
  litMaterial() {
    this.mirrors = true;  // metal shows what is around it
    return new MeshStandardMaterial({side: DoubleSide});
  }
  /** It does not: meshes of objects come one after the other. */
  glide() {
    return false;
  }
  /** The point at a place of the page; null: none. */
  pointAt(camera, x, y) {
    return hitOn(this, camera, x, y)?.point ?? null;
  }
}

/** What an orbit may do round what is drawn. */
export const orbitFor = (object) => (object?.isObject ? ALL_ROUND : OVER_GROUND);

/** Whether a metre is known. */
export const isInMetres = (info) => info.unit !== '' && groundScale(info).height === 1;

/** Gives the text of a point of an object: its coordinates in the mesh that was encoded. */
export function objectDescriber({unit}, object) {
  const {centre, geometry} = object;
  if (!geometry.boundingSphere) geometry.computeBoundingSphere();
  const size = Math.ceil(Math.log10(geometry.boundingSphere.radius || 1));
  const digits = Math.min(Math.max(DIGITS - size, 0), 20);
  return (point) => {
    const place = centre.clone().add(point).toArray();
    return `${place.map((part) => part.toFixed(digits)).join(' · ')} ${unit}`.trim();
  };
}

/** Hides of what heights have what objects do not, and north. */
export function hideControls({isObject, hasTexture}) {
  for (const part of document.querySelectorAll('.of-ground')) part.hidden ||= isObject;
  $('north').hidden = isObject;
  $('textured').parentElement.hidden = isObject && !hasTexture;
}
