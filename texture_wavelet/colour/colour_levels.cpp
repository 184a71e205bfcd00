// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour/colour_levels.hpp"

#include <array>
#include <cassert>

namespace tetrakis::inline colour {

void forwardColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<int32_t* const> planes) {
  if (planes.size() < 3) return;
  for (const Subband& subband : pyramid.subbands()) {
    for (uint32_t row = 0; row < subband.height; ++row) {
      const size_t first = pyramid.indexOf(subband, row);
      const std::array<int32_t*, 3> rows = {planes[0] + first, planes[1] + first,
                                            planes[2] + first};
      forwardLevelColour(transform, subband.level, rows, subband.width);
    }
  }
}

void inverseColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<ViewSynthesis> planes) {
  if (planes.size() < 3) return;
  for (const Subband& subband : pyramid.subbands()) {
    const uint32_t count = planes.front().rows(subband);
    for (uint32_t row = 0; row < count; ++row) {
      const std::span<int32_t> first = planes[0].row(subband, row);
      const std::array<int32_t*, 3> rows = {first.data(), planes[1].row(subband, row).data(),
                                            planes[2].row(subband, row).data()};
      assert(planes[1].row(subband, row).size() == first.size());
      inverseLevelColour(transform, subband.level, rows, first.size());
    }
  }
}

}  // namespace tetrakis::inline colour
