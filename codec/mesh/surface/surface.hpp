// SPDX-License-Identifier: Apache-2.0
// A surface is the height field that meshes approximate: SurfaceView as the caller gives it, with
// weights if there are any; WeightedSurface with unknown samples; CoarseSurface with every 2^k-th
// sample, because meshes of few triangles need no more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis::inline surface {

// SurfaceView is a height field, with weights if there are any, whose samples the caller owns.

/// heights: width * height values, row by row; any int32. Sizes from 2 x 2.
struct SurfaceView {
  uint32_t width = 0, height = 0;
  std::span<const int32_t> heights;
  /// What a squared error at each sample counts (view, texture), finite and not negative; empty: 1.
  std::span<const float> weights = {};

  double weightOf(size_t sample) const {
    return weights.empty() ? 1.0 : static_cast<double>(weights[sample]);
  }
};

// WeightedSurface is a surface of which some samples may be unknown, so that fits leave them out.

/// Where known[i] is 0, sample i does not count in fits, whatever its weight in the view. Where
/// `known` is empty, all samples are known.
struct WeightedSurface {
  SurfaceView view;
  std::span<const uint8_t> known = {};

  bool isWeighted() const { return !known.empty() || !view.weights.empty(); }
  bool isKnown(size_t sample) const { return known.empty() || known[sample] != 0; }
  double weightOf(uint32_t sample) const { return isKnown(sample) ? view.weightOf(sample) : 0; }
};

// coarsen(), smoothed() and ofMipLevel() make surfaces with every 2^k-th sample. The lattice of a
// coarse surface is the coarse part of that of the whole surface: vertices keep their ids, and the
// same vertices are hidden.

struct CoarseSurface {
  uint32_t width = 0, height = 0;
  std::vector<int32_t> heights;

  SurfaceView view() const { return {width, height, heights}; }
};

/// Columns, or rows, of a coarse surface whose whole has `side` of them.
uint32_t coarseSide(uint32_t side, uint32_t k);

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

// maskedSurface() makes a coarse surface of terrain with voids, whose heights are means of valid
// samples alone.

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
