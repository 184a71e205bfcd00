// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/activity_hints.hpp"

#include <cassert>
#include <cstddef>

namespace tetrakis::inline corrections {

std::vector<uint8_t> activityHints(std::span<const uint8_t> significant, Extent extent) {
  assert(significant.size() == extent.samples());
  const auto [width, height] = extent;
  std::vector<uint8_t> hints(significant.begin(), significant.end());
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const size_t i = size_t{y} * width + x;
      if (x > 0) hints[i] += significant[i - 1];
      if (x + 1 < width) hints[i] += significant[i + 1];
      if (y > 0) hints[i] += significant[i - width];
      if (y + 1 < height) hints[i] += significant[i + width];
    }
  }
  return hints;
}

}  // namespace tetrakis::inline corrections
