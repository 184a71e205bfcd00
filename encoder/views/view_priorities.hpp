// SPDX-License-Identifier: Apache-2.0
// What the cameras of the options look at, as maps of priorities over the ground: where an error of
// the heights or of the texture changes their pictures most, coefficients come first.
#pragma once

#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline views {

/// Maps without tiles where there are no cameras, where only one component is coded, or where the
/// target is one of all samples alike (a PSNR, a largest error).
ViewPriorities prioritiesOf(const EncodeInputs& inputs);

}  // namespace tetrakis::inline views
