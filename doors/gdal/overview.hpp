// SPDX-License-Identifier: Apache-2.0
// GDAL's overviews, made of mip levels. Sample (x, y) of level k lies on sample (x 2^k, y 2^k) of
// the raster, whereas the middle of an overview's pixel is that of 2^k x 2^k samples: (2^k - 1) / 2
// samples further. So overview k is the mean of level k - 1 over the areas of its pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// A part of level k - 1 of a component, channels interleaved.
struct FinerLevel {
  const std::byte* pixels;
  tks_window window;       ///< what part
  uint32_t width, height;  ///< of the whole level
  tks_sample sample;
  uint32_t channels;
  std::optional<double> nodata;  ///< these are void: no part of any mean
};

/// What of level k - 1 a part of overview k >= 1 is made of.
tks_window areaBelow(const tks_window& part, uint32_t finer_width, uint32_t finer_height);

/// `part` of overview k, which lies above finer.window. Colours count by their alpha.
void makeOverview(const FinerLevel& finer, uint32_t k, const tks_window& part, std::byte* out);

}  // namespace tetrakis::gdal
