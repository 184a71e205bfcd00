// SPDX-License-Identifier: Apache-2.0
// A globe in the viewer's scene, with what the viewer asks of a terrain. Metres from the centre:
// the north pole is up (y), longitude 0 at x.
import {BufferAttribute, BufferGeometry, Matrix4, Mesh, RepeatWrapping} from 'three';

import {isForest} from '../src/domains.js';
import {drapeOf} from '../src/drape.js';
import {textureOf} from '../src/three.js';
import {viewThrough} from '../src/three_refining.js';
import {PATCHES, groupByPatches, texturesOfPatches} from './cube.js';
import {draped, liesOnDegrees} from './globe_drape.js';

/** From metres whose z points to the north pole to those of the mesh. */
const UPRIGHT = [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1];

/** The same of vectors. */
function upright(vectors) {
  const turned = new Float32Array(vectors.length);
  for (let i = 0; i < vectors.length; i += 3) {
    turned[i] = vectors[i];
    turned[i + 1] = vectors[i + 2];
    turned[i + 2] = -vectors[i + 1];
  }
  return turned;
}

/** Places on the texture. One without a place of its own covers the whole raster, as tints do. */
function placesOf(info, pixels) {
  const {width, height, hasTexture, textureHasGeotransform} = info, drape = drapeOf(info);
  const isPlaced = hasTexture && (textureHasGeotransform || isForest(info.textureDomain));
  const places = new Float32Array(pixels.length);
  for (let i = 0; i < pixels.length; i += 2) {
    const [column, row] = [pixels[i], pixels[i + 1]];
    places.set(isPlaced ? drape(column - 0.5, row - 0.5) : [column / width, row / height], i);
  }
  return places;
}

function geometryOf({info, globe}) {
  const geometry = new BufferGeometry();
  const {positions, normals, heights, triangles, places} = liesOnDegrees(info)
    ? draped(globe, info) : {...globe, places: placesOf(info, globe.pixels)};
  geometry.setAttribute('position', new BufferAttribute(upright(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(upright(normals), 3));
  geometry.setAttribute('uv', new BufferAttribute(places, 2));
  geometry.setAttribute('tall', new BufferAttribute(heights, 1));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  if (isInPatches(info)) groupByPatches(geometry, info, globe.pixels);
  return geometry;
}

/** Whether each patch of a cube has a picture of its own. */
const isInPatches = (info) => info.domain === 'cube' && !liesOnDegrees(info);

export class Globe extends Mesh {
  isGlobe = true;
  frame = null;
  /** Of the highest ground, exaggerated. */
  radius = 1;

  /** `terrain`: of open(). It is disposed with this object, as its material is. */
  constructor(terrain, material) {
    const {hasTexture, textureOpaque} = terrain.info;
    if (hasTexture && !textureOpaque) material.alphaTest = 0.5;
    super(new BufferGeometry(), !isInPatches(terrain.info) ? material
      : Array.from({length: PATCHES}, () => material.clone()));
    this.terrain = terrain;
  }

  /** Draws a frame of `terrain`. Parts that it lacks stay as they are. */
  show(frame) {
    if (frame.globe) {
      this.geometry.dispose();
      this.geometry = geometryOf(frame);
      this.#measure();
    }
    if (frame.texture) this.setMap(textureOf(frame.texture));
    this.frame = {...this.frame, ...frame};
  }
  #measure() {
    const {array} = this.geometry.getAttribute('position');
    let most = 0;
    for (let i = 0; i < array.length; i += 3)
      most = Math.max(most, Math.hypot(array[i], array[i + 1], array[i + 2]));
    this.radius = most || 1;
  }

  /** What this camera looks at. */
  viewOf(camera, viewportHeight) {
    return viewThrough(camera, viewportHeight, this, new Matrix4().set(...UPRIGHT));
  }

  get #materials() {
    return [this.material].flat();
  }
  setMap(texture) {
    const isCube = this.#materials.length > 1;
    if (texture && !isCube) texture.wrapS = RepeatWrapping;  // on behind the seam
    const textures = texture && isCube ? texturesOfPatches(texture) : [texture];
    this.#materials.forEach((material, i) => {
      material.map?.dispose();
      if (!material.map) material.needsUpdate = true;
      material.map = textures[i] ?? null;
    });
  }
  /** It does not: meshes of globes come one after the other. */
  glide() {
    return false;
  }
  dispose() {
    this.geometry.dispose();
    this.setMap(null);
    for (const material of this.#materials) material.dispose();
    this.terrain.dispose();
  }
}
