// SPDX-License-Identifier: Apache-2.0
// How an image becomes bands: the subbands of every component, and the hints that a subband takes
// from its parent band and from the component before it. Shared by encoder and decoder.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/header.hpp"
#include "bitstream/track.hpp"
#include "texture_wavelet/colour.hpp"
#include "texture_wavelet/wavelet.hpp"

namespace tetrakis {

class TexturePlan : public HintFactory {
 public:
  explicit TexturePlan(const TextureHeader& header);

  /// Bands of component c are bandsPerComponent() * c onwards, in the order of subbands().
  const std::vector<BandPlan>& bands() const { return bands_; }
  const std::vector<Subband>& subbands() const { return subbands_; }
  size_t bandsPerComponent() const { return subbands_.size(); }
  std::unique_ptr<HintSource> hints(const TrackState& state, uint32_t band) const override;

 private:
  std::vector<Subband> subbands_;
  std::vector<BandPlan> bands_;
};

/// The component transform of a header.
ColourTransform colourOf(const TextureHeader& header);

}  // namespace tetrakis
