// SPDX-License-Identifier: Apache-2.0
// Encoders choose here which flat areas are worth their shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/flat_areas.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis::inline geometry {

/// Areas and their codeword; both are empty if none pays.
struct FlatLayer {
  FlatAreas areas;
  std::vector<uint8_t> codeword;
};

/// heights: in steps, of so many bits.
FlatLayer chooseFlatAreas(const PlaneView<const int32_t>& heights, int bits, Purpose purpose);

}  // namespace tetrakis::inline geometry
