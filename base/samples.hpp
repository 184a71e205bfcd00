// SPDX-License-Identifier: Apache-2.0
// withSampleType() takes the C++ type of a tks_sample, so that code is written once for all types.
// Texels is an image of such samples as the texture codec takes it, and findWhiteLevel() returns
// the value of an image that pictures show as white.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline base {

// withSampleType() calls a function with the C++ type that a tks_sample names, so that code is
// written once for all types.

/// Calls f(T{}) with the type that `sample` names. Unknown values are refused before this point.
template <class F>
auto withSampleType(tks_sample sample, F&& f) {
  switch (sample) {
    case TKS_U8:
      return f(uint8_t{});
    case TKS_I8:
      return f(int8_t{});
    case TKS_U16:
      return f(uint16_t{});
    case TKS_I16:
      return f(int16_t{});
    case TKS_U32:
      return f(uint32_t{});
    case TKS_I32:
      return f(int32_t{});
    case TKS_F32:
      break;
  }
  return f(float{});
}

// Texels is an image as the texture codec takes it: rows of texels, each with its channels side by
// side.

/// There are width * height * channels samples, interleaved, row by row. They have 8 or 16 bits and
/// lie in [0, 2^bits). 1 channel is grey, 2 are grey and alpha, 3 are RGB, 4 are RGBA; without
/// alpha the last of 2 or 4 is a further colour.
struct Texels {
  uint32_t width = 0, height = 0, channels = 0;
  int bits = 8;
  std::vector<uint16_t> samples;
  bool opaque = false;       ///< no channel is alpha
  uint16_t white_level = 0;  ///< what shows as white; 0: most()

  bool hasAlpha() const { return channels % 2 == 0 && !opaque; }
  Extent extent() const { return {width, height}; }
  /// What errors are measured against.
  uint16_t white() const { return white_level > 0 ? white_level : most(); }
  /// The largest value that a sample may have.
  uint16_t most() const { return static_cast<uint16_t>((1u << bits) - 1); }
};

// findWhiteLevel() finds the white level of an image: the value that pictures show as white.
// Textures of 16 bits often use few of them: reflectances end near 3000, cameras at 4095. DNG
// states the value as WhiteLevel; viewers of satellite images find one when they stretch the range
// of an image.

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
