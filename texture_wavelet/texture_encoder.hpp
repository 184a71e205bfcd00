// SPDX-License-Identifier: Apache-2.0
// This file codes an image by wavelet. It fits a colour transform and filters to the image and
// codes the coefficients that they leave into tracks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/encoded_texture.hpp"
#include "texture_wavelet/texture_source.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

/// An alpha of nothing but 0 and the largest value becomes a cut-out: a mask ahead of everything in
/// the first track; colours that it hides are coded for Purpose::kLossless alone. photograph: from
/// photographOf(); texels that are 0 there are the overlay, which comes next; empty: no overlay.
/// Complete tracks without fraction bits that hide nothing are lossless. like: the header of an
/// attempt of the same purpose and photograph, whose colours and filters are taken over; null: they
/// are chosen, which gives the same.
EncodedTexture encodeByWavelet(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options,
                               std::span<const uint8_t> photograph = {},
                               const TextureHeader* like = nullptr);

}  // namespace tetrakis
