// SPDX-License-Identifier: Apache-2.0
// momentsOf() and squaredErrorOf() compare the samples in one triangle with the plane through any
// heights at its corners.
#pragma once

#include <array>

#include "codec/mesh/gains/moments.hpp"
#include "codec/mesh/surface/weighted_surface.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline fitting {

/// A triangle between samples of a surface, at heights of one's choice. It has an area.
struct HeldTriangle {
  std::array<GridPoint, 3> corners;
  std::array<double, 3> heights;
};

/// Returns the moments (gains/moments.hpp) of the samples in the triangle but those at its corners,
/// which stand apart. Samples on an edge count half, on the border of the grid fully.
TriangleMoments momentsOf(const WeightedSurface& surface, const HeldTriangle& triangle);

/// The energy of momentsOf() alone.
double squaredErrorOf(const WeightedSurface& surface, const HeldTriangle& triangle);

/// A sample in a triangle: its barycentric coordinates and what it lies above the plane.
struct WeighedSample {
  double weight, a, b, p, residual;
};

void add(TriangleMoments& moments, const WeighedSample& sample);

/// Whether the edge lies on the border of the grid.
bool onBorder(const SurfaceView& grid, GridPoint from, GridPoint to);

}  // namespace tetrakis::inline fitting
