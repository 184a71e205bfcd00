// SPDX-License-Identifier: Apache-2.0
// An image as the texture codec sees it.
#pragma once

#include <cstdint>
#include <vector>

namespace tetrakis {

/// width * height * channels integers, interleaved, row by row. channels: 1 grey, 2 grey+alpha, 3
/// RGB, 4 RGBA. bits: 8 or 16, samples are in [0, 2^bits).
struct Texels {
  uint32_t width = 0, height = 0, channels = 0;
  int bits = 8;
  std::vector<uint16_t> samples;

  /// The largest value of a sample.
  uint16_t most() const { return static_cast<uint16_t>((1u << bits) - 1); }
};

}  // namespace tetrakis
