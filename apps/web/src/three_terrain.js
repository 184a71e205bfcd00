// SPDX-License-Identifier: Apache-2.0
// A terrain in a scene of three.js: a mesh that shows frames of a stream, fetches more where a
// camera sees the difference, and glides from one frame to the next.
import {
  Box3, BufferAttribute, BufferGeometry, MathUtils, Matrix4, Mesh, MeshBasicMaterial,
  MeshMatcapMaterial, Vector3,
} from 'three';

import {groundAxes, placedOn} from './axes.js';
import {fitCamera} from './fit.js';
import {surfaceUnder} from './glide.js';
import {groundScale} from './ground.js';
import {HeightLookup} from './height_lookup.js';
import {FIRST_FRAME, GROWTH} from './pace.js';
import {geometryOf, meshOf, textureOf} from './three_frame.js';
import {Upload, isSliced} from './three_upload.js';
import {isDrawable} from './view.js';

/** A photograph holds its light already; heights alone are shaded by how they face the camera. */
const unlit = ({hasTexture}) => (hasTexture ? new MeshBasicMaterial() : new MeshMatcapMaterial());

/** What is asked for at a time where the camera may move meanwhile: as much as is there, within. */
const LEAST_STEP = 2 ** 16, MOST_STEP = 2 ** 20;
/** What error of a texture is seen where a texel fills a pixel. */
const GOOD_PSNR = 40;

/** Milliseconds between calls of update() by which a page is taken to draw all the time, and to
 * draw on, however slowly. */
const STEADY = 100, SLOW = 1000;

/** Triangles of a mesh that has time to glide: to begin takes some 20 ms for as many. */
const MOST_GLIDING = 1e5;

export class TksTerrain extends Mesh {
  #reading = null;
  #stop = new AbortController();
  #box = new Box3();
  #eye = new Vector3();
  #wanted = 0;
  #texels = Infinity;
  #map = null;  // of its own
  #upload = null;  // of the next one
  #renderer = null;  // that drew last
  #served = '';  // the view for which all is here
  #lookup = null;  // of the geometry that is drawn, once it is asked for
  #glidesSince = -Infinity;
  #updated = [-Infinity, -Infinity];  // when update() was called last, and before that

  /** `terrain`: of open(). It is disposed with this object, as its material is. */
  constructor(terrain, {
    triangles = 20000, bytes = Infinity, pixelError = 1, glideTime = 300, material,
  } = {}) {
    super(new BufferGeometry(), material ?? unlit(terrain.info));
    this.terrain = terrain;
    this.triangles = triangles;
    this.bytes = bytes;
    this.pixelError = pixelError;
    this.glideTime = glideTime;
    this.frame = null;
    if (terrain.info.hasTexture && !terrain.info.textureOpaque) this.material.alphaTest = 0.5;
  }

  /** Shows what opening brought. */
  async begin() {
    const triangles = Math.min(FIRST_FRAME.triangles, this.triangles);
    this.show(await this.terrain.decode(
      {...FIRST_FRAME, bytes: this.#firstBytes(), triangles, normals: true}));
  }

  /** Draws a frame of `terrain`. Parts that it lacks stay as they are. */
  show(frame, {glide = false} = {}) {
    if (frame.mesh || !this.frame) {
      const geometry = geometryOf(frame);
      if (glide && this.glideTime > 0 && this.frame?.mesh) this.#glideTo(geometry);
      this.geometry.dispose();
      this.geometry = geometry;
      this.#lookup = null;
      this.updateMorphTargets();
      this.glide();
    }
    if (frame.texture) this.#take(textureOf(frame.texture));
    this.frame = {...this.frame, ...frame};
    this.dispatchEvent({type: 'frame', frame});
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

  /** Metres above (x, z), in the coordinates of this object; NaN where nothing is drawn. */
  heightAt(x, z) {
    if (!this.geometry.index) return NaN;
    this.#lookup ??=
      new HeightLookup(this.geometry.getAttribute('position').array, this.geometry.index.array);
    return this.#lookup.at(x, z);
  }

  /** Puts a camera so that the terrain fills its picture, seen along `direction`; gives the middle
   * of the terrain, for the target of controls. */
  fit(camera, direction) {
    return fitCamera(camera, this, direction);
  }

  onBeforeRender(renderer) {
    this.#renderer = renderer;
  }
  /** Shows a texture: at once, or once update() has brought the slices of a large one. */
  #take(texture) {
    this.#upload?.texture.dispose();
    this.#upload = null;
    if (!isSliced(texture, this.#renderer) || !this.#isDrawn(SLOW)) return this.setMap(texture);
    this.#upload = new Upload(texture);
    this.#awaitUpdates(this.#upload);
  }
  #bringSlice() {
    if (!this.#upload?.step(this.#renderer)) return;
    this.setMap(this.#upload.texture);
    this.#upload = null;
  }
  /** Of a page that does not call update() any more the rest comes at once. */
  #awaitUpdates(upload) {
    setTimeout(() => {
      if (this.#upload !== upload) return;
      if (this.#isDrawn(SLOW)) return this.#awaitUpdates(upload);
      this.#upload = null;
      this.setMap(upload.texture);
      this.dispatchEvent({type: 'frame', frame: this.frame});
    }, SLOW);
  }

  setMap(texture) {
    this.#map?.dispose();
    this.#map = texture;
    if (!this.material.map) this.material.needsUpdate = true;
    this.material.map = texture;
  }

  /** Pixels of a metre where the camera is nearest, on the axis that is scaled most. */
  #pixelsPerMetre(camera, viewportHeight) {
    if (camera.isOrthographicCamera) {
      return (viewportHeight * camera.zoom) / (camera.top - camera.bottom);
    }
    if (!this.geometry.boundingBox) this.geometry.computeBoundingBox();
    this.#box.copy(this.geometry.boundingBox).applyMatrix4(this.matrixWorld);
    const distance = this.#box.distanceToPoint(camera.getWorldPosition(this.#eye));
    const scale = Math.max(...this.getWorldScale(new Vector3()).toArray());
    const focal = viewportHeight / (2 * Math.tan(MathUtils.degToRad(camera.fov) / 2));
    return (scale * focal * camera.zoom) / Math.max(distance, camera.near);
  }

  /** Whether this camera sees that bytes are missing, and the longest side of a texture for it. */
  #needs(camera, viewportHeight) {
    const {info} = this.frame, scale = groundScale(info);
    const pixels = this.#pixelsPerMetre(camera, viewportHeight);
    const texel = info.hasHeights ? ((info.width - 1) * scale.x) / info.textureWidth : 1;
    const level = Math.max(0, Math.floor(-Math.log2(pixels * texel)));
    const error = info.heightsRmse < 0 ? Infinity : info.heightsRmse * scale.height * pixels;
    // Averaging four texels takes 6 dB off an error without direction.
    const good = GOOD_PSNR - 6 * level;
    return {
      more: (info.hasHeights && error > this.pixelError) ||
        (info.hasTexture && info.texturePsnr < good),
      texels: Math.ceil(Math.max(info.textureWidth, info.textureHeight, 1) / 2 ** level),
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
    const ground = new Matrix4().set(
      along[0], down[0], 0, east, 0, 0, scale.height, 0, along[1], down[1], 0, south, 0, 0, 0, 1);
    camera.updateMatrixWorld();
    this.updateWorldMatrix(true, false);
    const clip = ground.premultiply(this.matrixWorld).premultiply(camera.matrixWorldInverse)
      .premultiply(camera.projectionMatrix).transpose().toArray();
    const {elements} = camera.projectionMatrix;
    const across = Math.max(1, (viewportHeight * elements[5]) / elements[0]);
    return {clip, width: across, height: viewportHeight};
  }

  /** Of the first frame: what opening brought. */
  #firstBytes() {
    return Math.min(this.bytes, Math.max(FIRST_FRAME.bytes, this.terrain.loaded.bytes));
  }
  /** As many bytes as the next frame takes. */
  #nextBytes(more, planned, limit) {
    if (!planned) {
      return Math.min((more ? GROWTH : 1) * (this.#wanted || this.#firstBytes()), limit);
    }
    const here = this.terrain.loaded.bytes;
    const step = Math.min(Math.max((GROWTH - 1) * here, LEAST_STEP), MOST_STEP);
    return more ? Math.min(here + step, limit) : this.#wanted;
  }

  /**
   * To be called for each picture: fetches and decodes more where this camera sees the difference.
   * Of a stream with an index that is what helps this view most, until nothing more does. A view
   * without a picture, as in a hidden tab, waits for one. One decoding runs at a time. Failures go
   * to the event `error`.
   */
  update(camera, viewportHeight) {
    this.#updated = [performance.now(), this.#updated[0]];
    this.glide();
    this.#bringSlice();
    if (this.#reading || this.#stop.signal.aborted) return;
    const {info, fileBytes} = this.terrain;
    const limit = Math.min(this.bytes, info.streamBytes, fileBytes);
    const seen = this.viewOf(camera, viewportHeight);
    if (!isDrawable(seen)) return;
    const view = this.frame && info.hasIndex ? seen : null;
    const key = view ? view.clip.map((v) => v.toPrecision(6)).join() : '';
    let bytes = this.#firstBytes(), texels = this.#texels;
    if (this.frame) {
      const needs = this.#needs(camera, viewportHeight);
      const more = view ? key !== this.#served : needs.more;
      bytes = this.#nextBytes(more, view, limit);
      texels = this.#wanted ? Math.max(texels, needs.texels) : needs.texels;
      if (bytes === this.#wanted && texels === this.#texels) return;
    } else {
      texels = FIRST_FRAME.texels;
    }
    this.#reading = this.#read(bytes, texels, view).then((isServed) => {
      if (isServed) this.#served = key;
    }).finally(() => (this.#reading = null));
  }
  /** Whether no byte came: where only fewer came than were asked for, others still help a view. */
  async #read(bytes, texels, view) {
    try {
      const {triangles} = this, {signal} = this.#stop, here = this.terrain.loaded.bytes;
      const have = await this.terrain.load(bytes, {view, triangles, signal});
      if (have !== this.#wanted || texels !== this.#texels || !this.frame) {
        const frame =
          await this.terrain.decode({bytes: have, texels, triangles, normals: true, signal});
        if (signal.aborted) return false;
        this.show(frame, {glide: this.#isDrawn(STEADY)});
      }
      this.#wanted = have === bytes || view ? have : bytes;
      this.#texels = texels;
      return have <= here;
    } catch (error) {
      if (this.#stop.signal.aborted) return false;
      this.#stop.abort();
      this.dispatchEvent({type: 'error', error});
      return false;
    }
  }

  /** Whether pictures follow each other within so many ms: what moves will get where it goes. */
  #isDrawn(ms) {
    const [last, before] = this.#updated;
    return performance.now() - last < ms && last - before < ms;
  }

  dispose() {
    this.#stop.abort();
    this.geometry.dispose();
    this.#map?.dispose();
    this.#upload?.texture.dispose();
    this.#upload = null;
    this.material.dispose();
    this.terrain.dispose();
  }
}
