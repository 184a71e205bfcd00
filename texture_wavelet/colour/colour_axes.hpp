// SPDX-License-Identifier: Apache-2.0
// The axes of colour that an image is cheapest to code along. Encoder only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/colour/colour_details.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

/// Axes of colour that need the fewest bits: rows of rotations, luma first.
struct ColourAxes {
  std::vector<ColourDetails> details;  ///< empty: the image is too small to have any
  Matrix3 overall;                     ///< for all scales, each counting as much
  std::vector<Matrix3> levels;         ///< [i]: for level i + 1; as many as details
};

/// Of 3 or more planes of width * height samples.
ColourAxes fitAxes(std::span<const int32_t* const> planes, uint32_t width, uint32_t height,
                   Purpose purpose);

}  // namespace tetrakis
