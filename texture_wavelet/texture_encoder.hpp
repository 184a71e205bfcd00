// SPDX-License-Identifier: Apache-2.0
// Image to texture tracks, by wavelet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/texels.hpp"
#include "bitstream/stream/encoded_texture.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

/// An alpha of nothing but 0 and the largest value becomes a cut-out: a mask ahead of everything in
/// the first track; colours that it hides are coded for Purpose::kLossless alone. photograph: from
/// photographOf(); texels that are 0 there are the overlay, which comes next; empty: no overlay.
/// Complete tracks without fraction bits that hide nothing are lossless.
EncodedTexture encodeByWavelet(const Texels& texels, Purpose purpose, const TrackOptions& options,
                               std::span<const uint8_t> photograph = {});

}  // namespace tetrakis
