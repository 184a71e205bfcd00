// SPDX-License-Identifier: Apache-2.0
// three.js: a Loader, as DRACOLoader is one, and its meshes, which refine by the camera.
import {Loader} from 'three';

import {startDecoder} from './decoders.js';
import {TksError, open} from './index.js';
import {FIRST_FRAME} from './pace.js';
import {textureOf} from './three_frame.js';
import {TksObject} from './three_object.js';
import {TksTerrain} from './three_terrain.js';

export {FIRST_FRAME, TksError, TksObject, TksTerrain, textureOf};

/** A material of a terrain's own, which carries its texture. */
function copyOf(material) {
  const copy = material.clone();
  // clone() leaves out how shaders are changed.
  copy.onBeforeCompile = material.onBeforeCompile;
  copy.customProgramCacheKey = material.customProgramCacheKey;
  return copy;
}

export class TksLoader extends Loader {
  #decoderOptions = {};
  #terrainOptions = {};
  #spare = null;
  #stop = new AbortController();

  /** Those of open(): worker, wasm, memory, requestBytes. */
  setDecoderOptions(options) {
    this.dispose();
    this.#decoderOptions = options;
    return this;
  }
  /** Those of TksTerrain. Each terrain gets a copy of the material. */
  setTerrainOptions(options) {
    this.#terrainOptions = options;
    return this;
  }

  /** Fetches the decoder and starts its worker, which the next terrain takes. */
  preload() {
    this.#spare ??= startDecoder(this.#decoderOptions);
    return this;
  }
  /** Ends what preload() started and nothing has taken. Terrains are disposed one by one. */
  dispose() {
    this.#spare?.dispose();
    this.#spare = null;
    return this;
  }
  /** Ends what is being loaded. */
  abort() {
    this.#stop.abort();
    this.#stop = new AbortController();
    return this;
  }

  /** Gives a TksTerrain, or a TksObject, that shows its first frame; its update() brings the
   * others. */
  load(url, onLoad, onProgress, onError) {
    const resolved = this.manager.resolveURL((this.path ?? '') + url);
    this.manager.itemStart(resolved);
    this.#load(resolved)
      .then(onLoad, (error) => {
        this.manager.itemError(resolved);
        if (onError) onError(error);
        else console.error(error);
      })
      .finally(() => this.manager.itemEnd(resolved));
  }
  parse(buffer, onLoad, onError) {
    this.#load(buffer).then(onLoad, onError ?? console.error);
  }
  parseAsync(buffer) {
    return this.#load(buffer);
  }
  async #load(input) {
    const {requestHeader: headers, withCredentials} = this;
    const request = {headers, credentials: withCredentials ? 'include' : 'same-origin'};
    const options = {...this.#decoderOptions, request, signal: this.#stop.signal};
    if (this.#spare) [options.decoder, this.#spare] = [this.#spare, null];
    const terrain = await open(input, options);
    const {material, ...others} = this.#terrainOptions;
    const Kind = terrain.info.isObject ? TksObject : TksTerrain;
    const object = new Kind(terrain, {...others, material: material && copyOf(material)});
    try {
      await object.begin();
      return object;
    } catch (error) {
      object.dispose();
      throw error;
    }
  }
}
