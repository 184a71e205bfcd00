// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour/colour_levels.hpp"

#include <array>

namespace tetrakis {

namespace {

/// Calls shear(level, planes, count) for every row of every subband.
template <class Shear>
void forEachRow(std::span<const Subband> subbands, std::span<int32_t* const> planes, uint32_t width,
                const Shear& shear) {
  if (planes.size() < 3) return;
  for (const Subband& subband : subbands) {
    for (uint32_t row = 0; row < subband.height; ++row) {
      const size_t first = size_t{subband.planeRow(row)} * width + subband.x;
      const std::array<int32_t*, 3> rows = {planes[0] + first, planes[1] + first,
                                            planes[2] + first};
      shear(subband.level, rows, subband.width);
    }
  }
}

}  // namespace

void forwardColourLevels(const ColourTransform& transform, std::span<const Subband> subbands,
                         int finer_levels, std::span<int32_t* const> planes, uint32_t width) {
  forEachRow(subbands, planes, width, [&](int level, const auto& rows, size_t count) {
    forwardLevelColour(transform, level + finer_levels, rows, count);
  });
}

void inverseColourLevels(const ColourTransform& transform, std::span<const Subband> subbands,
                         int finer_levels, std::span<int32_t* const> planes, uint32_t width) {
  forEachRow(subbands, planes, width, [&](int level, const auto& rows, size_t count) {
    inverseLevelColour(transform, level + finer_levels, rows, count);
  });
}

}  // namespace tetrakis
