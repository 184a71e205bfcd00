// SPDX-License-Identifier: Apache-2.0
// coarsen(), smoothed() and ofMipLevel() make surfaces with every 2^k-th sample. The lattice of a
// coarse surface is the coarse part of that of the whole surface: vertices keep their ids, and the
// same vertices are hidden.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/surface/surface_view.hpp"

namespace tetrakis::inline surface {

struct CoarseSurface {
  uint32_t width = 0, height = 0;
  std::vector<int32_t> heights;

  SurfaceView view() const { return {width, height, heights}; }
};

/// Columns 0, 2^k, 2 * 2^k ... and the last, rows likewise. Sides must be left with two samples.
CoarseSurface coarsen(const SurfaceView& surface, uint32_t k);

/// Columns and rows of coarsen(surface, 1), each sample the mean of those around it with the
/// weights 1 2 1 in x and y: what a mesh of few triangles can show of them.
CoarseSurface smoothed(const SurfaceView& surface);

/// Mip level k of a surface of whole_width * whole_height samples (base/view.hpp), on its
/// lattice: where the last column (row) is none of the level's, it goes on straight from the two
/// before. The level must have two columns and rows.
CoarseSurface ofMipLevel(std::span<const int32_t> level, uint32_t whole_width,
                         uint32_t whole_height, uint32_t k);

/// The sample of the whole surface that a sample of a coarse one lies on. coarse_width: columns of
/// coarsen(whole, k).
uint32_t wholeSample(uint32_t sample, uint32_t coarse_width, uint32_t whole_width,
                     uint32_t whole_height, uint32_t k);

}  // namespace tetrakis::inline surface
