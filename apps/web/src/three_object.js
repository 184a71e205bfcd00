// SPDX-License-Identifier: Apache-2.0
// An object, such as a scan, in a scene of three.js: a mesh that refines by the camera. Its
// coordinates are those of the mesh that was encoded, in its unit, less `centre`.
import {
  BufferAttribute, BufferGeometry, DoubleSide, MeshStandardMaterial, Vector3,
} from 'three';

import {fitCamera} from './fit.js';
import {hasMaterial, mapsOf} from './material.js';
import {PatchAtlas} from './patch_atlas.js';
import {textureOf} from './three_frame.js';
import {MaterialMaps} from './three_maps.js';
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

/** Of triangles between points of two or three coordinates. */
function areaOf(triangles, points, dimensions) {
  const [a, b, c] = Array.from({length: 3}, () => new Vector3());
  let twice = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    [a, b, c].forEach((corner, k) => {
      corner.fromArray(points, dimensions * triangles[t + k]);
      if (dimensions < 3) corner.z = 0;
    });
    twice += b.sub(a).cross(c.sub(a)).length();
  }
  return twice / 2;
}

/** The share of a texture that lies on an object. What repeats counts once: all of it may lie on a
 * large triangle. */
const shareOf = ({triangles, texcoords}, {objectTriangles}) =>
  (objectTriangles ? Math.min(areaOf(triangles, texcoords, 2), 1) : 1);

/** The side of a texel, about, in the unit of the object. */
function texelOf(object, info) {
  const texels = info.textureWidth * info.textureHeight * shareOf(object, info);
  return Math.sqrt(areaOf(object.triangles, object.positions, 3) / texels) || 1;
}

export class TksObject extends RefiningMesh {
  #texel = 1;  // its side
  #next = null;  // geometry for a texture that is still being brought
  #maps = null;
  #isGiven;  // its material

  /** `terrain`: of open(). It is disposed with this object, as its material is. */
  constructor(terrain, options = {}) {
    super(terrain, options);
    this.#isGiven = Boolean(options.material);
    if (!this.#isGiven) this.material.side = DoubleSide;  // scans have holes
    this.#light(terrain.info);
  }
  /** What takes the place of the material once the stream is known to have maps; null: nothing. */
  litMaterial() {
    return this.#isGiven ? null : new MeshStandardMaterial({side: DoubleSide});
  }
  /** A sketch knows of no maps: they come with the header. */
  #light(info) {
    if (this.#maps || !hasMaterial(info)) return;
    const before = this.material, lit = this.litMaterial();
    if (lit) {
      const {map, alphaTest, wireframe} = before;
      this.material = Object.assign(lit, {map, alphaTest, wireframe});
      before.dispose();
    }
    this.#maps = new MaterialMaps(this.material, info);
  }
  get isPlanned() {
    return false;
  }
  /** Of triangles that are coded as they are, which are in the header, the first frame has as many
   * as any. */
  get hasFinalMesh() {
    return Boolean(this.frame?.object && this.frame.info.objectTriangles);
  }
  /** What positions of the mesh that was encoded have more than those here. */
  get centre() {
    return new Vector3(...this.frame?.object?.centre ?? [0, 0, 0]);
  }

  draw({object, texture, maps, info}) {
    this.#light(info);
    if (maps) this.#maps?.show(maps);
    if (object) {
      const isFirst = this.frame?.info.showsSketch !== info.showsSketch;
      if (isFirst && info.hasTexture) this.#texel = texelOf(object, info);
      this.#next = geometryOf(object);
    }
    if (texture) this.take(textureOf(texture), () => this.#showNext());
    else this.#showNext();
  }
  #showNext() {
    if (this.#next) this.setGeometry(this.#next);
    this.#next = null;
  }

  dispose() {
    this.#maps?.dispose();
    super.dispose();
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
    const more = (info.hasHeights && error > this.pixelError) ||
      (info.hasTexture && this.#leastPsnr() < GOOD_PSNR - 6 * level);
    return {more, texels: this.#texelsFor(level, texels)};
  }
  /** Of what lies on the object: its texture, and the maps of its material. */
  #leastPsnr() {
    const {info, maps = {}} = this.frame;
    const known = [...mapsOf(info).keys()].map((name) => maps[name]?.psnr ?? -1);
    return Math.min(info.texturePsnr, ...known);
  }
  /** Those of a texture at a level, or those that are shown where they do: an atlas is seen without
   * mip levels, so that a much too fine one flickers. */
  #texelsFor(level, shown) {
    const {textureWidth: side, textureHeight, objectTriangles} = this.frame.info;
    if (!side) return shown;
    if (objectTriangles) {
      return Math.max(shown, Math.ceil(Math.max(side, textureHeight) / 2 ** level));
    }
    const {width, height} = new PatchAtlas(textureHeight / side, side, level);
    const texels = Math.ceil(Math.max(width, height));
    return shown >= texels && shown < 4 * texels ? shown : texels;
  }
}
