// SPDX-License-Identifier: Apache-2.0
// How an image becomes bands: the subbands of every component. Each component hints at the
// magnitudes of the next. Shared by encoder and decoder.
#pragma once

#include <vector>

#include "bitstream/header.hpp"
#include "texture_wavelet/colour.hpp"
#include "wavelet/band_plan.hpp"

namespace tetrakis {

class TexturePlan {
 public:
  explicit TexturePlan(const TextureHeader& header);

  /// Bands of component c are layout().size() * c onwards, in the order of layout().subbands().
  const std::vector<BandPlan>& bands() const { return bands_; }
  const PlaneLayout& layout() const { return layout_; }

 private:
  PlaneLayout layout_;
  std::vector<BandPlan> bands_;
};

/// The component transform of a header.
ColourTransform colourOf(const TextureHeader& header);

}  // namespace tetrakis
