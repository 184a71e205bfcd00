// SPDX-License-Identifier: Apache-2.0
// GDAL's overviews, made of mip levels. Sample (x, y) of level k lies on sample (x 2^k, y 2^k) of
// the raster, whereas the pixels of an overview share all ground of the raster: where its sides are
// multiples of 2^k, the middle of a pixel is (2^k - 1) / 2 samples further. So overview k is the
// mean of level k - 1 over the areas of its pixels. Classes have no means: of these it is the
// samples in the middle of its pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// Of each channel, if it has one: samples of this value are void, no part of any mean.
using NodataValues = std::array<std::optional<double>, TKS_MOST_FRAMES>;

/// A part of the level of a component that an overview is made of, channels interleaved.
struct FinerLevel {
  const std::byte* pixels;
  tks_window window;  ///< what part
  tks_sample sample;
  uint32_t channels;
  bool has_alpha;  ///< the last channel
  NodataValues nodata;
};

/// The pixels of an overview over the samples of a finer level, along one axis.
struct OverviewAxis {
  uint32_t level;                    ///< the finer one; for means of overview k it is k - 1
  uint32_t raster, overview, finer;  ///< lengths

  /// The first of the three samples that a pixel reaches.
  uint32_t first(uint32_t pixel) const;
  /// Shares of their areas in the pixel's, from the first one on.
  std::array<double, 3> shares(uint32_t pixel) const;
  /// The sample that is nearest to the middle of a pixel; of two the second, as GDAL chooses.
  uint32_t middle(uint32_t pixel) const;

 private:
  /// Where a pixel begins or, half a pixel further, has its middle: sample i reaches from i - 1/2
  /// to i + 1/2.
  double place(double pixel) const;
};

/// What of the finer level the means in a part of an overview are made of.
tks_window areaOfMeans(const OverviewAxis& x, const OverviewAxis& y, const tks_window& part);

/// `part` of an overview, which lies above finer.window. Colours count by their alpha.
void makeMeans(const FinerLevel& finer, const OverviewAxis& x, const OverviewAxis& y,
               const tks_window& part, std::byte* out);

/// The same of an overview that has samples as they are.
tks_window areaOfMiddles(const OverviewAxis& x, const OverviewAxis& y, const tks_window& part);
void takeMiddles(const FinerLevel& finer, const OverviewAxis& x, const OverviewAxis& y,
                 const tks_window& part, std::byte* out);

}  // namespace tetrakis::gdal
