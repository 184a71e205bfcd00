// SPDX-License-Identifier: Apache-2.0
// A terrain in a scene of three.js: a mesh that refines by the camera, glides from one frame to the
// next, and tells its heights.
import {BufferAttribute, MathUtils, Matrix4} from 'three';

import {groundAxes, placedOn} from './axes.js';
import {fitCamera} from './fit.js';
import {surfaceUnder} from './glide.js';
import {groundScale} from './ground.js';
import {HeightLookup} from './height_lookup.js';
import {geometryOf, meshOf, textureOf} from './three_frame.js';
import {Grid} from './three_grid.js';
import {GOOD_PSNR, RefiningMesh} from './three_refining.js';

/** Triangles of a mesh that has time to glide: to begin takes some 20 ms for as many. */
const MOST_GLIDING = 1e5;

/** Of the texture of frames that play: the longest side. More would not be there in time. */
const PLAYED_TEXELS = 1024;

export class TksTerrain extends RefiningMesh {
  #lookup = null;  // of the geometry that is drawn, once it is asked for
  #grid = null;  // of frames that were played
  #glidesSince = -Infinity;

  /** `terrain`: of open(). It is disposed with this object, as its material is. */
  constructor(terrain, {glideTime = 300, samples = 512, ...options} = {}) {
    super(terrain, options);
    this.glideTime = glideTime;
    this.samples = samples;
  }

  draw(frame, {glide = false}) {
    if (frame.mesh || !this.frame) {
      const geometry = geometryOf(frame);
      if (glide && this.glideTime > 0 && this.frame?.mesh) this.#glideTo(geometry);
      this.setGeometry(geometry);
      this.#lookup = null;
      this.updateMorphTargets();
      this.glide();
    }
    if (frame.texture) this.take(textureOf(frame.texture));
  }
  /** Draws a frame with a surface, normals and no mesh, or a texture alone, as one of several that
   * follow each other: in the buffers of the one before. */
  play(frame) {
    if (frame.surface) this.#moveGrid(frame);
    else if (!this.frame) this.setGeometry(geometryOf(frame));
    if (frame.texture) this.takeTurn(frame.texture);
    this.tellPlayed(frame);
  }
  #moveGrid(frame) {
    if (this.#grid?.fits(frame)) this.#grid.put(frame.surface);
    else {
      this.#grid?.geometry.dispose();
      this.#grid = new Grid(frame);
    }
    if (this.geometry === this.#grid.geometry) return;
    this.setGeometry(this.#grid.geometry);
    this.#lookup = null;
  }
  /** What play() takes of a frame, as options of decode(). */
  get playing() {
    return {mesh: false, surface: true, normals: true, samples: this.samples,
      texels: PLAYED_TEXELS};
  }
  /** Fetches and plays a frame, by its number; resolves when it is drawn, or another is wanted. */
  async setFrame(number, {signal} = {}) {
    this.number = number;
    const {bytes, playing} = this;
    const frame = await this.terrain.decode({...playing, frame: number, bytes, signal});
    if (this.number === number) this.play(frame);
  }

  #glideTo(geometry) {
    if (Math.max(this.geometry.index.count, geometry.index.count) > 3 * MOST_GLIDING) return;
    const from = meshOf(this.geometry, this.#left()), to = meshOf(geometry, 0);
    const {positions, normals} = surfaceUnder(from, to);
    geometry.morphAttributes = {
      position: [new BufferAttribute(positions, 3)], normal: [new BufferAttribute(normals, 3)],
    };
    this.#glidesSince = performance.now();
  }
  /** What is left of the way between two frames: from 1 to 0, slow at both ends. */
  #left() {
    if (!this.geometry.morphAttributes.position) return 0;
    return 1 - MathUtils.smoothstep(performance.now() - this.#glidesSince, 0, this.glideTime);
  }
  /** Moves the surface on its way to the frame; false: it is there. update() does so as well. */
  glide() {
    const left = this.#left();
    if (this.morphTargetInfluences?.length) this.morphTargetInfluences[0] = left;
    return left > 0;
  }
  update(camera, viewportHeight) {
    this.glide();
    super.update(camera, viewportHeight);
  }

  /** Metres above (x, z), in the coordinates of this object; NaN where nothing is drawn. */
  heightAt(x, z) {
    if (!this.geometry.index) return NaN;
    if (this.geometry === this.#grid?.geometry) return this.#grid.heightAt(x, z);
    this.#lookup ??=
      new HeightLookup(this.geometry.getAttribute('position').array, this.geometry.index.array);
    return this.#lookup.at(x, z);
  }

  /** Puts a camera so that the terrain fills its picture, seen along `direction`; gives the middle
   * of the terrain, for the target of controls. */
  fit(camera, direction) {
    return fitCamera(camera, this, direction);
  }

  needs(camera, viewportHeight, texels) {
    const {info} = this.frame, scale = groundScale(info);
    const pixels = this.pixelsPerUnit(camera, viewportHeight);
    const texel = info.hasHeights ? ((info.width - 1) * scale.x) / info.textureWidth : 1;
    const level = Math.max(0, Math.floor(-Math.log2(pixels * texel)));
    const error = info.heightsRmse < 0 ? Infinity : info.heightsRmse * scale.height * pixels;
    // Averaging four texels takes 6 dB off an error without direction.
    const good = GOOD_PSNR - 6 * level;
    const side = Math.max(info.textureWidth, info.textureHeight, 1);
    return {
      more: (info.hasHeights && error > this.pixelError) ||
        (info.hasTexture && info.texturePsnr < good),
      texels: Math.max(texels, Math.ceil(side / 2 ** level)),
    };
  }

  /** What this camera looks at, as `view` of terrain.decode(). */
  viewOf(camera, viewportHeight) {
    const {info} = this.terrain, flat = !info.hasHeights;
    const width = flat ? info.textureWidth : info.width;
    const height = flat ? info.textureHeight : info.height;
    const scale = flat
      ? {x: width / Math.max(1, width - 1), y: height / Math.max(1, height - 1), height: 1}
      : groundScale(info);
    const placed = placedOn(groundAxes(flat ? {} : info));
    const along = placed(scale.x, 0), down = placed(0, scale.y);
    const [east, south] = placed((-scale.x * (width - 1)) / 2, (-scale.y * (height - 1)) / 2);
    return super.viewOf(camera, viewportHeight, new Matrix4().set(
      along[0], down[0], 0, east, 0, 0, scale.height, 0, along[1], down[1], 0, south, 0, 0, 0, 1));
  }
}
