// SPDX-License-Identifier: Apache-2.0
// writeTerrainTiles() writes a stream as a folder of terrain tiles that Cesium reads from any
// static host.
#pragma once

#include <functional>
#include <string>

#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

struct TileSetSize {
  uint64_t tiles = 0, bytes = 0;
  uint64_t pictures = 0;            ///< tiles of imagery
  uint32_t first = 0, deepest = 0;  ///< levels
};

enum class TileFormat { kQuantizedMesh, k3dTiles };

struct TileOptions {
  TileFormat format = TileFormat::kQuantizedMesh;
  bool skirts = false;  ///< walls below the edges of tiles (k3dTiles)
};

/// Writes tiles into an existing folder, down to the level whose grid is as fine as the samples.
/// Level by level each height is within half of what Cesium takes a level's error for, of the mip
/// level that is shown.
/// kQuantizedMesh: layer.json and LEVEL/X/Y.terrain (quantized-mesh-1.0), from the two tiles of
/// level 0 on, and the texture as imagery/ (writeImagery). k3dTiles: tileset.json (3D Tiles 1.1)
/// and LEVEL/X/Y.glb, of the ground alone and textured, from the deepest level of at most four
/// tiles on.
/// progress: done so far, in [0, 1]. Errors: those of EarthGround; TKS_LIMIT; TKS_IO.
Result<TileSetSize> writeTerrainTiles(Decoder& decoder, const TileOptions& options,
                                      const std::string& folder,
                                      const std::function<void(double)>& progress);

}  // namespace tetrakis::tools
