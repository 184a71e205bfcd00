// SPDX-License-Identifier: Apache-2.0
// checkCameras() refuses cameras of the options through which nothing can be seen, before any other
// function looks through them.
#pragma once

#include "base/status.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline views {

/// TKS_USAGE with a sentence that names the camera, if one of the options is none
/// (checkCamera()), is below the ground, or sees none of it; or if all weights are 0.
Status checkCameras(const EncodeInputs& inputs);

}  // namespace tetrakis::inline views
