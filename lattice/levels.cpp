// SPDX-License-Identifier: Apache-2.0
#include "lattice/levels.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis {

namespace {

/// How many of first, first + pitch, ... are below size.
uint32_t countBelow(uint32_t size, uint32_t first, uint32_t pitch) {
  return size > first ? (size - first - 1) / pitch + 1 : 0;
}

Level makeLevel(LevelKind kind, uint32_t step, uint32_t width, uint32_t height) {
  Level level{kind, step, 0, {}};
  if (kind == LevelKind::kRoots) {
    level.rows = countBelow(height, 0, step);
    level.columns = {countBelow(width, 0, step), countBelow(width, 0, step)};
  } else if (kind == LevelKind::kCentres) {
    level.rows = countBelow(height, step, 2 * step);
    level.columns = {countBelow(width, step, 2 * step), countBelow(width, step, 2 * step)};
  } else {
    level.rows = countBelow(height, 0, step);
    level.columns = {countBelow(width, step, 2 * step), countBelow(width, 0, 2 * step)};
  }
  return level;
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

uint32_t depthOf(uint32_t width, uint32_t height) {
  uint32_t depth = 0;
  assert(width > 0 && height > 0);
  while ((uint64_t{1} << depth) < uint64_t{std::max(width, height)} - 1) ++depth;
  return depth;
}

std::vector<Level> levelsOf(uint32_t width, uint32_t height, int mip) {
  assert(width > 0 && height > 0 && mip >= 0);
  const uint32_t depth = depthOf(width, height);
  std::vector<Level> levels = {makeLevel(LevelKind::kRoots, uint32_t{1} << depth, width, height)};
  for (uint32_t k = depth; k-- > static_cast<uint32_t>(mip);) {
    levels.push_back(makeLevel(LevelKind::kCentres, uint32_t{1} << k, width, height));
    levels.push_back(makeLevel(LevelKind::kMidpoints, uint32_t{1} << k, width, height));
  }
  assert(mip > 0 || verticesOf(levels) == uint64_t{width} * height);
  for (Level& level : levels) level.step >>= mip;
  return levels;
}

}  // namespace tetrakis
