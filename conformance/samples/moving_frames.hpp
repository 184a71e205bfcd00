// SPDX-License-Identifier: Apache-2.0
// movingFrames() makes frames of which one half stands still and the other half moves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::samples {

using FrameRasters = std::vector<Raster>;

/// The columns from the middle on move by one column a frame.
inline FrameRasters movingFrames(Recipe recipe, uint32_t frames) {
  const uint32_t width = recipe.width;
  recipe.width += frames;
  const Raster wide = make(recipe);
  const size_t texel = tks_sample_bytes(recipe.sample) * recipe.channels;
  FrameRasters rasters;
  for (uint32_t t = 0; t < frames; ++t) {
    Raster frame = wide;
    frame.width = width;
    frame.data.resize(size_t{width} * recipe.height * texel);
    for (uint32_t y = 0; y < recipe.height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        const size_t from = size_t{y} * recipe.width + x + (2 * x >= width ? t : 0);
        std::memcpy(frame.data.data() + (size_t{y} * width + x) * texel,
                    wide.data.data() + from * texel, texel);
      }
    }
    rasters.push_back(std::move(frame));
  }
  return rasters;
}

}  // namespace tetrakis::samples
