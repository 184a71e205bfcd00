// SPDX-License-Identifier: Apache-2.0
// Reference decoder: bridges over voids (docs/FORMAT.md, section 8.1).
#include <algorithm>

#include "conformance/reference_decoder/layers.hpp"

namespace tetrakis::reference {
namespace {

/// 0 or 1 of each sample, row by row.
struct Marks {
  int width, height;
  std::vector<uint8_t> values;

  size_t at(int x, int y) const { return static_cast<size_t>(y) * width + x; }
};

/// 1 where the value is within reach in x and in y: first along rows, then along columns.
Marks nearValue(const Marks& marks, uint8_t value, int reach) {
  const auto& [width, height, values] = marks;
  Marks in_row{width, height, std::vector<uint8_t>(values.size(), 0)}, near = in_row;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u)
        if (values[marks.at(u, y)] == value) in_row.values[marks.at(x, y)] = 1;
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v)
        if (in_row.values[marks.at(x, v)] == 1) near.values[marks.at(x, y)] = 1;
    }
  }
  return near;
}

}  // namespace

std::vector<uint8_t> bridged(const std::vector<uint8_t>& valid, int width, int height, int reach) {
  if (reach == 255) return {};
  const Marks near = nearValue({width, height, valid}, 1, reach);
  // A square that is all near has none in it that is not.
  std::vector<uint8_t> lifted = nearValue(near, 0, reach).values;
  for (uint8_t& mark : lifted) mark = !mark;
  if (std::find(lifted.begin(), lifted.end(), 0) == lifted.end()) lifted.clear();
  return lifted;
}

}  // namespace tetrakis::reference
