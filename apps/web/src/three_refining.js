// SPDX-License-Identifier: Apache-2.0
// A mesh in a scene of three.js that shows frames of a stream, and fetches more where a camera sees
// the difference: what terrains and objects have in common.
import {
  Box3, BufferGeometry, MathUtils, Matrix4, Mesh, MeshBasicMaterial, MeshMatcapMaterial, Vector3,
} from 'three';

import {FIRST_FRAME, GROWTH} from './pace.js';
import {Turns} from './three_turns.js';
import {Upload, isSliced} from './three_upload.js';
import {isDrawable} from './view.js';

/** A photograph holds its light already; heights alone are shaded by how they face the camera. */
const unlit = ({hasTexture}) => (hasTexture ? new MeshBasicMaterial() : new MeshMatcapMaterial());

/** What is asked for at a time where the camera may move meanwhile: as much as is there, within. */
const LEAST_STEP = 2 ** 16, MOST_STEP = 2 ** 20;
/** What error of a texture is seen where a texel fills a pixel. */
export const GOOD_PSNR = 40;

/** Milliseconds between calls of update() by which a page is taken to draw all the time, and to
 * draw on, however slowly. */
const STEADY = 100, SLOW = 1000;
/** So long behind a frame that was played update() takes it that no other follows. */
const PLAYED = 300;

/** What a camera sees of a mesh: its picture, and from coordinates that `own` takes to those of the
 * mesh, by default these themselves, to those of the picture. */
export function viewThrough(camera, viewportHeight, mesh, own = new Matrix4()) {
  camera.updateMatrixWorld();
  mesh.updateWorldMatrix(true, false);
  const clip = own.premultiply(mesh.matrixWorld).premultiply(camera.matrixWorldInverse)
    .premultiply(camera.projectionMatrix).transpose().toArray();
  const {elements} = camera.projectionMatrix;
  const across = Math.max(1, (viewportHeight * elements[5]) / elements[0]);
  return {clip, width: across, height: viewportHeight};
}

/**
 * Those that extend it have draw(frame, {glide}), which shows the parts of a frame, and
 * needs(camera, viewportHeight, texels), which says of the frame that is shown whether this camera
 * sees that bytes are missing, and the longest side of a texture for it; texels: that of the one
 * that is shown, 0: it is rough.
 */
export class RefiningMesh extends Mesh {
  #reading = null;
  #stop = new AbortController();
  #box = new Box3();
  #eye = new Vector3();
  #wanted = 0;
  #texels = Infinity;
  #map = null;  // of its own
  #upload = null;  // of the next one
  #turns = new Turns();
  #playedAt = -Infinity;
  #renderer = null;  // that drew last
  #served = '';  // the view for which all is here
  #updated = [-Infinity, -Infinity];  // when update() was called last, and before that

  /** `terrain`: of open(). It is disposed with this mesh, as its material is. */
  constructor(terrain, {triangles = 20000, bytes = Infinity, pixelError = 1, material} = {}) {
    super(new BufferGeometry(), material ?? unlit(terrain.info));
    this.terrain = terrain;
    this.triangles = triangles;
    this.bytes = bytes;
    this.pixelError = pixelError;
    this.frame = null;
    this.number = terrain.firstFrame;
    if (terrain.info.hasTexture && !terrain.info.textureOpaque) this.material.alphaTest = 0.5;
  }
  /** Whether bytes are fetched for views. */
  get isPlanned() {
    return this.terrain.info.hasIndex;
  }

  /** Whether frames of more bytes have the mesh that is shown. */
  get hasFinalMesh() {
    return false;
  }

  /** Shows what opening brought. */
  async begin() {
    const most = this.terrain.info.objectTriangles ? Infinity : FIRST_FRAME.triangles;
    const triangles = Math.min(most, this.triangles);
    this.show(await this.terrain.decode(
      {...FIRST_FRAME, frame: this.number, bytes: this.#firstBytes(), triangles, normals: true}));
  }

  /** Draws a frame of `terrain`. Parts that it lacks stay as they are. */
  show(frame, options = {}) {
    this.draw(frame, options);
    this.tell(frame);
  }
  tell(frame) {
    this.number = frame.number;
    this.frame = {...this.frame, ...frame};
    this.dispatchEvent({type: 'frame', frame});
  }
  /** The same of a frame that was played, which has no mesh. update() refines it, without fewer
   * bytes, where no other one follows soon. */
  tellPlayed(frame) {
    this.#playedAt = performance.now();
    [this.#wanted, this.#texels, this.#served] = [frame.bytes, 0, ''];
    this.tell({...frame, mesh: undefined});
  }
  setGeometry(geometry) {
    this.geometry.dispose();
    this.geometry = geometry;
  }

  onBeforeRender(renderer) {
    this.#renderer = renderer;
  }
  /** Shows a texture, and calls `shown`: at once, or once update() has brought the slices of a
   * large one. */
  take(texture, shown = () => {}) {
    this.#discard(this.#upload?.texture);
    this.#upload = null;
    const show = () => {
      this.#upload = null;
      this.setMap(texture);
      shown();
    };
    if (!isSliced(texture, this.#renderer) || !this.#isDrawn(SLOW)) return show();
    this.#upload = new Upload(texture, show);
    this.#awaitUpdates(this.#upload);
  }
  /** Shows texels of a frame that is played, in a texture that is here already. They are left out
   * while slices of one before are still on their way. */
  takeTurn(raster) {
    if (!this.#upload) this.take(this.#turns.next(raster, this.#map));
  }
  #discard(texture) {
    if (texture && !this.#turns.has(texture)) texture.dispose();
  }
  /** Of a page that does not call update() any more the rest comes at once. */
  #awaitUpdates(upload) {
    setTimeout(() => {
      if (this.#upload !== upload) return;
      if (this.#isDrawn(SLOW)) return this.#awaitUpdates(upload);
      upload.show();
      this.dispatchEvent({type: 'frame', frame: this.frame});
    }, SLOW);
  }

  setMap(texture) {
    this.#discard(this.#map);
    this.#map = texture;
    if (!this.material.map) this.material.needsUpdate = true;
    this.material.map = texture;
  }

  /** Pixels of a unit of this mesh where the camera is nearest, on the axis that is scaled most. */
  pixelsPerUnit(camera, viewportHeight) {
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

  /** What this camera looks at. */
  viewOf(camera, viewportHeight, own) {
    return viewThrough(camera, viewportHeight, this, own);
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
    this.#upload?.step(this.#renderer);
    if (this.#reading || this.#stop.signal.aborted) return;
    if (performance.now() - this.#playedAt < PLAYED) return;
    const {info, fileBytes} = this.terrain;
    const limit = Math.min(this.bytes, info.streamBytes, fileBytes);
    const seen = this.viewOf(camera, viewportHeight);
    if (!isDrawable(seen)) return;
    const view = this.frame && this.isPlanned ? seen : null;
    const key = view ? view.clip.map((v) => v.toPrecision(6)).join() : '';
    let bytes = this.#firstBytes(), {texels} = FIRST_FRAME;
    if (this.frame) {
      const needs = this.needs(camera, viewportHeight, this.#wanted ? this.#texels : 0);
      const more = view ? key !== this.#served : needs.more;
      bytes = this.#nextBytes(more, view, limit);
      texels = needs.texels;
      if (bytes === this.#wanted && texels === this.#texels) return;
    }
    this.#reading = this.#read(bytes, texels, view).then((isServed) => {
      if (isServed) this.#served = key;
    }).finally(() => (this.#reading = null));
  }
  /** Whether no byte came: where only fewer came than were asked for, others still help a view. */
  async #read(bytes, texels, view) {
    try {
      const {triangles, number} = this, {signal} = this.#stop, here = this.terrain.loaded.bytes;
      const have = await this.terrain.load(bytes, {frame: number, view, triangles, signal});
      if (have !== this.#wanted || texels !== this.#texels || !this.frame) {
        const mesh = !this.hasFinalMesh;
        const frame = await this.terrain.decode(
          {frame: number, bytes: have, texels, triangles, mesh, normals: true, signal});
        if (signal.aborted || number !== this.number) return false;
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
    this.#turns.dispose();
    this.material.dispose();
    this.terrain.dispose();
  }
}
