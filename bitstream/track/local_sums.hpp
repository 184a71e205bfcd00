// SPDX-License-Identifier: Apache-2.0
// localSums() adds up the magnitudes around each coefficient, in units of a bit-plane, for its
// contexts: near neighbours count twice, far ones once, and each product is at most kMostLocal.
// Eight bits hold the largest sum, so that vector units add many at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/track/band.hpp"
#include "bitstream/track/band_models.hpp"

namespace tetrakis::inline track {

/// The local sums of 32 coefficients of a row. Passes add to them what they learn, at most 2 each.
/// The last sum is added to, but never used.
using LocalSums = std::array<uint8_t, 33>;
static_assert(8 * kMostLocal + 2 <= 255);

/// first: index of the first cell. The sums are in units of 2^(band.plane + kAbove).
template <int kAbove = 0>
void localSums(const Band& band, size_t first, LocalSums& sums) {
  const auto stride = static_cast<ptrdiff_t>(band.shape.stride());
  const uint8_t* here = band.scaled.data() + first;
  const uint8_t *above = here - stride, *below = here + stride;
  const auto near = [](uint8_t scaled) {
    const auto twice = static_cast<uint8_t>((scaled >> kAbove) << 1);
    return std::min(twice, kMostLocal);
  };
  const auto far = [](uint8_t scaled) {
    return std::min(static_cast<uint8_t>(scaled >> kAbove), kMostLocal);
  };
  for (ptrdiff_t i = 0; i < 32; ++i) {
    sums[static_cast<size_t>(i)] = static_cast<uint8_t>(
        near(here[i - 1]) + near(here[i + 1]) + near(above[i]) + near(below[i]) +
        far(above[i - 1]) + far(above[i + 1]) + far(below[i - 1]) + far(below[i + 1]));
  }
}

/// The local sum of one coefficient, in units of 2^plane.
inline uint8_t localSum(const Band& band, size_t cell, int plane) {
  const Neighbours neighbours(band.shape, band.orientation);
  const auto scaled = [&](ptrdiff_t offset) {
    return band.magnitude[cell + static_cast<size_t>(offset)] >> plane;
  };
  uint32_t sum = 0;
  for (const ptrdiff_t near : neighbours.near)
    sum += std::min<uint32_t>(2 * std::min(scaled(near), 0x7fu), kMostLocal);
  for (const ptrdiff_t far : neighbours.far) sum += std::min<uint32_t>(scaled(far), kMostLocal);
  return static_cast<uint8_t>(sum);
}

}  // namespace tetrakis::inline track
