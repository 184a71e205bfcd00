// SPDX-License-Identifier: Apache-2.0
// Choice of the component transform for an image. Encoder only.
#pragma once

#include <cstdint>
#include <span>

#include "texture_wavelet/colour.hpp"

namespace tetrakis {

/// Centres every plane on its mean and fits the shears of RGB to the image. planes: 1 to 4 planes
/// of width * height samples as in forwardColour. The result is within 0.2 % of orthonormal,
/// component 0 has the most energy; exactly grey RGB instead gets differences that are exactly 0.
ColourTransform fitColour(std::span<const int32_t* const> planes, uint32_t width, uint32_t height);

/// Sets order and shears to realise a rotation (an orthogonal matrix, rows: components) up to signs
/// and up to an exchange of the last two rows, with the smallest shears possible.
void setRotation(ColourTransform& transform, const Matrix3& rotation);

}  // namespace tetrakis
