// SPDX-License-Identifier: Apache-2.0
// SurfaceView is a height field, with weights if there are any, whose samples the caller owns.
#pragma once

#include <cstdint>
#include <span>

namespace tetrakis::inline surface {

/// heights: width * height values, row by row; any int32. Sizes from 2 x 2.
struct SurfaceView {
  uint32_t width = 0, height = 0;
  std::span<const int32_t> heights;
  /// What a squared error at each sample counts (view, texture), finite and not negative; empty: 1.
  std::span<const float> weights = {};

  double weightOf(size_t sample) const {
    return weights.empty() ? 1.0 : static_cast<double>(weights[sample]);
  }
};

}  // namespace tetrakis::inline surface
