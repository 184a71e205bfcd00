// SPDX-License-Identifier: Apache-2.0
// TexturePlan lists the bands in which an image is coded: the subbands of every colour plane. Each
// plane hints at the magnitudes of the next. Encoder and decoder share this plan.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bitstream/stream/texture_header.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "texture_wavelet/colour/colour.hpp"

namespace tetrakis::inline texture {

class TexturePlan {
 public:
  /// coded: the texels that the coefficients make. norms: those of an
  /// earlier plan.
  TexturePlan(const TextureHeader& header, const SharedBits& coded,
              const std::optional<SynthesisNorms>& norms = {});

  const PlaneLayout& layout() const { return layout_; }
  /// The regions of the tracks. A track holds the same part of every colour plane.
  const std::vector<Region>& regions() const { return regions_; }
  std::vector<BandPart> parts(size_t region) const { return layout_.parts(regions_[region]); }
  /// Returns the bands of a track. Those of colour plane c begin at parts.size() * c, and follow
  /// each other in the order of the parts of the region.
  std::vector<BandPlan> bands(std::span<const BandPart> parts) const;

 private:
  struct PlaneBands {
    int priority;
    uint32_t models;
  };
  PlaneLayout layout_;
  std::vector<Region> regions_;
  std::vector<PlaneBands> planes_;  ///< of each colour plane
  BandWeights weights_;
};

/// Returns the colour transform that a header describes.
ColourTransform colourOf(const TextureHeader& header);

}  // namespace tetrakis::inline texture
