// SPDX-License-Identifier: Apache-2.0
// Streams in regions with an index, views of them, and how well a part of them is known.
#pragma once

#include <algorithm>
#include <array>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

inline tks_screen_camera cameraOf(const std::array<double, 16>& clip) {
  tks_screen_camera camera = {};
  camera.size = sizeof camera;
  camera.width = 320;
  camera.height = 200;
  std::copy(clip.begin(), clip.end(), camera.clip);
  return camera;
}

/// A map of columns x0 … x1 and rows y0 … y1.
inline tks_screen_camera mapOf(double x0, double y0, double x1, double y1) {
  const double x = 2 / (x1 - x0), y = 2 / (y1 - y0);
  return cameraOf(
      {x, 0, 0, -x * (x0 + x1) / 2, 0, -y, 0, y * (y0 + y1) / 2, 0, 0, 0, 0, 0, 0, 0, 1});
}

/// From (column, row, height) down the rows, a right angle wide.
inline tks_screen_camera alongRows(double column, double row, double height) {
  return cameraOf({1, 0, 0, -column, 0, 0, 1, -height, 0, 0, 0, 0, 0, 1, 0, -row});
}

inline Bytes encodeRegions(const samples::Raster* heights, const samples::Raster* image,
                           tks_encode_options options) {
  options.regions = 16;
  if (options.index == TKS_INDEX_NONE) options.index = TKS_INDEX_PACKETS;
  return encode(heights, image, options);
}

/// Heights and a texture in regions, with the stream that is both.
struct IndexedTerrain {
  samples::Raster heights = samples::make({samples::Pattern::kRidges, 90, 70, 1, TKS_I16});
  samples::Raster image = samples::make({samples::Pattern::kRidges, 61, 75, 3, TKS_U8});
  Bytes bytes = encodeRegions(&heights, &image, lossless());
  size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
};

/// Squared error over the samples of a window.
inline double errorIn(const samples::Raster& raster, const std::vector<std::byte>& decoded,
                      const tks_window& w) {
  double sum = 0;
  for (uint32_t y = w.y; y < w.y + w.height; ++y) {
    for (uint32_t i = w.x * raster.channels; i < (w.x + w.width) * raster.channels; ++i) {
      const size_t at = size_t{y} * raster.width * raster.channels + i;
      const double d =
          sampleAt(decoded, raster.sample, at) - sampleAt(raster.data, raster.sample, at);
      sum += d * d;
    }
  }
  return sum;
}

}  // namespace tetrakis::test
