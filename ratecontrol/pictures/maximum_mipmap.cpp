// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/maximum_mipmap.hpp"

#include <cassert>
#include <limits>

namespace tetrakis::inline pictures {

namespace {

constexpr float kLowest = -std::numeric_limits<float>::infinity();

/// A comparison with NaN is false: voids raise nothing.
float raised(float highest, float height) {
  return height > highest ? height : highest;
}

}  // namespace

MaximumMipmap::Level MaximumMipmap::cellsOf(const std::vector<float>& heights, Extent grid) {
  Level cells{grid.width - 1, grid.height - 1, {}};
  cells.highest.resize(size_t{cells.width} * cells.height);
  std::vector<float> higher(grid.width);  // of two vertices of a column
  float* out = cells.highest.data();
  for (uint32_t y = 0; y < cells.height; ++y, out += cells.width) {
    const float* const north = heights.data() + size_t{y} * grid.width;
    const float* const south = north + grid.width;
    for (uint32_t x = 0; x < grid.width; ++x)
      higher[x] = raised(raised(kLowest, north[x]), south[x]);
    for (uint32_t x = 0; x < cells.width; ++x) out[x] = raised(higher[x], higher[x + 1]);
  }
  return cells;
}

MaximumMipmap::Level MaximumMipmap::halved(const Level& fine) {
  Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  coarse.highest.resize(size_t{coarse.width} * coarse.height);
  std::vector<float> higher(2 * size_t{coarse.width}, kLowest);
  float* out = coarse.highest.data();
  for (uint32_t y = 0; y < coarse.height; ++y, out += coarse.width) {
    const float* const north = fine.highest.data() + size_t{2 * y} * fine.width;
    const float* const south = 2 * y + 1 < fine.height ? north + fine.width : north;
    for (uint32_t x = 0; x < fine.width; ++x) higher[x] = raised(north[x], south[x]);
    for (uint32_t x = 0; x < coarse.width; ++x) out[x] = raised(higher[2 * x], higher[2 * x + 1]);
  }
  return coarse;
}

MaximumMipmap::MaximumMipmap(const std::vector<float>& heights, Extent grid) {
  assert(grid.samples() > 0 && heights.size() == grid.samples());
  levels_.push_back(cellsOf(heights, grid));
  while (levels_.back().width > 1 || levels_.back().height > 1)
    levels_.push_back(halved(levels_.back()));
}

}  // namespace tetrakis::inline pictures
