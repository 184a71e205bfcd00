// SPDX-License-Identifier: Apache-2.0
#include "codec/lattice/levels.hpp"

#include <cassert>

namespace tetrakis::inline lattice {

namespace {

Level makeLevel(LevelKind kind, uint32_t step, uint32_t width, uint32_t height) {
  constexpr BorderRule kRule = BorderRule::kClipped;
  const bool centres = kind == LevelKind::kCentres;
  const uint32_t rows =
      centres ? centresAlong(kRule, height, step) : multiplesAlong(kRule, height, step);
  const uint32_t even = kind == LevelKind::kRoots ? multiplesAlong(kRule, width, step)
                                                  : centresAlong(kRule, width, step);
  const uint32_t odd =
      kind == LevelKind::kMidpoints ? multiplesAlong(kRule, width, 2 * step) : even;
  return {kind, step, rows, {even, odd}};
}

/// Every vertex of the grid belongs to one level.
[[maybe_unused]] uint64_t verticesOf(const std::vector<Level>& levels) {
  uint64_t vertices = 0;
  for (const Level& level : levels) {
    const uint64_t odd = level.rows / 2;
    vertices += (level.rows - odd) * level.columns[0] + odd * level.columns[1];
  }
  return vertices;
}

}  // namespace

/// Midpoints of step s depend on centres of that step within s; both on what finer levels need:
/// their steps together are less than s, and each counts twice.
Window neededOf(const Level& level, const Window& window, Extent grid) {
  const uint64_t reach = uint64_t{level.kind == LevelKind::kCentres ? 3u : 2u} * level.step;
  const auto around = [reach](uint32_t& first, uint32_t& size, uint32_t whole) {
    const uint64_t end = std::min<uint64_t>(uint64_t{first} + size + reach, whole);
    first -= static_cast<uint32_t>(std::min<uint64_t>(first, reach));
    size = static_cast<uint32_t>(end - first);
  };
  Window needed = window;
  around(needed.x, needed.width, grid.width);
  around(needed.y, needed.height, grid.height);
  return needed;
}

std::vector<Level> levelsOf(uint32_t width, uint32_t height, int mip) {
  assert(width > 0 && height > 0 && mip >= 0);
  const uint32_t depth = depthOf(BorderRule::kClipped, width, height);
  std::vector<Level> levels = {makeLevel(LevelKind::kRoots, uint32_t{1} << depth, width, height)};
  for (uint32_t k = depth; k-- > static_cast<uint32_t>(mip);) {
    levels.push_back(makeLevel(LevelKind::kCentres, uint32_t{1} << k, width, height));
    levels.push_back(makeLevel(LevelKind::kMidpoints, uint32_t{1} << k, width, height));
  }
  assert(mip > 0 || verticesOf(levels) == uint64_t{width} * height);
  for (Level& level : levels) level.step >>= mip;
  return levels;
}

}  // namespace tetrakis::inline lattice
