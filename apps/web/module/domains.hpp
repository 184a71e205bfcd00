// SPDX-License-Identifier: Apache-2.0
// What JavaScript calls a domain beside those of tks_domain.
#pragma once

#include <algorithm>
#include <cstdint>

#include "tetrakis/tetrakis.h"

/// A forest whose patches are those of a globe (tks_cube_sides).
inline constexpr auto kCube = static_cast<tks_domain>(TKS_DOMAIN_FOREST + 1);
inline constexpr uint32_t kCubePatches = 6;

inline bool isCube(const tks_forest& forest) {
  return forest.patches == kCubePatches &&
         std::equal(forest.sides, forest.sides + 4 * kCubePatches, tks_cube_sides());
}
