// SPDX-License-Identifier: Apache-2.0
#include "wavelet/typical_parts.hpp"

#include <algorithm>

namespace tetrakis::inline wavelet {

namespace {

constexpr uint32_t kWholeSide = 256;
constexpr uint32_t kFields = 3;  // along each side
constexpr uint32_t kAligned = 16;

struct Interval {
  uint32_t first, length;
};

/// At most so many samples in the middle of a field of a side. They begin at a multiple of kAligned
/// where the field holds one: rows that were interpolated, or copied, then look to the transform of
/// the part as they do to that of the plane.
Interval middleOf(uint32_t field, uint32_t side, uint32_t most) {
  const auto begin = static_cast<uint32_t>(uint64_t{side} * field / kFields);
  const auto end = static_cast<uint32_t>(uint64_t{side} * (field + 1) / kFields);
  const uint32_t length = std::min(end - begin, most);
  const uint32_t middle = begin + (end - begin - length) / 2, aligned = middle & ~(kAligned - 1);
  return {aligned >= begin ? aligned : middle, length};
}

}  // namespace

std::vector<Window> typicalParts(Extent plane, uint32_t side) {
  const auto [width, height] = plane;
  if (std::max(width, height) <= kWholeSide) return {{0, 0, width, height}};
  std::vector<Window> parts;
  for (uint32_t row = 0; row < kFields; ++row) {
    const Interval y = middleOf(row, height, side);
    for (uint32_t column = 0; column < kFields; ++column) {
      const Interval x = middleOf(column, width, side);
      if (x.length > 0 && y.length > 0) parts.push_back({x.first, y.first, x.length, y.length});
    }
  }
  return parts;
}

}  // namespace tetrakis::inline wavelet
