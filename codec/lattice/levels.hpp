// SPDX-License-Identifier: Apache-2.0
// levelsOf() takes the size of a grid and returns the levels of its 4-8 lattice, coarse to fine,
// with the vertices that each one inserts; stencilOf() gives the coarser neighbours of a vertex.
// Masks, drawings and meshes share them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/view.hpp"

namespace tetrakis::inline lattice {

// depthOf(), centresAlong() and multiplesAlong() count the squares and levels of the 4-8
// subdivision along the sides of a grid, under either of the two rules for its border.
//
// The subdivision of squares of side 2s inserts their centres, at odd multiples of s in x and y,
// and the midpoints of their edges, at multiples of s of odd coordinate sum. Inside the grid these
// are the same samples under both rules:
//
//   clipped      Squares begin at a power of two that covers the longer side, and nothing lies
//                outside the grid: every sample is a vertex of exactly one level, and is coded
//                once.
//   overhanging  Squares begin at a power of two that covers the shorter side, in a row along the
//                longer one. Those at the border are whole and reach over it, so that every
//                triangle has two halves (codec/mesh/topology/lattice.hpp).
//
// There is a class for each rule, because they number vertices differently: a mask needs no
// numbers, while a mesh needs dense numbers of the cells of a level, hidden vertices included, so
// that a window of ancestors is found by adding an offset.

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

// Level is one of the levels of the 4-8 lattice over a W x H grid, clipped at its border. Masks and
// drawings are coded in this order. Levels are counted from 1 in this file and in the thesis,
// because the roots are level 0; meshes, whose roots are no level, count from 0.
//
// One 4-8 subdivision of squares of side 2s (s = 2^(depth-1) ... 1) inserts two levels
// (thesis 3.2):
//
//   v---.---v      v  corners: the vertices of coarser levels, at multiples of 2s
//   |       |      c  square centres (odd level),  at odd multiples of s in x and y
//   .   c   .      .  edge midpoints (even level), at multiples of s of odd coordinate sum
//   |       |
//   v---.---v      Every vertex of the grid belongs to exactly one level.
//
// The grid may have any size. It is not padded: there are no vertices outside the grid.

/// Vertices of one level, in rows.
struct Level {
  LevelKind kind = LevelKind::kRoots;
  uint32_t step = 1;  ///< s for centres and midpoints, 2^depth for roots
  uint32_t rows = 0;
  std::array<uint32_t, 2> columns{};  ///< in even and in odd rows

  uint32_t y(uint32_t row) const {
    return kind == LevelKind::kCentres ? centreAt(step, row) : row * step;
  }
  uint32_t firstX(uint32_t row) const {
    if (kind == LevelKind::kRoots) return 0;
    return kind == LevelKind::kCentres || row % 2 == 0 ? step : 0;
  }
  uint32_t pitch() const { return kind == LevelKind::kRoots ? step : 2 * step; }
};

/// Calls visit(x, y) for the vertices of a level that lie in a window of the grid, row by row.
template <class Visit>
void forEachVertex(const Level& level, const Window& window, const Visit& visit) {
  const auto upTo = [](uint32_t end, uint32_t first, uint32_t pitch) {
    return end > first ? (end - first - 1) / pitch + 1 : 0;
  };
  const bool centres = level.kind == LevelKind::kCentres;
  const uint32_t first_y = centres ? level.step : 0, row_pitch = (centres ? 2 : 1) * level.step;
  const uint32_t last_row =
      std::min(level.rows, upTo(window.y + window.height, first_y, row_pitch));
  for (uint32_t row = upTo(window.y, first_y, row_pitch); row < last_row; ++row) {
    const uint32_t first = level.firstX(row), pitch = level.pitch();
    const uint32_t end =
        std::min(level.columns[row % 2], upTo(window.x + window.width, first, pitch));
    for (uint32_t i = upTo(window.x, first, pitch); i < end; ++i)
      visit(first + i * pitch, level.y(row));
  }
}

/// The window of a level's vertices that those in another window depend on, where each depends on
/// coarser ones within its step, and these again.
Window neededOf(const Level& level, const Window& window, Extent grid);

/// Returns the 1 + 2 * depth levels of a grid: the roots, then the centres and the midpoints of
/// every step from coarse to fine. With a mip level, returns only the levels all of whose vertices
/// lie at multiples of 2^mip, in units of 2^mip: they are the levels of the grid of every 2^mip-th
/// vertex, in the order of the whole grid.
std::vector<Level> levelsOf(uint32_t width, uint32_t height, int mip = 0);

// stencilOf() gives the offsets of the coarser vertices around a vertex of the 4-8 lattice, in two
// rings of equal distance: 1 and sqrt 5, in units of the step.

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
