// SPDX-License-Identifier: Apache-2.0
import type {
  BufferGeometry, Camera, DataTexture, Loader, Material, Mesh, Object3DEventMap,
  OrthographicCamera, PerspectiveCamera, Vector3,
} from 'three';
import type {Frame, FrameOptions, OpenOptions, Raster, Terrain, TksError, View} from './index.js';

export interface TerrainOptions {
  /** As of decode(): the mesh has at most so many. Default 20000. */
  triangles?: number;
  /** Fetches no more than so many bytes. Default: all that the camera needs. */
  bytes?: number;
  /** Heights are refined until their error is seen as so many pixels. Default 1. */
  pixelError?: number;
  /** Milliseconds in which the surface moves from one frame to the next, where update() is called
   * for each picture. Default 300; 0: it jumps. */
  glideTime?: number;
  /** Longest side of the grid of heights that frames of a sequence are drawn with while they play.
   * Default 512. */
  samples?: number;
  /** Default: one that needs no lights, as a photograph holds its own; of an object with maps of
   * its material (normals, roughness, …) a MeshStandardMaterial, which needs some. Give a
   * MeshLambertMaterial or MeshStandardMaterial for your lights: maps and factors of a stream are
   * set in those slots that it has. A TksTerrain draws its texture with it and disposes it, so that
   * it serves no other one; a TksLoader gives each terrain a copy. */
  material?: Material;
}

export type ObjectOptions = Omit<TerrainOptions, 'glideTime' | 'samples'>;

export interface TksTerrainEventMap extends Object3DEventMap {
  frame: {frame: Frame};
  error: {error: TksError};
}

/** What terrains and objects have in common. */
declare class RefiningMesh extends Mesh<BufferGeometry, Material, TksTerrainEventMap> {
  readonly terrain: Terrain;
  readonly frame: Frame | null;
  /** Of the frame that is shown, or is about to be: update() refines this one. */
  number: number;
  triangles: number;
  bytes: number;
  pixelError: number;
  /** Shows what opening brought: the first frame. */
  begin(): Promise<void>;
  /** Draws a frame of `terrain`; parts that it lacks stay as they are. Event: `frame`. `glide`: the
   * surface of a terrain moves there from where it is, as long as glide() is called for each
   * picture. */
  show(frame: Frame, options?: {glide?: boolean}): void;
  /** To be called for each picture: fetches and decodes more where this camera sees the difference,
   * of a terrain with an index what helps this view most. `viewportHeight` in pixels; where it is
   * 0, or the camera is nowhere, nothing happens. Events: `frame`, and `error`, after which nothing
   * is fetched. */
  update(camera: Camera, viewportHeight: number): void;
  /** Puts a camera so that all fills its picture, with near and far planes for it. It looks along
   * `direction`, by default at a terrain from the south and above, at an object from the front
   * (z), a little above. Gives the middle: the target of OrbitControls. */
  fit(camera: PerspectiveCamera | OrthographicCamera, direction?: Vector3): Vector3;
  dispose(): void;
}

/** x to the east, y up, z to the south, of streams without a place along the rows and down the
 * columns; metres, by groundScale(), for which samples of unknown spacing lie 30 m apart; the
 * middle of the terrain at x = z = 0. */
export class TksTerrain extends RefiningMesh {
  constructor(terrain: Terrain, options?: TerrainOptions);
  glideTime: number;
  samples: number;
  /** Fetches and plays a frame of a sequence or of a stream of several: the heights of a grid, and
   * the texels, change in the buffers of the frame before. Resolves when it is drawn, or another
   * one was asked for. Where no other follows within 300 ms, update() refines it. */
  setFrame(number: number, options?: Pick<FrameOptions, 'signal'>): Promise<void>;
  /** What setFrame() does with a frame, which `terrain.decode({...playing, frame})` gives: so one
   * can be made while another is shown. */
  play(frame: Frame): void;
  readonly playing: FrameOptions;
  /** Moves the surface on its way to the frame; update() does so as well. False: it is there. */
  glide(): boolean;
  /** Height of what is drawn at a place of this object: metres, as its vertices have them before
   * the object is moved or scaled. NaN where there is no ground. Takes microseconds, but some ms
   * for the first place of a frame. */
  heightAt(x: number, z: number): number;
  /** What this camera looks at, for `terrain.decode({view})`. */
  viewOf(camera: Camera, viewportHeight: number): View;
}

/** A scan, a sculpture, a designed part (info.isObject), in the coordinates and the unit of the
 * mesh that was encoded, less `centre`. */
export class TksObject extends RefiningMesh {
  constructor(terrain: Terrain, options?: ObjectOptions);
  /** (0, 0, 0) of what has the origin in its box. Set `position` to it where an object shall lie
   * beside others of the same coordinates. */
  readonly centre: Vector3;
  /** Called once the stream is known to have maps of a material: what takes the place of the
   * material, by default a MeshStandardMaterial where you gave none; null: nothing. */
  litMaterial(): Material | null;
}

/** Gives a TksTerrain, or a TksObject of a stream that holds an object. */
export class TksLoader<Kind extends TksTerrain | TksObject = TksTerrain> extends Loader<Kind> {
  /** Ends what preload() started. A Worker serves one terrain: for more give its address. */
  setDecoderOptions(
    options: Pick<OpenOptions, 'worker' | 'wasm' | 'memory' | 'requestBytes'>): this;
  setTerrainOptions(options: TerrainOptions): this;
  /** Fetches the decoder and starts its worker, which the next terrain takes. */
  preload(): this;
  /** Ends what preload() started and nothing has taken. Terrains are disposed one by one. */
  dispose(): this;
  /** Ends what is being loaded. */
  abort(): this;
  /** As load(), of bytes. */
  parse(buffer: ArrayBuffer, onLoad: (terrain: Kind) => void,
    onError?: (error: unknown) => void): void;
  parseAsync(buffer: ArrayBuffer): Promise<Kind>;
}

/** What TksLoader decodes before it gives a terrain, and what it fails with. */
export {FIRST_FRAME, TksError} from './index.js';

export function textureOf(raster: Raster<Uint8ClampedArray>): DataTexture;
