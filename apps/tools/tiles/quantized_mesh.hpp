// SPDX-License-Identifier: Apache-2.0
// encodeQuantizedMesh() writes tiles in the format quantized-mesh-1.0 of Cesium, with the
// extensions octvertexnormals and metadata. Source: github.com/CesiumGS/quantized-mesh.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/tools/tiles/terrain_level.hpp"

namespace tetrakis::tools {

/// Of all tiles of a set: with one range for all, heights on shared edges come out the same.
struct HeightRange {
  float lowest = 0, highest = 0;  ///< metres
};

/// metadata: JSON of the extension of that name; empty: none. A file of its own, uncompressed.
std::vector<std::byte> encodeQuantizedMesh(const TileMesh& mesh, const GeographicTile& tile,
                                           const HeightRange& range, const std::string& metadata);

}  // namespace tetrakis::tools
