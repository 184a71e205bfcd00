// SPDX-License-Identifier: Apache-2.0
// Image to texture tracks, by wavelet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/header.hpp"
#include "bitstream/track_encoder.hpp"
#include "texture_wavelet/texels.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

struct EncodedTexture {
  TextureHeader header;
  /// Distortion: squared error summed over the samples that count.
  std::vector<EncodedTrack> tracks;
  /// Where colours are hidden, 1 for each texel whose colours are not; else empty.
  std::vector<uint8_t> seen = {};
};

/// An alpha of nothing but 0 and the largest value becomes a cut-out: a mask ahead of everything in
/// the first track; colours that it hides are coded for Purpose::kLossless alone. photograph: from
/// photographOf(); texels that are 0 there are the overlay, which comes next; empty: no overlay.
/// Complete tracks without fraction bits that hide nothing are lossless.
EncodedTexture encodeByWavelet(const Texels& texels, Purpose purpose, const TrackOptions& options,
                               std::span<const uint8_t> photograph = {});

}  // namespace tetrakis
