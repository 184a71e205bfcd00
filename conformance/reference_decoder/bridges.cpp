// SPDX-License-Identifier: Apache-2.0
// Reference decoder: bridges over voids (docs/FORMAT.md, section 8.1).
#include <algorithm>

#include "conformance/reference_decoder/layers.hpp"

namespace tetrakis::reference {
namespace {

/// Whether samples have the value within a distance of them, in x or else in y.
std::vector<uint8_t> nearValue(const std::vector<uint8_t>& marks, int width, int height, int reach,
                               uint8_t value, bool in_x) {
  std::vector<uint8_t> near(marks.size(), 0);
  const int side = in_x ? width : height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int at = in_x ? x : y;
      for (int i = std::max(at - reach, 0); i <= std::min(at + reach, side - 1); ++i) {
        const size_t other = static_cast<size_t>(in_x ? y : i) * width + (in_x ? i : x);
        if (marks[other] == value) near[static_cast<size_t>(y) * width + x] = 1;
      }
    }
  }
  return near;
}

}  // namespace

std::vector<uint8_t> bridged(const std::vector<uint8_t>& valid, int width, int height, int reach) {
  if (reach == 255) return {};
  const std::vector<uint8_t> near =
      nearValue(nearValue(valid, width, height, reach, 1, true), width, height, reach, 1, false);
  // A square that is all near has none in it that is not.
  std::vector<uint8_t> lifted =
      nearValue(nearValue(near, width, height, reach, 0, true), width, height, reach, 1, false);
  for (uint8_t& mark : lifted) mark = !mark;
  if (std::find(lifted.begin(), lifted.end(), 0) == lifted.end()) lifted.clear();
  return lifted;
}

}  // namespace tetrakis::reference
