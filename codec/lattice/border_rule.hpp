// SPDX-License-Identifier: Apache-2.0
// The functions here count the squares and levels of the 4-8 subdivision along the sides of a grid,
// under either of the two rules for its border.
//
// The subdivision of squares of side 2s inserts their centres, at odd multiples of s in x and y,
// and the midpoints of their edges, at multiples of s of odd coordinate sum. Inside the grid these
// are the same samples under both rules:
//
//   clipped      Squares begin at a power of two that covers the longer side, and nothing lies
//                outside the grid: every sample is a vertex of exactly one level, and is coded once
//                (levels.hpp).
//   overhanging  Squares begin at a power of two that covers the shorter side, in a row along the
//                longer one. Those at the border are whole and reach over it, so that every
//                triangle has two halves (codec/mesh/topology/lattice.hpp).
//
// There is a class for each rule, because they number vertices differently: a mask needs no
// numbers, while a mesh needs dense numbers of the cells of a level, hidden vertices included, so
// that a window of ancestors is found by adding an offset.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>

namespace tetrakis::inline lattice {

enum class LevelKind : uint8_t { kRoots, kCentres, kMidpoints };
enum class BorderRule : uint8_t { kClipped, kOverhanging };

/// The number of subdivisions of a grid of width x height samples, at least one each; those of the
/// root squares, of side 2^depth, come first.
inline uint32_t depthOf(BorderRule rule, uint32_t width, uint32_t height) {
  assert(width > 0 && height > 0);
  const uint32_t covered =
      rule == BorderRule::kClipped ? std::max(width, height) : std::min(width, height);
  return covered > 2 ? static_cast<uint32_t>(std::bit_width(covered - 2)) : 0;
}

/// The coordinate of square `index` along a side: of its centre.
constexpr uint32_t centreAt(uint32_t step, uint32_t index) {
  return (2 * index + 1) * step;
}

/// How many centres of squares of side 2 * step there are along a side of `size` samples; size is
/// at least 2 where squares overhang.
inline uint32_t centresAlong(BorderRule rule, uint32_t size, uint32_t step) {
  assert(size > (rule == BorderRule::kClipped ? 0 : 1) && step > 0);
  if (rule == BorderRule::kOverhanging) return (size - 2) / (2 * step) + 1;
  return size > step ? (size - step - 1) / (2 * step) + 1 : 0;
}

/// How many multiples of the step there are along a side of `size` samples, 0 among them; size is
/// at least 2 where squares overhang.
inline uint32_t multiplesAlong(BorderRule rule, uint32_t size, uint32_t step) {
  assert(size > (rule == BorderRule::kClipped ? 0 : 1) && step > 0);
  return rule == BorderRule::kOverhanging ? (size - 2) / step + 2 : (size - 1) / step + 1;
}

}  // namespace tetrakis::inline lattice
