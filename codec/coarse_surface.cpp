// SPDX-License-Identifier: Apache-2.0
#include "codec/coarse_surface.hpp"

#include <algorithm>

namespace tetrakis {

namespace {

/// Index of the last sample of a side: the overhang of the lattice is clamped onto it.
uint32_t lastOf(uint32_t size, uint32_t k) {
  return (size - 2 + (uint32_t{1} << k)) >> k;
}

}  // namespace

CoarseSurface coarsen(const SurfaceView& surface, uint32_t k) {
  CoarseSurface coarse{lastOf(surface.width, k) + 1, lastOf(surface.height, k) + 1, {}};
  coarse.heights.reserve(size_t{coarse.width} * coarse.height);
  for (uint32_t y = 0; y < coarse.height; ++y) {
    const size_t row = size_t{std::min(y << k, surface.height - 1)} * surface.width;
    for (uint32_t x = 0; x < coarse.width; ++x)
      coarse.heights.push_back(surface.heights[row + std::min(x << k, surface.width - 1)]);
  }
  return coarse;
}

}  // namespace tetrakis
