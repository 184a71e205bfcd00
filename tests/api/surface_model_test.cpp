// SPDX-License-Identifier: Apache-2.0
// Surface models of towns: walls, flat roofs, and the noise of a scanner. No way to code them may
// be better than the one that the encoder takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::Raster;

constexpr uint32_t kSide = 160;

template <class F>
Raster rasterOf(tks_sample sample, F height) {
  Raster raster = samples::make({samples::Pattern::kFlat, kSide, kSide, 1, sample});
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    const auto value = height(i % kSide, i / kSide);
    std::memcpy(raster.data.data() + i * sizeof value, &value, sizeof value);
  }
  return raster;
}

/// In metres: roofs on a slope, and some centimetres of noise.
Raster town() {
  uint32_t noise = 1;
  return rasterOf(TKS_F32, [&](uint32_t x, uint32_t y) {
    const uint32_t lot = (x / 25) * 31 + (y / 23) * 17;
    const bool roof = x % 25 < 9 + lot % 11 && y % 23 < 8 + lot % 13;
    noise = noise * 1664525 + 1013904223;
    const double metres = (roof ? 14 + 3 * (lot % 5) : 5 + 0.02 * x + 0.01 * y);
    return static_cast<float>(metres + ((noise >> 8) * 0x1p-24 - 0.5) * 0.1);
  });
}

/// Within a largest error no more bytes are taken than by heights that the caller has rounded.
TEST(SurfaceModels, WithinABoundTakeNoMoreThanRoundedOnes) {
  const Raster surface = town();
  std::vector<float> metres(kSide * kSide);
  std::memcpy(metres.data(), surface.data.data(), surface.data.size());
  for (const double error : {0.05, 0.1, 0.25, 1.0}) {
    tks_encode_options options = budget(0);
    options.max_error = error;
    const Raster rounded = rasterOf(TKS_I16, [&](uint32_t x, uint32_t y) {
      return static_cast<int16_t>(std::lround(metres[y * kSide + x] / (2 * error)));
    });
    const Bytes bounded = encode(&surface, nullptr, options);
    const size_t of_rounded = encode(&rounded, nullptr, lossless()).size();
    EXPECT_LE(bounded.size(), of_rounded + of_rounded / 100 + 100) << error;
  }
}

/// At many bits a sample the filters are others than at few.
TEST(SurfaceModels, AreAsGoodAsCutsOfLosslessStreams) {
  const Raster surface = town();
  const Bytes whole = encode(&surface, nullptr, lossless());
  for (const double bits : {4., 5., 6.}) {
    const auto bytes = static_cast<uint64_t>(bits * kSide * kSide / 8);
    const double of_cut = squaredError(surface, Stream(Prefix(whole).first(bytes)).heights());
    const double of_lossy =
        squaredError(surface, Stream(encode(&surface, nullptr, budget(bytes))).heights());
    EXPECT_LT(of_lossy, 1.1 * of_cut) << bits;
  }
}

/// Squares of distances are few values, and smooth in multiples of a step.
TEST(SurfaceModels, OfSquaredDistancesNeedNoTable) {
  const Raster squares = rasterOf(TKS_I32, [](uint32_t x, uint32_t y) {
    int32_t least = INT32_MAX;
    for (const auto& [px, py] : {std::pair{20, 30}, {130, 40}, {70, 120}, {150, 150}}) {
      const int32_t dx = int32_t(x) - px, dy = int32_t(y) - py;
      least = std::min(least, dx * dx + dy * dy);
    }
    return least;
  });
  const size_t exact = encode(&squares, nullptr, lossless()).size();
  const Bytes ample = encode(&squares, nullptr, budget(2 * exact));
  EXPECT_TRUE(Stream(ample).heights() == squares.data);
  EXPECT_LE(exact, ample.size() + ample.size() / 20);
}

}  // namespace
}  // namespace tetrakis::test
