// SPDX-License-Identifier: Apache-2.0
// How an image becomes bands: the subbands of every component. Each component hints at the
// magnitudes of the next. Shared by encoder and decoder.
#pragma once

#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "wavelet/band_plan.hpp"

namespace tetrakis {

class TexturePlan {
 public:
  explicit TexturePlan(const TextureHeader& header);

  const PlaneLayout& layout() const { return layout_; }
  /// Tracks, which hold the same part of every component.
  const std::vector<Region>& regions() const { return regions_; }
  std::vector<BandPart> parts(size_t region) const { return layout_.parts(regions_[region]); }
  /// Bands of component c are parts.size() * c onwards, in the order of the parts of a region.
  /// coded: of all texels, 0 where they are void; empty: none. width: of the plane.
  std::vector<BandPlan> bands(std::span<const BandPart> parts, Validity coded,
                              uint32_t width) const;

 private:
  struct ComponentBands {
    int priority;
    uint32_t models;
  };
  PlaneLayout layout_;
  std::vector<Region> regions_;
  std::vector<ComponentBands> components_;
  BandWeights weights_;
};

/// The component transform of a header.
ColourTransform colourOf(const TextureHeader& header);

}  // namespace tetrakis
