// SPDX-License-Identifier: Apache-2.0
// stencilOf() gives the offsets of the coarser vertices around a vertex of the 4-8 lattice, in two
// rings of equal distance: 1 and sqrt 5, in units of the step.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "codec/lattice/levels.hpp"

namespace tetrakis::inline lattice {

struct Stencil {
  static constexpr std::array<int, 2> kRingSize = {4, 8};
  static constexpr int kTaps = 12;

  std::array<int, kTaps> dx, dy;        ///< grid offsets, ring after ring
  std::array<ptrdiff_t, kTaps> linear;  ///< the same offsets in a row-major grid
  int reach = 0;                        ///< largest |dx| or |dy|
};

/// Returns at + offset; if that lies outside [0, size), its mirror image at - offset; if both lie
/// outside, -1.
inline int64_t mirrored(uint32_t at, int offset, uint32_t size) {
  const int64_t direct = int64_t{at} + offset, image = int64_t{at} - offset;
  if (direct >= 0 && direct < size) return direct;
  return image >= 0 && image < size ? image : -1;
}

/// Midpoints have their nearest neighbours along the axes; centres along the diagonals, which is
/// the same pattern turned by 45 degrees and enlarged by sqrt 2.
inline Stencil stencilOf(LevelKind kind, uint32_t step, uint32_t width) {
  constexpr std::array<std::array<int, 2>, 3> kAxis = {{{1, 0}, {2, 1}, {1, 2}}};
  assert(kind != LevelKind::kRoots && step > 0);  // roots have no coarser neighbours
  Stencil stencil;
  const int s = static_cast<int>(step);
  int tap = 0;
  for (const auto& [u, v] : kAxis) {
    for (int turn = 0; turn < 4; ++turn) {
      const std::array<int, 4> cosine = {1, 0, -1, 0}, sine = {0, 1, 0, -1};
      const int x = u * cosine[turn] - v * sine[turn], y = u * sine[turn] + v * cosine[turn];
      const bool diagonal = kind == LevelKind::kCentres;
      stencil.dx[tap] = s * (diagonal ? x - y : x);
      stencil.dy[tap] = s * (diagonal ? x + y : y);
      stencil.linear[tap] = stencil.dy[tap] * static_cast<ptrdiff_t>(width) + stencil.dx[tap];
      ++tap;
    }
  }
  assert(tap == Stencil::kTaps);
  stencil.reach = s * (kind == LevelKind::kCentres ? 3 : 2);
  return stencil;
}

}  // namespace tetrakis::inline lattice
