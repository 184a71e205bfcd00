// SPDX-License-Identifier: Apache-2.0
// findWhiteLevel() finds the white level of an image: the value that pictures show as white.
// Textures of 16 bits often use few of them: reflectances end near 3000, cameras at 4095. DNG
// states the value as WhiteLevel; viewers of satellite images find one when they stretch the range
// of an image.
#pragma once

#include <algorithm>
#include <cstdint>

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline base {

/// The largest value of TKS_U8 or TKS_U16, which is white where no level is stated.
constexpr uint32_t largestTexel(tks_sample sample) {
  return sample == TKS_U8 ? 0xff : 0xffff;
}

/// The sample in 8 bits: 0 is black; the white level, and what lies above it, is 255.
constexpr uint8_t shownIn8Bits(uint32_t sample, uint32_t white_level) {
  return static_cast<uint8_t>(std::min(255u, (sample * 255 + white_level / 2) / white_level));
}

/// Looks for the white level of an image that is valid: where 98 % of its colours that are not 0
/// lie, and a quarter more, if that is no more than a quarter of 16 bits. largestTexel() of others,
/// and of images with an alpha of more than two values, whose errors would count too much.
uint32_t findWhiteLevel(const tks_image& image);

}  // namespace tetrakis::inline base
