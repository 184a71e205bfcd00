// SPDX-License-Identifier: Apache-2.0
// turnLevels() chooses the shears of the coefficients of each level, where they save more bits than
// they take in the header. Encoder only.
#pragma once

#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/colour/colour_axes.hpp"

namespace tetrakis::inline colour {

/// A transform, and the bits that coefficients and header are estimated to take with it.
struct TurnedLevels {
  ColourTransform transform;
  double bits;
};

/// Turns the colour planes of as many levels as that pays for: those of level i + 1 towards the
/// rows of axes.levels[i]. transform: has no shears of levels.
TurnedLevels turnLevels(const ColourTransform& transform, const ColourAxes& axes, double step);

}  // namespace tetrakis::inline colour
