// SPDX-License-Identifier: Apache-2.0
// encodeValidity() encodes the mask of the valid samples of a plane as a codeword.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline lattice {

/// Returns the codeword of a mask, which has one byte or more. valid: 1 where a sample is valid, 0
/// where it is void. The whole codeword gives the mask back whatever bytes follow it.
std::vector<uint8_t> encodeValidity(const PlaneView<const uint8_t>& valid);

/// The same of a mask that comes late. lifted: marks at least the valid samples.
std::vector<uint8_t> encodeLateValidity(const PlaneView<const uint8_t>& valid, Mask lifted);

}  // namespace tetrakis::inline lattice
