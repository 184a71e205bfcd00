// SPDX-License-Identifier: Apache-2.0
// maskedSurface() makes a coarse surface of terrain with voids, whose heights are means of valid
// samples alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/mesh/surface/coarse_surface.hpp"
#include "codec/mesh/surface/weighted_surface.hpp"

namespace tetrakis::inline surface {

/// Every 2^k-th sample of a surface and whether it is valid, on a lattice of its own.
struct MaskedSurface {
  CoarseSurface surface;
  std::vector<uint8_t> valid;

  bool holds(int64_t x, int64_t y) const {
    return x >= 0 && y >= 0 && x < surface.width && y < surface.height && valid[at(x, y)];
  }
  size_t at(int64_t x, int64_t y) const { return static_cast<size_t>(y * surface.width + x); }
};

/// Every 2^levels-th sample, as coarsen() takes them: valid where it is known, its height then the
/// mean of the valid ones around it. Weights do not count.
MaskedSurface maskedSurface(const WeightedSurface& surface, uint32_t levels);

}  // namespace tetrakis::inline surface
