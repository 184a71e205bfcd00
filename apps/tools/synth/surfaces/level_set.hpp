// SPDX-License-Identifier: Apache-2.0
// levelSet() gives the surface on which a field in space is zero, as triangles.
#pragma once

#include <functional>

#include "apps/tools/synth/surfaces/shape.hpp"

namespace tetrakis::tools::synth {

/// Less than 0 inside of what it describes.
using Field = std::function<double(const Spot&)>;

/// The cube around the origin in which a surface lies, and into how many cells each side is cut.
struct Cells {
  double half = 1;
  uint32_t side = 0;
};

/// Closed if the field is positive on the border of the cube, and manifold (marching tetrahedra:
/// Doi and Koide 1991); then relaxed, so that triangles are of about one size.
TriangleMesh levelSet(const Field& field, const Cells& cells);

}  // namespace tetrakis::tools::synth
