// SPDX-License-Identifier: Apache-2.0
// A least-squares fit overshoots beside cliffs and shores: vertices of few triangles would lie
// below a sea that is flat, or above the summit.
#pragma once

#include <vector>

#include "codec/mesh/surface/weighted_surface.hpp"

namespace tetrakis::inline fitting {

/// Heights of vertices, none of them beyond those of the known samples.
std::vector<double> withinRange(const WeightedSurface& surface, std::vector<double> heights);

}  // namespace tetrakis::inline fitting
