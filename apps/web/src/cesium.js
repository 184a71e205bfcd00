// SPDX-License-Identifier: Apache-2.0
// Cesium: a terrain provider, and an imagery provider for the texture, which cut tiles of the
// geographic tiling scheme out of a stream.
import {
  Credit, Event, GeographicTilingScheme, HeightmapTerrainData, Rectangle, TerrainProvider,
  TileAvailability, TileProviderError,
} from '@cesium/engine';

import {Cutter} from './cut.js';
import {TksError, open} from './index.js';
import {boxOf, checkGround, spansOf} from './place.js';

export {TksError};

/** Heights of a tile along a side; its outer ones are those of its neighbours. */
const SIDE = 65;
const TEXELS = 256;
/** Degrees of a tile of level 0. */
const LEVEL_0 = 180;
/** The finest level of a TileAvailability, whose numbers of tiles are 32-bit integers. */
const MOST_LEVEL = 28;

/** Longitudes and latitudes of a tile: `count` a side, the first `first` steps from its corner. */
function placesOf({x, y, level}, count, first) {
  const side = LEVEL_0 / 2 ** level, step = side / (count - 1 + 2 * first);
  const steps = Array.from({length: count}, (_, i) => (i + first) * step);
  return {
    longitudes: steps.map((away) => x * side - 180 + away),
    latitudes: steps.map((away) => 90 - y * side - away),
  };
}

/** What providers of one stream have in common. */
class Shared {
  tilingScheme = new GeographicTilingScheme();
  heightErrors = new Event();
  imageryErrors = new Event();

  constructor(terrain, {bounds, project, heightOffset = 0, credit}) {
    this.terrain = terrain;
    this.cutter = new Cutter(terrain, {bounds, project});
    this.heightOffset = heightOffset;
    this.credit = typeof credit === 'string' ? new Credit(credit) : credit;
  }
  rectangle(part) {
    return Rectangle.fromDegrees(...boxOf(this.cutter.place(part).bounds));
  }
  /** All tiles down to where they are as fine as the samples. */
  availability() {
    const {bounds} = this.cutter.place('heights'), [, south, , north] = bounds;
    const finest = Math.min(MOST_LEVEL, this.cutter.finest('heights', LEVEL_0 / (SIDE - 1)));
    const all = new TileAvailability(this.tilingScheme, finest);
    all.addAvailableTileRange(0, 0, 0, 1, 0);
    for (let level = 1; level <= finest; ++level) {
      const tile = (degrees, most) =>
        Math.min(Math.max(Math.floor((degrees * 2 ** level) / LEVEL_0), 0), most * 2 ** level - 1);
      for (const [west, east] of spansOf(bounds)) {
        all.addAvailableTileRange(level, tile(west + 180, 2), tile(90 - north, 1),
          tile(east + 180, 2), tile(90 - south, 1));
      }
    }
    return all;
  }
}

/** The promise; a failure is told to the provider's errorEvent as well. */
function reported(promise, provider, {x, y, level}) {
  return promise.catch((error) => {
    TileProviderError.reportError(undefined, provider, provider.errorEvent, error.message, x, y,
      level, error);
    throw error;
  });
}

/** The texture of a stream. Made by TksTerrainProvider, as its `imagery`. */
class TksImageryProvider {
  #shared;

  constructor(shared) {
    this.#shared = shared;
    this.rectangle = shared.rectangle('texture');
    this.maximumLevel = Math.min(MOST_LEVEL, shared.cutter.finest('texture', LEVEL_0 / TEXELS));
  }
  minimumLevel = 0;
  tileWidth = TEXELS;
  tileHeight = TEXELS;
  hasAlphaChannel = true;
  tileDiscardPolicy = undefined;
  proxy = undefined;
  get tilingScheme() {
    return this.#shared.tilingScheme;
  }
  get errorEvent() {
    return this.#shared.imageryErrors;
  }
  get credit() {
    return this.#shared.credit;
  }
  getTileCredits() {}
  pickFeatures() {}

  requestImage(x, y, level) {
    const tile = {x, y, level};
    return reported(this.#image(tile), this, tile);
  }
  async #image(tile) {
    const {longitudes, latitudes} = placesOf(tile, TEXELS, 0.5);
    const rgba = await this.#shared.cutter.texels(longitudes, latitudes);
    // WebGL does not turn an ImageBitmap over, so Cesium wants them upside down.
    return createImageBitmap(new ImageData(rgba, TEXELS, TEXELS),
      {imageOrientation: 'flipY', premultiplyAlpha: 'none', colorSpaceConversion: 'none'});
  }
}

/** Made by fromUrl(); for scene.terrainProvider. */
export class TksTerrainProvider {
  #shared;

  /** `shared`: of fromUrl(). */
  constructor(shared) {
    this.#shared = shared;
    this.availability = shared.availability();
    this.imagery = shared.imagery;
  }

  /** Opens a URL, bytes or a Blob. Options: bounds, project, heightOffset, credit, and those of
   * open(). */
  static async fromUrl(input, {bounds, project, heightOffset, credit, ...options} = {}) {
    const terrain = await open(input, options);
    try {
      const {info} = terrain;
      checkGround(info);
      if (!info.hasHeights) throw new TksError('usage', 'This stream is an image without heights.');
      const shared = new Shared(terrain, {bounds, project, heightOffset, credit});
      if (info.hasTexture) shared.imagery = new TksImageryProvider(shared);
      return new TksTerrainProvider(shared);
    } catch (error) {
      terrain.dispose();
      throw error;
    }
  }

  hasWaterMask = false;
  hasVertexNormals = false;
  get terrain() {
    return this.#shared.terrain;
  }
  get tilingScheme() {
    return this.#shared.tilingScheme;
  }
  get errorEvent() {
    return this.#shared.heightErrors;
  }
  get credit() {
    return this.#shared.credit;
  }
  get rectangle() {
    return this.#shared.rectangle('heights');
  }

  getLevelMaximumGeometricError(level) {
    const {ellipsoid} = this.tilingScheme, tiles = this.tilingScheme.getNumberOfXTilesAtLevel(0);
    return TerrainProvider.getEstimatedLevelZeroGeometricErrorForAHeightmap(
      ellipsoid, SIDE, tiles) / 2 ** level;
  }
  getTileDataAvailable(x, y, level) {
    return this.availability.isTileAvailable(level, x, y);
  }
  loadTileDataAvailability() {}

  requestTileGeometry(x, y, level) {
    const tile = {x, y, level};
    return reported(this.#heights(tile), this, tile);
  }
  async #heights(tile) {
    const {longitudes, latitudes} = placesOf(tile, SIDE, 0), {heightOffset} = this.#shared;
    const heights = await this.#shared.cutter.heights(longitudes, latitudes);
    return new HeightmapTerrainData({
      buffer: heights.map((metres) => (Number.isNaN(metres) ? 0 : metres + heightOffset)),
      width: SIDE,
      height: SIDE,
      childTileMask: this.availability.computeChildMaskForTile(tile.level, tile.x, tile.y),
    });
  }

  /** Fetches on, fourfold each time, and has the scene take tiles of this stream anew. */
  async refine(scene, {bytes, signal} = {}) {
    const {terrain, cutter} = this.#shared, layers = scene.imageryLayers;
    for await (const _ of cutter.refine({bytes, signal})) {
      // Globes take all tiles anew for another provider, and for no other reason.
      if (scene.terrainProvider?.terrain === terrain) {
        scene.terrainProvider = new TksTerrainProvider(this.#shared);
      }
      for (let i = 0; i < layers.length; ++i) {
        const layer = layers.get(i);
        if (layer.imageryProvider !== this.imagery) continue;
        layers.remove(layer, false);
        layers.add(layer, i);
      }
    }
  }

  dispose() {
    this.#shared.terrain.dispose();
  }
}
