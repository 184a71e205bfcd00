// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/placed_mesh.hpp"

#include <cmath>
#include <numbers>

namespace tetrakis::tools {
namespace {

/// East, north and up at a place.
struct Frame {
  Vector east, north, up;
};

Frame frameAt(double longitude, double latitude) {
  constexpr double kRadian = std::numbers::pi / 180;
  const double l = longitude * kRadian, p = latitude * kRadian;
  return {{-std::sin(l), std::cos(l), 0},
          {-std::sin(p) * std::cos(l), -std::sin(p) * std::sin(l), std::cos(p)},
          {std::cos(p) * std::cos(l), std::cos(p) * std::sin(l), std::sin(p)}};
}

/// Above the ellipsoid WGS 84.
Vector onEarth(const Frame& frame, double height) {
  constexpr double kE2 = kFlat * (2 - kFlat);
  const double sine = frame.up[2], normal = kSemiMajor / std::sqrt(1 - kE2 * sine * sine);
  return {(normal + height) * frame.up[0], (normal + height) * frame.up[1],
          (normal * (1 - kE2) + height) * frame.up[2]};
}

}  // namespace

Placed place(const TileMesh& mesh, const GeographicTile& tile) {
  const GeographicBounds bounds = boundsOf(tile);
  const double cell = tileDegrees(tile.level) / kTileCells;
  Placed placed;
  for (const TileMesh::Vertex& v : mesh.vertices) {
    const Frame frame = frameAt(bounds.west + v.column * cell, bounds.south + v.row * cell);
    placed.positions.push_back(onEarth(frame, v.height));
    const double length = std::hypot(v.east, v.north, 1);
    Vector normal;
    for (size_t k = 0; k < 3; ++k)
      normal[k] = (frame.up[k] - v.east * frame.east[k] - v.north * frame.north[k]) / length;
    placed.normals.push_back(normal);
  }
  return placed;
}

}  // namespace tetrakis::tools
