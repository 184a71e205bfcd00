// SPDX-License-Identifier: Apache-2.0
// Squared error of a triangle with any corners on the grid: the shapes that clamping makes.
#pragma once

#include <array>

#include "codec/lattice.hpp"
#include "codec/surface_view.hpp"

namespace tetrakis {

/// Sum of squared residuals against the plane through the corners, weighted as in moments.hpp. The
/// corners are samples; the triangle has an area. Visits the samples of its bounding box.
double clampedEnergy(const SurfaceView& surface, const std::array<GridPoint, 3>& corners);

}  // namespace tetrakis
