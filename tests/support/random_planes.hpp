// SPDX-License-Identifier: Apache-2.0
// Planes of random integers for tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace tetrakis::test {

using Plane = std::vector<int32_t>;
using Random = std::mt19937;

inline constexpr int32_t kLowest = std::numeric_limits<int32_t>::min();
inline constexpr int32_t kHighest = std::numeric_limits<int32_t>::max();

inline Plane randomPlane(Random& random, size_t count, int32_t low, int32_t high) {
  const uint64_t span = static_cast<uint64_t>(int64_t{high} - low) + 1;
  Plane plane(count);
  for (int32_t& v : plane) v = static_cast<int32_t>(low + static_cast<int64_t>(random() % span));
  return plane;
}

/// Only the two ends of a range: the largest details there are.
inline Plane extremePlane(Random& random, size_t count, int32_t low, int32_t high) {
  Plane plane(count);
  for (int32_t& v : plane) v = random() % 2 == 0 ? low : high;
  return plane;
}

}  // namespace tetrakis::test
