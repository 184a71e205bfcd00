// SPDX-License-Identifier: Apache-2.0
#include "wavelet/bridges.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace tetrakis::inline wavelet {

namespace {

/// The distance to the nearest sample behind that has the value; it ends at 255, as reaches do.
uint8_t distance(bool has_value, uint8_t before) {
  return has_value ? uint8_t{0} : static_cast<uint8_t>(before + (before < 255));
}

/// Spreads a value of the mask along rows: over all samples within reach of one that has it.
void spreadAlongRows(std::vector<uint8_t>& marks, Extent plane, uint8_t value, uint8_t reach) {
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
}

/// The same along columns, row by row as they lie in memory.
void spreadAlongColumns(std::vector<uint8_t>& marks, Extent plane, uint8_t value, uint8_t reach) {
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
}

}  // namespace

std::vector<uint8_t> liftedSamples(const std::vector<uint8_t>& valid, Extent plane, uint8_t reach) {
  if (reach == 0 || valid.empty()) return valid;
  if (reach == kBridgeAll) return {};
  assert(valid.size() == plane.samples());
  std::vector<uint8_t> lifted = valid;
  for (const uint8_t value : {uint8_t{1}, uint8_t{0}}) {
    spreadAlongRows(lifted, plane, value, reach);
    spreadAlongColumns(lifted, plane, value, reach);
  }
  const bool all = std::all_of(lifted.begin(), lifted.end(), [](uint8_t mark) { return mark; });
  return all ? std::vector<uint8_t>() : lifted;
}

}  // namespace tetrakis::inline wavelet
