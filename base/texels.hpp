// SPDX-License-Identifier: Apache-2.0
// Texels is an image as the texture codec takes it: rows of texels, each with its channels side by
// side.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline base {

/// There are width * height * channels samples, interleaved, row by row. They have 8 or 16 bits and
/// lie in [0, 2^bits). 1 channel is grey, 2 are grey and alpha, 3 are RGB, 4 are RGBA; without
/// alpha the last of 2 or 4 is a further colour.
struct Texels {
  uint32_t width = 0, height = 0, channels = 0;
  int bits = 8;
  std::vector<uint16_t> samples;
  bool opaque = false;       ///< no channel is alpha
  uint16_t white_level = 0;  ///< what shows as white (base/white_level.hpp); 0: most()

  bool hasAlpha() const { return channels % 2 == 0 && !opaque; }
  Extent extent() const { return {width, height}; }
  /// What errors are measured against.
  uint16_t white() const { return white_level > 0 ? white_level : most(); }
  /// The largest value that a sample may have.
  uint16_t most() const { return static_cast<uint16_t>((1u << bits) - 1); }
};

}  // namespace tetrakis::inline base
