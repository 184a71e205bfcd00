// SPDX-License-Identifier: Apache-2.0
import type {
  Credit, Event, ImageryProvider, Rectangle, Scene, TerrainData, TerrainProvider, TileAvailability,
  TilingScheme,
} from '@cesium/engine';
import type {OpenOptions, Placing, Terrain} from './index.js';

export {TksError} from './index.js';

export interface TksTerrainProviderOptions extends OpenOptions, Placing {
  /** Metres that are added to heights: Cesium's count from the ellipsoid, those of most streams
   * from the sea, which lies between 107 m below the ellipsoid and 86 m above it. Default 0. */
  heightOffset?: number;
  credit?: Credit | string;
}

/** Heights of a stream; 0 in voids and around it. Tiles outside of it are not available. */
export class TksTerrainProvider implements TerrainProvider {
  /** Rejected where the stream says no place that this package knows, without `bounds` and
   * `project`. */
  static fromUrl(input: string | URL | ArrayBuffer | ArrayBufferView | Blob,
    options?: TksTerrainProviderOptions): Promise<TksTerrainProvider>;
  private constructor();
  readonly terrain: Terrain;
  /** Its texture, for scene.imageryLayers.addImageryProvider(); undefined where it has none. */
  readonly imagery: ImageryProvider | undefined;
  readonly rectangle: Rectangle;
  readonly availability: TileAvailability;
  readonly tilingScheme: TilingScheme;
  readonly errorEvent: Event;
  readonly credit: Credit;
  readonly hasWaterMask: boolean;
  readonly hasVertexNormals: boolean;
  getLevelMaximumGeometricError(level: number): number;
  getTileDataAvailable(x: number, y: number, level: number): boolean;
  loadTileDataAvailability(x: number, y: number, level: number): undefined;
  requestTileGeometry(x: number, y: number, level: number): Promise<TerrainData>;
  /** Fetches on, fourfold each time up to `bytes`, and has the scene take the tiles of its heights
   * and imagery anew: after it `scene.terrainProvider` is another provider of the same stream. */
  refine(scene: Scene, options?: {bytes?: number; signal?: AbortSignal}): Promise<void>;
  dispose(): void;
}
