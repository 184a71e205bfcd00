// SPDX-License-Identifier: Apache-2.0
// The levels of the 4-8 lattice over a W x H grid, clipped at its border (border_rule.hpp). Masks
// and drawings are coded in this order. Levels are counted from 1 here and in the thesis, because
// the roots are level 0; meshes, whose roots are no level, count from 0.
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
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/view.hpp"
#include "codec/lattice/border_rule.hpp"

namespace tetrakis::inline lattice {

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

}  // namespace tetrakis::inline lattice
