// SPDX-License-Identifier: Apache-2.0
// Opening and closing of masks by squares, by their properties.
#include "codec/wavelet/morphology.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "conformance/samples/void_masks.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

/// A mark stays if a square covers it that holds no sample of the plane without a mark.
bool staysCovered(const std::vector<uint8_t>& marks, const Size& size, int x, int y, int reach) {
  const auto holds = [&](int cx, int cy) {
    for (int j = std::max(cy - reach, 0); j <= std::min<int>(cy + reach, size.height - 1); ++j) {
      for (int i = std::max(cx - reach, 0); i <= std::min<int>(cx + reach, size.width - 1); ++i)
        if (!marks[size_t(j) * size.width + size_t(i)]) return false;
    }
    return true;
  };
  for (int cy = std::max(y - reach, 0); cy <= std::min<int>(y + reach, size.height - 1); ++cy) {
    for (int cx = std::max(x - reach, 0); cx <= std::min<int>(x + reach, size.width - 1); ++cx)
      if (holds(cx, cy)) return true;
  }
  return false;
}

TEST(Morphology, OpenedMasksAreWhatSquaresCover) {
  for (const Size& size : kMaskedSizes) {
    if (size.count() > 4000) continue;
    for (const VoidShape shape : kVoidShapes) {
      const std::vector<uint8_t> marks = validity(shape, size.width, size.height);
      for (const int reach : {1, 2, 5}) {
        const std::vector<uint8_t> covered =
            opened(marks, size.extent(), static_cast<uint8_t>(reach));
        for (size_t i = 0; i < marks.size(); ++i) {
          const int x = static_cast<int>(i % size.width), y = static_cast<int>(i / size.width);
          ASSERT_EQ(covered[i] != 0, staysCovered(marks, size, x, y, reach))
              << size << ", " << shape << ", reach " << reach << ", " << x << ", " << y;
        }
      }
    }
  }
}

std::vector<uint8_t> complement(std::vector<uint8_t> marks) {
  for (uint8_t& mark : marks) mark ^= 1;
  return marks;
}

TEST(Morphology, ClosingAMaskOpensItsComplement) {
  for (const Size& size : kMaskedSizes) {
    for (const VoidShape shape : kVoidShapes) {
      const std::vector<uint8_t> marks = validity(shape, size.width, size.height);
      for (const uint8_t reach : {uint8_t{1}, uint8_t{3}, uint8_t{255}}) {
        ASSERT_EQ(closed(marks, size.extent(), reach),
                  complement(opened(complement(marks), size.extent(), reach)))
            << size << ", " << shape << ", reach " << int{reach};
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
