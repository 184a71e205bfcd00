// SPDX-License-Identifier: Apache-2.0
// clampedEnergy() sums the squared error of a triangle with any corners on the grid. Clamping makes
// triangles of such shapes, to which the recursion of moments.hpp does not apply.
#pragma once

#include <array>

#include "codec/mesh/surface/surface_view.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline gains {

/// Sum of weighted squared residuals against the plane through the corners, shared as in
/// moments.hpp. The corners are samples; the triangle has an area.
double clampedEnergy(const SurfaceView& surface, const std::array<GridPoint, 3>& corners);

/// The weighted squared residual of one sample, whole; 0 where it lies outside the triangle.
double clampedError(const SurfaceView& surface, const std::array<GridPoint, 3>& corners,
                    GridPoint sample);

}  // namespace tetrakis::inline gains
