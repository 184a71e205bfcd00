// SPDX-License-Identifier: Apache-2.0
// prioritiesOf() makes maps of priorities over the ground from the cameras of the options: where an
// error of the heights or of the texture changes the pictures most, coefficients come first. Some
// ten thousand points of the pictures tell the cost of errors. A tile of texels where a squared
// error costs four times as much has one priority more, which is one bit-plane; a tile of heights,
// where it costs sixteen times as much, because the cost of a typical error does not hold for all
// errors.
#pragma once

#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline views {

/// The maps have no tiles if there are no cameras, if only one component is coded, or if the target
/// counts all samples alike (a PSNR, a largest error).
ViewPriorities prioritiesOf(const EncodeInputs& inputs);

}  // namespace tetrakis::inline views
