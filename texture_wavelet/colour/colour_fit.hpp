// SPDX-License-Identifier: Apache-2.0
// fitColour() fits the colour transform to the channels of an image. Encoder only.
#pragma once

#include <cstdint>
#include <span>

#include "base/plane.hpp"
#include "texture_wavelet/colour/colour.hpp"

namespace tetrakis::inline colour {

/// Centres every channel on its mean and fits the shears of RGB to the image. channels: 1 to 4 of
/// that many samples of at most 16 bits, as in forwardColour.
ColourTransform fitColour(std::span<const int32_t* const> channels, Extent extent);

/// Only centres every channel on its mean.
ColourTransform centred(std::span<const int32_t* const> channels, size_t count);

/// Takes the order and the shears with which the colour planes point along the rows of a rotation
/// (an orthogonal matrix), row 0 first, rows 1 and 2 in either order: the smallest shears possible.
ColourTransform rotated(ColourTransform transform, const Matrix3& rotation);

}  // namespace tetrakis::inline colour
