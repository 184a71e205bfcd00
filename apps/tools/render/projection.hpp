// SPDX-License-Identifier: Apache-2.0
// projectionOf() makes the matrix from space to the clip coordinates of a camera.
#pragma once

#include <array>

#include "apps/tools/render/render.hpp"

namespace tetrakis::tools {

/// View and perspective in one matrix, column by column (OpenGL clip space). The depth range fits
/// the box of what is drawn as seen from this camera.
std::array<float, 16> projectionOf(const Camera& camera, const Bounds& box);

}  // namespace tetrakis::tools
