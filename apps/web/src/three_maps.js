// SPDX-License-Identifier: Apache-2.0
// The maps of an object's material in three.js: textures in the slots of a MeshStandardMaterial, or
// of those that another material has.
import {NoColorSpace, SRGBColorSpace} from 'three';

import {factorsOf, mapsOf} from './material.js';
import {textureOf} from './three_frame.js';

const SLOTS = {
  normal: ['normalMap'],
  metallic_roughness: ['roughnessMap', 'metalnessMap'],
  occlusion: ['aoMap'],
  emissive: ['emissiveMap'],
};

export class MaterialMaps {
  #textures = new Map();  // of names
  #factors;

  /** Until a map of the stream is there the material is as one without it. `info`: of a stream. */
  constructor(material, info) {
    this.material = material;
    this.#factors = factorsOf(info.material);
    const coming = mapsOf(info);
    if ('roughness' in material) Object.assign(material, {roughness: 1, metalness: 0});
    this.#colour();
    for (const name of Object.keys(SLOTS)) if (!coming.has(name)) this.#scale(name);
  }

  #colour() {
    const {colour, opacity} = this.#factors;
    this.material.color?.setRGB(...colour);
    if (opacity < 1) Object.assign(this.material, {opacity, transparent: true});
  }
  /** Rasters by their names; those that are not there stay as they are. */
  show(rasters) {
    for (const [name, raster] of Object.entries(rasters)) {
      const texture = textureOf(raster);
      texture.colorSpace = name === 'emissive' ? SRGBColorSpace : NoColorSpace;
      this.#textures.get(name)?.dispose();
      this.#textures.set(name, texture);
      for (const slot of this.#slotsOf(name)) this.#put(slot, texture);
      this.#scale(name);
    }
  }
  #slotsOf(name) {
    const holdsOcclusion = name === 'metallic_roughness' && this.#factors.hasOcclusion &&
      !this.#textures.has('occlusion');
    return holdsOcclusion ? [...SLOTS[name], 'aoMap'] : SLOTS[name];
  }
  #put(slot, texture) {
    const {material} = this;
    if (!(slot in material)) return;
    if (!material[slot]) material.needsUpdate = true;
    material[slot] = texture;
  }
  #scale(name) {
    const {material} = this;
    const {metalness, roughness, emissive, normalScale, occlusionStrength} = this.#factors;
    // v grows downwards, as in glTF, so that green of normals points the other way.
    if (name === 'normal') material.normalScale?.set(normalScale, -normalScale);
    if (name === 'metallic_roughness' && 'roughness' in material) {
      Object.assign(material, {roughness, metalness});
    }
    if (name === 'emissive') material.emissive?.setRGB(...emissive);
    if (material.aoMap) material.aoMapIntensity = occlusionStrength;
  }

  dispose() {
    for (const texture of this.#textures.values()) texture.dispose();
    this.#textures.clear();
  }
}
