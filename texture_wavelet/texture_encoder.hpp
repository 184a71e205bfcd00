// SPDX-License-Identifier: Apache-2.0
// Codes an image as texture tracks, by wavelet.
#pragma once

#include <cstdint>

#include "base/texels.hpp"
#include "bitstream/stream/encoded_texture.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

/// An alpha that has nothing but 0 and the largest value becomes a cut-out: a mask ahead of
/// everything in the first track. Colours that it hides are coded for Purpose::kLossless alone.
/// photograph: from photographOf(). It marks the texels of the photograph; the others are the
/// overlay, which comes next. If it marks every texel there is no overlay. Complete tracks without
/// fraction bits that hide nothing are lossless.
EncodedTexture encodeByWavelet(const Texels& texels, Purpose purpose, const TrackOptions& options,
                               Mask photograph = {});

}  // namespace tetrakis
