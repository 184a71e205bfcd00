// SPDX-License-Identifier: Apache-2.0
// Image to texture track, by wavelet.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/header.hpp"
#include "bitstream/track_encoder.hpp"
#include "texture_wavelet/texels.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

struct EncodedTexture {
  TextureHeader header;
  EncodedTrack track;  ///< distortion: squared error summed over the samples that count
  /// Where colours are hidden, 1 for each texel whose colours are not; else empty.
  std::vector<uint8_t> seen;
};

/// Coding stops soon after `limit` bytes. An alpha of two values becomes a cut-out: a mask ahead of
/// the coefficients; colours that it hides are coded for Purpose::kLossless alone. A complete track
/// without fraction bits that hides nothing is lossless.
EncodedTexture encodeByWavelet(const Texels& texels, Purpose purpose, uint64_t limit);

}  // namespace tetrakis
