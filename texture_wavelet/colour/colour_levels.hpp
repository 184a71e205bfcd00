// SPDX-License-Identifier: Apache-2.0
// forwardColourLevels() and inverseColourLevels() turn the colour planes of each level by the
// shears of that level. Photographs out of a camera or a JPEG file have grey details, because
// chroma was sampled or kept at half the resolution, while their coarse shapes follow the colours
// of the ground: one rotation cannot suit both.
#pragma once

#include <cstdint>
#include <span>

#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "texture_wavelet/colour/colour.hpp"

namespace tetrakis::inline colour {

/// Turns the colour planes of every level, in place. planes: the coefficients of 3 or more
/// transformed planes of that pyramid. Fewer planes are left alone.
void forwardColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<int32_t* const> planes);

/// Turns them back, as far as views of the planes need them. planes: 3 or more of one view of that
/// pyramid, of which every coefficient is put. Fewer are left alone.
void inverseColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<ViewSynthesis> planes);

}  // namespace tetrakis::inline colour
