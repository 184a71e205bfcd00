// SPDX-License-Identifier: Apache-2.0
// Every 2^k-th sample of a surface. Its lattice is the coarse part of the lattice of the whole
// surface, and vertices have the same ids in both.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/surface_view.hpp"

namespace tetrakis {

struct CoarseSurface {
  uint32_t width = 0, height = 0;
  std::vector<int32_t> heights;

  SurfaceView view() const { return {width, height, heights}; }
};

/// Columns 0, 2^k, 2 * 2^k ... and the last, rows likewise. Sides must be left with two samples.
CoarseSurface coarsen(const SurfaceView& surface, uint32_t k);

}  // namespace tetrakis
