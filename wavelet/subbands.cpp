// SPDX-License-Identifier: Apache-2.0
#include "wavelet/subbands.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis {

namespace {

uint32_t lowOf(uint32_t side) {
  return side > kSmallestSide ? side - side / 2 : side;
}

}  // namespace

std::vector<Extent> lowExtents(uint32_t width, uint32_t height) {
  std::vector<Extent> extents = {{width, height}};
  while (std::max(extents.back().width, extents.back().height) > kSmallestSide) {
    extents.push_back({lowOf(extents.back().width), lowOf(extents.back().height)});
  }
  assert(extents.size() <= kMaxLevels + 1);
  return extents;
}

std::vector<Subband> subbandsOf(uint32_t width, uint32_t height) {
  const std::vector<Extent> extents = lowExtents(width, height);
  const auto levels = static_cast<int>(extents.size()) - 1;
  std::vector<Subband> bands;
  // Finest first, each level backwards; reversed at the end.
  int splits_x = 0, splits_y = 0;
  for (int level = 1; level <= levels; ++level) {
    const Extent whole = extents[static_cast<size_t>(level - 1)],
                 low = extents[static_cast<size_t>(level)];
    splits_x += low.width < whole.width;
    splits_y += low.height < whole.height;
    const uint32_t high_width = whole.width - low.width, high_height = whole.height - low.height;
    const uint32_t high_y = uint32_t{1} << std::max(splits_y - 1, 0);
    const auto add = [&](Orientation orientation, uint32_t w, uint32_t h, uint32_t x, uint32_t y) {
      bands.push_back({level, orientation, w, h, x, y, splits_x, splits_y});
    };
    add(Orientation::kHH, high_width, high_height, low.width, high_y);
    add(Orientation::kLH, low.width, high_height, 0, high_y);
    add(Orientation::kHL, high_width, low.height, low.width, 0);
  }
  bands.push_back({levels, Orientation::kLL, extents.back().width, extents.back().height, 0, 0,
                   splits_x, splits_y});
  std::reverse(bands.begin(), bands.end());
  return bands;
}

}  // namespace tetrakis
