// SPDX-License-Identifier: Apache-2.0
// skyAt() gives the colour of the sky in a row of a picture, which fills the pixels that show no
// ground.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tetrakis::inline ground {

/// The sky of a picture in R, G and B, from the top row to the bottom row.
inline std::array<uint32_t, 3> skyAt(uint32_t row, uint32_t rows) {
  constexpr std::array<uint32_t, 3> kZenith{172, 199, 226}, kHorizon{240, 243, 245};
  std::array<uint32_t, 3> sky{};
  for (size_t c = 0; c < 3; ++c) sky[c] = (kZenith[c] * (rows - row) + kHorizon[c] * row) / rows;
  return sky;
}

}  // namespace tetrakis::inline ground
