// SPDX-License-Identifier: Apache-2.0
// fitFurtherColour() finds how a further colour, such as near infrared, follows from the other
// channels. Encoder only.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/plane.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/colour/colour.hpp"

namespace tetrakis::inline colour {

/// ColourTransform::further_shears for channels of which the last, of 2 or 4, is a further colour.
/// transform: that of the others.
std::array<int16_t, 3> fitFurtherColour(const ColourTransform& transform,
                                        std::span<const int32_t* const> channels, Extent extent,
                                        Purpose purpose);

}  // namespace tetrakis::inline colour
