// SPDX-License-Identifier: Apache-2.0
// Axes of colour that turn from level to level. Photographs out of a camera or a JPEG file have
// details that are grey, because chroma was sampled or kept at half the resolution, while their
// coarse shapes follow the colours of the ground: one rotation cannot suit both.
#pragma once

#include <cstdint>
#include <span>

#include "texture_wavelet/colour/colour.hpp"
#include "wavelet/subbands.hpp"

namespace tetrakis {

/// Coefficients of transformed planes, in place: the shears of every level. planes: 3 or more of
/// one size; width: of their rows; subbands: those of the planes, of which level l is level
/// l + finer_levels of the whole image.
void forwardColourLevels(const ColourTransform& transform, std::span<const Subband> subbands,
                         int finer_levels, std::span<int32_t* const> planes, uint32_t width);
void inverseColourLevels(const ColourTransform& transform, std::span<const Subband> subbands,
                         int finer_levels, std::span<int32_t* const> planes, uint32_t width);

}  // namespace tetrakis
