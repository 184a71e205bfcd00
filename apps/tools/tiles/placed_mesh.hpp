// SPDX-License-Identifier: Apache-2.0
// place() puts the mesh of a tile into space: in the axes of the Earth (EPSG:4978), above the
// ellipsoid WGS 84.
#pragma once

#include <array>
#include <vector>

#include "apps/tools/tiles/geographic_tile.hpp"
#include "apps/tools/tiles/terrain_level.hpp"

namespace tetrakis::tools {

inline constexpr double kSemiMajor = 6378137.0, kFlat = 1 / 298.257223563;
inline constexpr double kSemiMinor = kSemiMajor * (1 - kFlat);

using Vector = std::array<double, 3>;

struct Placed {
  std::vector<Vector> positions, normals;
};

Placed place(const TileMesh& mesh, const GeographicTile& tile);

}  // namespace tetrakis::tools
