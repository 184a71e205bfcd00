// SPDX-License-Identifier: Apache-2.0
// Few columns, which are lifted one by one, come to the same as among many.
#include <gtest/gtest.h>

#include <algorithm>

#include "codec/wavelet/lifting/lifting.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kVector = 8, kPitch = 2 * kVector;

/// Lifts the columns in groups of so many.
Plane lifted(Plane plane, uint32_t rows, uint32_t group, FilterId id, Direction direction) {
  for (uint32_t x = 0; x < kPitch; x += group) {
    const uint32_t width = std::min(group, kPitch - x);
    liftColumns({plane.data() + x, kPitch, rows, width}, id, direction, true);
  }
  return plane;
}

TEST(NarrowColumns, AreLiftedAsAmongMany) {
  Random random(5);
  for (const FilterId id : kAllFilters) {
    for (const Direction direction : {Direction::kAnalysis, Direction::kSynthesis}) {
      for (const uint32_t rows : {2u, 3u, 4u, 9u, 31u, 100u}) {
        const Plane plane = randomPlane(random, size_t{kPitch} * rows, -5000, 5000);
        const Plane all = lifted(plane, rows, kPitch, id, direction);
        for (uint32_t group = 1; group < kVector; ++group)
          ASSERT_EQ(lifted(plane, rows, group, id, direction), all) << rows << ", " << group;
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
