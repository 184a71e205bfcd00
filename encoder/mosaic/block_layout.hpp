// SPDX-License-Identifier: Apache-2.0
// BlockLayout places the coefficients of a block of a mosaic: where those of a region lie in the
// bands of the whole plane, where they lie in the transform of the block, and how a track codes
// them. Coding and restoring of a tile share it.
#pragma once

#include <vector>

#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/wavelet.hpp"
#include "encoder/mosaic/block.hpp"

namespace tetrakis::inline mosaic {

class BlockLayout {
 public:
  /// window: of the plane that the tile codes or restores; it begins at even places of all levels
  /// of the tile. valid: its samples.
  BlockLayout(const TaskInputs& inputs, const Window& window, const PartMask& valid);

  /// The block as a plane of its own.
  const PlaneLayout& local() const { return local_; }
  const WaveletSpec& spec() const { return spec_; }
  const Window& window() const { return window_; }

  /// The coefficients of the track of a region, as they are coded in the whole plane.
  struct Track {
    std::vector<BandPart> here;  ///< in the bands of the block
    std::vector<BandPlan> plan;
    std::vector<double> weights;  ///< squared steps for a squared unit of a coefficient, by band
  };
  /// region: all of it lies in the block.
  Track trackOf(const Region& region) const;

 private:
  BandPart inBlock(const BandPart& part) const;

  PlaneLayout whole_;
  int group_;
  Window window_;
  double unit_;  ///< squared steps in a squared unit of coefficients
  WaveletSpec spec_;
  PlaneLayout local_;
};

}  // namespace tetrakis::inline mosaic
