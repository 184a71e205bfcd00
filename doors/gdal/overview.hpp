// SPDX-License-Identifier: Apache-2.0
// GDAL's overviews, made of mip levels. Sample (x, y) of level k lies on sample (x 2^k, y 2^k) of
// the raster, whereas the pixels of an overview share all ground of the raster: where its sides are
// multiples of 2^k, the middle of a pixel is (2^k - 1) / 2 samples further. So overview k is the
// mean of level k - 1 over the areas of its pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// A part of level k - 1 of a component, channels interleaved.
struct FinerLevel {
  const std::byte* pixels;
  tks_window window;  ///< what part
  tks_sample sample;
  uint32_t channels;
  bool has_alpha;                ///< the last channel
  std::optional<double> nodata;  ///< these are void: no part of any mean
};

/// The pixels of overview k >= 1 over the samples of level k - 1, along one axis.
struct OverviewAxis {
  uint32_t k;
  uint32_t raster, overview, finer;  ///< lengths

  /// The first of the three samples that a pixel reaches.
  uint32_t first(uint32_t pixel) const;
  /// Shares of their areas in the pixel's, from the first one on.
  std::array<double, 3> shares(uint32_t pixel) const;
  /// Where a pixel begins: sample i reaches from i - 1/2 to i + 1/2.
  double start(uint32_t pixel) const;
};

/// What of level k - 1 a part of overview k is made of.
tks_window areaBelow(const OverviewAxis& x, const OverviewAxis& y, const tks_window& part);

/// `part` of an overview, which lies above finer.window. Colours count by their alpha.
void makeOverview(const FinerLevel& finer, const OverviewAxis& x, const OverviewAxis& y,
                  const tks_window& part, std::byte* out);

}  // namespace tetrakis::gdal
