// SPDX-License-Identifier: Apache-2.0
// texturePyramid() makes the mipmaps of a texture on the processor, so that every driver draws from
// the same texels.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// RGBA8, colour multiplied by alpha, row by row from the top.
struct TextureLevel {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// Levels from the first that fits into max_side (>= 1) down to 1 x 1, each floor(half) of the one
/// before, by area: a texel is the mean of the exact share of the finer level that it covers.
/// 16-bit samples are rounded to 8.
std::vector<TextureLevel> texturePyramid(const ImageFile& image, uint32_t max_side);

}  // namespace tetrakis::tools
