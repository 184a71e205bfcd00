// SPDX-License-Identifier: Apache-2.0
// camerasOf(), checkCameras() and prioritiesOf() take the caller's heights and cameras and return
// the cameras in metres on the ground, the refusal of cameras that see nothing, and the maps of the
// coefficients that come first because the cameras see most of them.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/ground/camera.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline views {

// frameOf(), reliefOf() and camerasOf() translate the caller's heights and cameras for rate
// control, which works in metres on the ground.

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

// checkCameras() refuses cameras of the options through which nothing can be seen, before any other
// function looks through them.

/// TKS_USAGE with a sentence that names the camera, if one of the options is none
/// (checkCamera()), is below the ground, or sees none of it; or if all weights are 0.
Status checkCameras(const EncodeInputs& inputs);

// viewPriorities() makes maps of priorities over the ground from the cameras of the options: where an
// error of the heights or of the texture changes the pictures most, coefficients come first. Some
// ten thousand points of the pictures tell the cost of errors. A tile of texels where a squared
// error costs four times as much has one priority more, which is one bit-plane; a tile of heights,
// where it costs sixteen times as much, because the cost of a typical error does not hold for all
// errors.

/// The maps have no tiles if there are no cameras. inputs: both components.
Priorities viewPriorities(const EncodeInputs& inputs);

}  // namespace tetrakis::inline views
