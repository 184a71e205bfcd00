// SPDX-License-Identifier: Apache-2.0
import type {
  GetResourceResponse, Map, RasterDEMSourceSpecification, RasterSourceSpecification,
  RequestParameters,
} from 'maplibre-gl';
import type {OpenOptions, Placing, Terrain} from './index.js';

export {TksError} from './index.js';

type Input = string | URL | ArrayBuffer | ArrayBufferView | Blob;

export interface TksMapSource {
  /** For map.addSource(); null where the stream has no such part. */
  readonly heights: RasterDEMSourceSpecification | null;
  readonly texture: RasterSourceSpecification | null;
  readonly terrain: Terrain;
  /** Where the heights lie, or the texture alone, as for map.fitBounds(): west, south, east, north
   * in degrees. */
  readonly bounds: [number, number, number, number];
  /** Fetches on, fourfold each time up to `bytes`, and refreshes the tiles of the sources of this
   * stream that the map has already. Ends when the map is removed.
   * A map that is not idle for 5 s, whose own worker may be missing, is waited for no longer. */
  refine(map: Map, options?: {bytes?: number; signal?: AbortSignal}): Promise<void>;
  /** RGBA of 256 x 256 pixels; null where a texture does not reach. Heights go on beside the
   * ground, and in its voids, as those of its border. */
  render(part: 'heights' | 'texture', tile: {z: number; x: number; y: number}):
    Promise<Uint8ClampedArray | null>;
  dispose(): void;
}

export class TksProtocol {
  /** For maplibregl.addProtocol('tks', protocol.tile). */
  readonly tile: (request: RequestParameters, stop: AbortController) =>
    Promise<GetResourceResponse<ImageBitmap | ArrayBuffer>>;
  /** The name is taken from the beginning of the call. */
  add(
    name: string, input: Input, options?: OpenOptions & Placing,
  ): Promise<TksMapSource>;
  /** Disposes the stream, or ends its opening. */
  remove(name: string): void;
}
