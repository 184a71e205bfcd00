// SPDX-License-Identifier: Apache-2.0
// The part of a mesh that a camera sees.
#pragma once

#include <array>
#include <cstdint>

#include "tools/report/scene.hpp"

namespace tetrakis::tools {

/// Clip coordinates of (column, row, height, 1) for tks_view_mesh: row by row, the third row zero.
std::array<double, 16> clipOf(const Camera& camera, const GroundFrame& frame);

/// The mesh of a decoded surface, coded or of at most `triangles` triangles (0: every sample), as
/// far as the one chosen camera sees it. TKS_USAGE for several cameras, or if no ground is in view.
Result<Mesh> viewedMesh(Decoder& decoder, bool coded, uint32_t triangles,
                        const CameraChoice& choice);

}  // namespace tetrakis::tools
