// SPDX-License-Identifier: Apache-2.0
// A least-squares fit overshoots beside cliffs and shores: vertices of few triangles would lie
// below a sea that is flat, or above the summit.
#pragma once

#include <vector>

#include "codec/mesh/surface/weighted_surface.hpp"

namespace tetrakis::inline fitting {

/// No height of a vertex stays beyond those of the known samples.
void keepWithinRange(const WeightedSurface& surface, std::vector<double>& heights);

}  // namespace tetrakis::inline mesh
