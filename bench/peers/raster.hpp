// SPDX-License-Identifier: Apache-2.0
// The integer samples that every codec of a benchmark is given, and how files become them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// A height field (one channel, up to 16 bits) or an 8-bit image (one or three channels).
struct Raster {
  uint32_t width = 0, height = 0, channels = 1;
  int bits = 8;                   ///< every sample < 2^bits, 1 to 16
  double unit = 1;                ///< what one step of a sample means, e.g. metres
  std::vector<uint16_t> samples;  ///< width * height * channels, interleaved
  std::vector<uint8_t> real;  ///< width * height; 0: a hole that no error counts; empty: no holes

  size_t pixels() const { return size_t{width} * height; }
};

/// Samples of that type, one after the other, as doubles.
std::vector<double> samplesOf(std::span<const std::byte> data, tks_sample sample);

/// Integer heights whose range fits 16 bits keep their step, less their minimum; all others are
/// quantised to 2^16 levels over their range. NaN and the file's nodata value become holes, filled
/// smoothly so that no codec pays for them. Fails on a field that holds no height.
Result<Raster> heightRaster(const tools::HeightFile& file);

/// 8 bits a channel (16-bit files are rounded); RGB, or one channel for grey; alpha is dropped.
Raster imageRaster(const tools::ImageFile& file);

/// The central part of the same shape with at most `max_pixels` pixels.
Raster cropCentre(const Raster& raster, uint64_t max_pixels);

/// width x height pixels around the centre of the raster, mirrored at its borders where it ends.
Raster mirrorTo(const Raster& raster, uint32_t width, uint32_t height);

/// Mean squared error over the real samples of all channels, in squared sample steps.
/// decoded: as many values as raster.samples.
double meanSquaredError(const Raster& raster, const std::vector<uint16_t>& decoded);
double meanSquaredError(const Raster& raster, const std::vector<float>& decoded);

}  // namespace tetrakis::bench
