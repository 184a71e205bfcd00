// SPDX-License-Identifier: Apache-2.0
// Samples, and decoded heights from which corrections restore them.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <vector>

#include "codec/geometry/steps/decoded_heights.hpp"
#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::test {

inline constexpr uint32_t kWidth = 41, kHeight = 23;
inline constexpr size_t kSamples = size_t{kWidth} * kHeight;

inline tks_heights heightsOf(const samples::Raster& raster) {
  tks_heights heights = {};
  heights.size = sizeof heights;
  heights.data = raster.data.data();
  heights.width = raster.width;
  heights.height = raster.height;
  heights.sample = raster.sample;
  heights.scale = 1;
  return heights;
}

/// Bits of samples; floats of them are numbers of all sizes, infinities and NaNs.
inline samples::Raster anySamples(tks_sample type, uint32_t seed) {
  samples::Raster raster{kWidth, kHeight, 1, type, {}};
  raster.data.resize(kSamples * tks_sample_bytes(type));
  for (size_t i = 0; i < raster.data.size(); ++i)
    raster.data[i] = std::byte(samples::hash(static_cast<uint32_t>(i), seed, 81) & 255);
  return raster;
}

/// Heights that a decoder may have of any samples.
inline DecodedHeights roughly(uint32_t seed, int fraction_bits, bool with_voids) {
  DecodedHeights decoded;
  DecodedGeometry& geometry = decoded.geometry;
  geometry.width = kWidth;
  geometry.height = kHeight;
  geometry.fraction_bits = fraction_bits;
  for (uint32_t i = 0; i < kSamples; ++i) {
    geometry.heights.push_back(static_cast<int32_t>(samples::hash(i, seed, 82)) >> 8);
    if (with_voids) geometry.valid.push_back(samples::hash(i, seed, 83) % 4 != 0);
  }
  return decoded;
}

inline std::vector<std::byte> samplesOf(const DecodedHeights& decoded,
                                        const GeometryHeader& header) {
  GeometryLayers layers;
  layers.has_nodata = 1;
  layers.nodata = 1e9;  // which no sample has
  std::vector<std::byte> out(kSamples * tks_sample_bytes(static_cast<tks_sample>(header.sample)));
  fromSteps(decoded, header, layers, out.data());
  return out;
}

inline GeometryHeader headerOf(tks_sample type) {
  GeometryHeader header;
  header.width = kWidth;
  header.height = kHeight;
  header.sample = static_cast<uint8_t>(type);
  header.base = 100;
  header.step = 0.25;
  return header;
}

inline samples::Raster floatsOf(uint32_t width, uint32_t height,
                                const std::function<double(uint32_t x, uint32_t y)>& sample) {
  samples::Raster raster{width, height, 1, TKS_F32, {}};
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const auto value = static_cast<float>(sample(x, y));
      const auto* bytes = reinterpret_cast<const std::byte*>(&value);
      raster.data.insert(raster.data.end(), bytes, bytes + sizeof value);
    }
  }
  return raster;
}

/// Of the first prefixes and each seventh behind: samples are restored one after the other; the
/// others stay as they were. raster: floats, which the codeword restores. near: with voids.
/// restore: what decoders make of a prefix.
inline void expectPrefixesRestoreTheFirst(
    const samples::Raster& raster, const DecodedHeights& near, const GeometryHeader& header,
    std::span<const uint8_t> codeword,
    const std::function<DecodedHeights(std::span<const uint8_t> prefix)>& restore) {
  const std::vector<std::byte> before = samplesOf(near, header);
  constexpr size_t kEach = 64;
  size_t known = 0;
  for (size_t n = 0; n <= codeword.size();
       n += n < kEach || n + 7 > codeword.size() ? size_t{1} : size_t{7}) {
    const std::vector<std::byte> out = samplesOf(restore(codeword.first(n)), header);
    size_t changed = 0;
    for (size_t i = 0; i < kSamples; ++i) {
      const bool same = std::memcmp(&out[4 * i], &before[4 * i], 4) == 0;
      if (!near.geometry.valid[i] || same) continue;
      changed = i + 1;
      ASSERT_EQ(std::memcmp(&out[4 * i], &raster.data[4 * i], 4), 0) << n << " bytes, " << i;
    }
    ASSERT_GE(changed, known) << n;
    known = changed;
  }
  EXPECT_GT(known, kSamples - 10);
}

}  // namespace tetrakis::test
