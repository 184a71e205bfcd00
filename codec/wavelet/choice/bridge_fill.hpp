// SPDX-License-Identifier: Apache-2.0
// bridged() fills bridged voids (codec/wavelet/bridges.hpp) with a smooth surface through the
// samples around them. Decoders throw these values away, so an encoder is free to choose the ones
// that take the fewest bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline choice {

/// Returns the plane with the voids that are lifted filled smoothly; all other values stay as they
/// are. plane: with the mask of valid samples, which has bytes. Values stay within those of the
/// valid samples.
std::vector<int32_t> bridged(const PlaneView<const int32_t>& plane, Mask lifted);

}  // namespace tetrakis::inline choice
