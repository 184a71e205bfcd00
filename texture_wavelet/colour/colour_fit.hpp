// SPDX-License-Identifier: Apache-2.0
// Chooses the component transform for an image. Encoder only.
#pragma once

#include <cstdint>
#include <span>

#include "base/plane.hpp"
#include "texture_wavelet/colour/colour.hpp"

namespace tetrakis::inline colour {

/// Centres every plane on its mean and fits the shears of RGB to the image. planes: 1 to 4 planes
/// of that many samples of at most 16 bits, as in forwardColour.
ColourTransform fitColour(std::span<const int32_t* const> planes, Extent extent);

/// Only centres every plane on its mean.
ColourTransform centred(std::span<const int32_t* const> planes, size_t count);

/// Sets order and shears so that the components point along the rows of a rotation (an
/// orthogonal matrix), row 0 first, rows 1 and 2 in either order, by the smallest shears possible.
void setRotation(ColourTransform& transform, const Matrix3& rotation);

}  // namespace tetrakis::inline colour
