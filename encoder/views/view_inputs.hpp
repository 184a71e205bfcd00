// SPDX-License-Identifier: Apache-2.0
// frameOf(), reliefOf() and camerasOf() translate the caller's heights and cameras for rate
// control, which works in metres on the ground.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/ground/camera.hpp"
#include "codec/ground/frame.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline views {

/// A unit that is no length counts as metres.
GroundFrame frameOf(const tks_heights& heights);

/// samples: of the type and size of `like`. valid: as findVoids() has it.
Relief reliefOf(const tks_heights& like, const void* samples, const std::vector<uint8_t>& valid);

/// Pixels that are looked at, of all pictures together. With two thirds of them a mean loss of
/// 0.015 dB becomes 0.040; more of them take time.
inline constexpr size_t kViewPixels = 3072;

std::vector<Camera> givenCameras(const tks_encode_options& options);

/// The given cameras, or those of a viewer of whom nothing is known; none if the terrain has no
/// bounds.
std::vector<Camera> camerasOf(const tks_encode_options& options, const Bounds& bounds);

}  // namespace tetrakis::inline views
