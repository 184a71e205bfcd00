// SPDX-License-Identifier: Apache-2.0
// An object, such as a scan, in a scene of three.js: a mesh that refines by the camera. Its
// coordinates are those of the mesh that was encoded, in its unit, less `centre`.
import {BufferAttribute, BufferGeometry, DoubleSide, Vector3} from 'three';

import {fitCamera} from './fit.js';
import {PatchAtlas} from './patch_atlas.js';
import {textureOf} from './three_frame.js';
import {GOOD_PSNR, RefiningMesh} from './three_refining.js';

/** Seen from the front, a little above. */
const USUAL = new Vector3(-0.45, -0.3, -1);

function geometryOf({positions, normals, texcoords, triangles}) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  if (texcoords) geometry.setAttribute('uv', new BufferAttribute(texcoords, 2));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  if (normals) geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  else geometry.computeVertexNormals();
  return geometry;
}

function areaOf({positions, triangles}) {
  const [a, b, c] = Array.from({length: 3}, () => new Vector3());
  let twice = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    [a, b, c].forEach((corner, k) => corner.fromArray(positions, 3 * triangles[t + k]));
    twice += b.sub(a).cross(c.sub(a)).length();
  }
  return twice / 2;
}

export class TksObject extends RefiningMesh {
  #texel = 1;  // its side, about, in the unit of the object
  #next = null;  // geometry for a texture that is still being brought

  /** `terrain`: of open(). It is disposed with this object, as its material is. */
  constructor(terrain, options = {}) {
    super(terrain, options);
    if (!options.material) this.material.side = DoubleSide;  // scans have holes
  }
  get isPlanned() {
    return false;
  }
  /** What positions of the mesh that was encoded have more than those here. */
  get centre() {
    return new Vector3(...this.frame?.object?.centre ?? [0, 0, 0]);
  }

  draw({object, texture, info}) {
    if (object) {
      if (!this.frame && info.hasTexture) {
        this.#texel = Math.sqrt(areaOf(object) / (info.textureWidth * info.textureHeight)) || 1;
      }
      this.#next = geometryOf(object);
    }
    if (texture) this.take(textureOf(texture), () => this.#showNext());
    else this.#showNext();
  }
  #showNext() {
    if (this.#next) this.setGeometry(this.#next);
    this.#next = null;
  }

  /** Puts a camera so that the object fills its picture, seen along `direction`; gives the middle
   * of the object, for the target of controls. */
  fit(camera, direction = USUAL) {
    return fitCamera(camera, this, direction);
  }

  needs(camera, viewportHeight, texels) {
    const {info} = this.frame, pixels = this.pixelsPerUnit(camera, viewportHeight);
    const level = Math.max(0, Math.floor(-Math.log2(pixels * this.#texel)));
    const error = info.heightsRmse < 0 ? Infinity : info.heightsRmse * pixels;
    const more = error > this.pixelError ||
      (info.hasTexture && info.texturePsnr < GOOD_PSNR - 6 * level);
    return {more, texels: this.#texelsFor(level, texels)};
  }
  /** Those of an atlas at a level, or those that are shown where they do: an atlas is seen without
   * mip levels, so that a much too fine one flickers. */
  #texelsFor(level, shown) {
    const {textureWidth: side, textureHeight} = this.frame.info;
    if (!side) return shown;
    const {width, height} = new PatchAtlas(textureHeight / side, side, level);
    const texels = Math.ceil(Math.max(width, height));
    return shown >= texels && shown < 4 * texels ? shown : texels;
  }
}
