// SPDX-License-Identifier: Apache-2.0
import type {Mesh} from '@loaders.gl/schema';
import type {LoaderWithParser} from '@loaders.gl/loader-utils';
import type {Frame, OpenOptions, Placing, Raster} from './index.js';

export {TksError} from './index.js';

export interface PlaceOptions extends Placing {
  /** Longitude and latitude that positions count from: the `getPosition` of a SimpleMeshLayer.
   * Float32 degrees are up to 1.7 m coarse far from it. Default [0, 0], as TerrainLayer wants. */
  origin?: [number, number];
}

export interface TksLoaderOptions {
  tks?: PlaceOptions & {
    /** As of decode(): the mesh has at most so many. Default 20000. */
    triangles?: number;
    /** Use no more than the first bytes of the stream. Default: all. */
    bytes?: number;
    /** Longest side of the texture, by the mip levels of the stream. Default 4096. */
    texels?: number;
    /** A Worker itself would serve one mesh alone. */
    decoder?: Pick<OpenOptions, 'wasm' | 'memory'> & {worker?: boolean | string | URL};
  };
  /** Of TerrainLayer, whose `bounds` hold where `tks` has none. */
  terrain?: {bounds?: [number, number, number, number] | null};
  [loaderId: string]: any;
}

export type TksMesh = Mesh & {texture: ImageData | null};
export interface TksBatch {
  batchType: 'data';
  shape: 'mesh';
  data: TksMesh;
  length: 1;
  bytesUsed: number;
}

/** Positions: longitude and latitude less the origin, metres; metres around the middle, z up, of
 * streams that say no place, by groundScale(): 30 m between samples where that is unknown, too.
 * parseInBatches gives a mesh of each fourfold prefix. */
export const TksLoader: LoaderWithParser<TksMesh, TksBatch, TksLoaderOptions>;

/** Mesh and image of a frame of refine() or decode(), for SimpleMeshLayer. */
export function meshOf(frame: Frame, options?: PlaceOptions): Mesh;
export function imageOf(raster: Raster<Uint8ClampedArray>): ImageData;
