// SPDX-License-Identifier: Apache-2.0
// encodeByWavelet() codes an image by wavelet. It fits a colour transform and filters to the image
// and codes the coefficients that they leave into tracks.
#pragma once

#include <cstdint>

#include "bitstream/stream/encoded_texture.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/tables/few_values.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline texture {

/// An alpha that has nothing but 0 and the largest value becomes a cut-out: a mask ahead of
/// everything in the first track. Colours that it hides are coded for Purpose::kLossless alone.
/// photograph: from photographOf(). It marks the texels of the photograph; the others are the
/// overlay, which comes next. If it marks every texel there is no overlay. Complete tracks without
/// fraction bits that hide nothing are lossless. like: a header whose colours, filters and choice
/// of tables are taken over; null: they are chosen, which gives those of an attempt of the same
/// purpose and photograph, and there are no tables.
EncodedTexture encodeByWavelet(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options, Mask photograph = {},
                               const TextureHeader* like = nullptr);

/// The same for Purpose::kLossless, with tables of the values that channels have.
EncodedTexture encodeInTables(const TextureSource& source, const FewValues& few,
                              const TextureOptions& options, Mask photograph = {});

/// The tables that may save bytes where all colours of the photograph are coded.
FewValues fewValuesOf(const TextureSource& source, Mask photograph);

}  // namespace tetrakis::inline texture
