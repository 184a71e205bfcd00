// SPDX-License-Identifier: Apache-2.0
// Chooses the shears of the coefficients of each level. Encoder only.
#pragma once

#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/colour/colour_axes.hpp"

namespace tetrakis::inline colour {

/// Turns the components of as many levels as that pays for: those of level i + 1 towards the rows
/// of axes.levels[i]. Returns the estimated bits, the header's among them.
double turnLevels(ColourTransform& transform, const ColourAxes& axes, double step);

}  // namespace tetrakis::inline colour
