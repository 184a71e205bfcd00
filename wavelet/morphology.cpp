// SPDX-License-Identifier: Apache-2.0
#include "wavelet/morphology.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace tetrakis::inline wavelet {

namespace {

/// The distance to the nearest sample behind that has the value; it ends at 255, as reaches do.
uint8_t distance(bool has_value, uint8_t before) {
  return has_value ? uint8_t{0} : static_cast<uint8_t>(before + (before < 255));
}

/// Spreads a value of the mask along rows: over all samples within reach of one that has it.
std::vector<uint8_t> spreadAlongRows(std::vector<uint8_t> marks, Extent plane, uint8_t value,
                                     uint8_t reach) {
  std::vector<uint8_t> left(plane.width);
  for (uint32_t y = 0; y < plane.height; ++y) {
    uint8_t* const row = marks.data() + size_t{y} * plane.width;
    uint8_t d = 255;
    for (uint32_t x = 0; x < plane.width; ++x) left[x] = d = distance(row[x] == value, d);
    d = 255;
    for (uint32_t x = plane.width; x-- > 0;) {
      d = distance(row[x] == value, d);
      if (std::min(left[x], d) <= reach) row[x] = value;
    }
  }
  return marks;
}

/// The same along columns, row by row as they lie in memory.
std::vector<uint8_t> spreadAlongColumns(std::vector<uint8_t> marks, Extent plane, uint8_t value,
                                        uint8_t reach) {
  std::vector<uint8_t> above(marks.size()), d(plane.width, 255);
  for (uint32_t y = 0; y < plane.height; ++y) {
    const size_t row = size_t{y} * plane.width;
    for (uint32_t x = 0; x < plane.width; ++x)
      above[row + x] = d[x] = distance(marks[row + x] == value, d[x]);
  }
  std::fill(d.begin(), d.end(), uint8_t{255});
  for (uint32_t y = plane.height; y-- > 0;) {
    const size_t row = size_t{y} * plane.width;
    for (uint32_t x = 0; x < plane.width; ++x) {
      d[x] = distance(marks[row + x] == value, d[x]);
      if (std::min(above[row + x], d[x]) <= reach) marks[row + x] = value;
    }
  }
  return marks;
}

/// Spreads a value over squares around each sample that has it: 1 dilates the mask, 0 erodes it.
std::vector<uint8_t> spread(std::vector<uint8_t> marks, Extent plane, uint8_t value,
                            uint8_t reach) {
  assert(marks.size() == plane.samples());
  return spreadAlongColumns(spreadAlongRows(std::move(marks), plane, value, reach), plane, value,
                            reach);
}

}  // namespace

std::vector<uint8_t> opened(std::vector<uint8_t> marks, Extent plane, uint8_t reach) {
  return spread(spread(std::move(marks), plane, 0, reach), plane, 1, reach);
}

std::vector<uint8_t> closed(std::vector<uint8_t> marks, Extent plane, uint8_t reach) {
  return spread(spread(std::move(marks), plane, 1, reach), plane, 0, reach);
}

}  // namespace tetrakis::inline wavelet
