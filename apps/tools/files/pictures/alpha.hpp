// SPDX-License-Identifier: Apache-2.0
// The functions here read and write alpha, which is the last of two or four channels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// No alpha, or nothing but its largest value.
bool isOpaque(const ImageFile& image);

/// One or three colours, and behind them an alpha: 0 where the mask, a byte for each pixel, is 0,
/// and elsewhere its largest value.
ImageFile withAlpha(const ImageFile& colours, const std::vector<uint8_t>& mask);

/// A byte for each pixel: 0 where each channel has its value.
std::vector<uint8_t> maskOfValues(const ImageFile& image, std::span<const double> values);

/// Turns colours that were multiplied by alpha into plain ones, rounded; those under alpha 0 stay.
void divideByAlpha(ImageFile& image);

}  // namespace tetrakis::tools
