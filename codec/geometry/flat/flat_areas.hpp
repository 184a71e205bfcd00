// SPDX-License-Identifier: Apache-2.0
// Flat areas hold exactly one height each: the sea, lakes, rivers between their weirs. A mask says
// which samples are flat. Flat samples that touch each other along a row or a column are one area,
// and areas are numbered in the order of their first samples, row by row; so neither side sends
// which sample is of which area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/plane.hpp"
#include "wavelet/held_samples.hpp"

namespace tetrakis::inline flat {

/// The flat areas of a whole plane.
struct FlatAreas {
  std::vector<uint16_t> numbers;  ///< of each sample: 0, or 1 + its area; empty: there are none
  std::vector<int32_t> heights;   ///< of each area, in steps

  bool empty() const { return numbers.empty(); }
  HeldSamples held() const { return {numbers, heights}; }
};

/// Returns for each sample the index of the first sample of its area, which is its own index where
/// it is alone.
/// alike(i, j): whether sample i and j, the one before it or above it, are of one area.
template <class Alike>
std::vector<uint32_t> firstSamples(Extent plane, const Alike& alike) {
  std::vector<uint32_t> first(plane.samples());
  std::iota(first.begin(), first.end(), 0u);
  // Until the end an entry is any earlier sample of the same area (R. E. Tarjan's disjoint sets).
  const auto find = [&](uint32_t i) {
    while (first[i] != i) {
      first[i] = first[first[i]];
      i = first[i];
    }
    return i;
  };
  const auto join = [&](uint32_t i, uint32_t above) {
    const uint32_t a = find(i), b = find(above);
    (a < b ? first[b] : first[a]) = a < b ? a : b;
  };
  uint32_t i = 0;
  for (uint32_t y = 0; y < plane.height; ++y) {
    for (uint32_t x = 0; x < plane.width; ++x, ++i) {
      if (x > 0 && alike(i, i - 1)) first[i] = first[i - 1];
      if (y > 0 && alike(i, i - plane.width) && first[i] != first[i - plane.width])
        join(i, i - plane.width);
    }
  }
  for (uint32_t& earlier : first) earlier = first[earlier];
  return first;
}

/// The numbers of the areas of a mask of flat samples, and how many areas there are; no numbers if
/// these are too many.
struct NumberedAreas {
  std::vector<uint16_t> numbers;
  uint32_t count = 0;
};
NumberedAreas numberAreas(const PlaneView<const uint8_t>& flat);

}  // namespace tetrakis::inline flat
