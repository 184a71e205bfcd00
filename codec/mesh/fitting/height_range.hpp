// SPDX-License-Identifier: Apache-2.0
// withinRange() limits fitted heights to the range of the known samples, because a least-squares
// fit overshoots beside cliffs and shores: vertices of few triangles would lie below a flat sea, or
// above the summit.
#pragma once

#include <vector>

#include "codec/mesh/surface/weighted_surface.hpp"

namespace tetrakis::inline fitting {

/// Heights of vertices, none of them beyond those of the known samples.
std::vector<double> withinRange(const WeightedSurface& surface, std::vector<double> heights);

}  // namespace tetrakis::inline fitting
