// SPDX-License-Identifier: Apache-2.0
// Heights in regions whose corrections are tracks of their own.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/scattered_packets.hpp"
#include "conformance/samples/offset_heights.hpp"
#include "tests/support/indexed_terrain.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

constexpr uint32_t kWidth = 150, kHeight = 140;

struct CorrectedCase {
  std::string name;
  Raster heights;
  double max_error;  ///< 0: lossless
  CorrectionKind kind;
};

/// A smooth surface in whole steps: exact corrections take fewer bytes than its last bit-planes.
Raster smoothSteps() {
  Raster raster = make({Pattern::kRidges, kWidth, kHeight, 1, TKS_I16});
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    const double x = i % kWidth, y = i / kWidth;
    const auto step = static_cast<int16_t>(
        std::lround(900 + 70 * std::sin(x / 19 + y / 43) + 50 * std::cos(y / 17) + x));
    std::memcpy(raster.data.data() + 2 * size_t{i}, &step, 2);
  }
  return raster;
}

Raster roots() {
  Raster raster = make({Pattern::kRidges, kWidth, kHeight, 1, TKS_F32});
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    const auto root =
        static_cast<float>(std::sqrt(std::abs(sampleAt(raster.data, TKS_F32, i)) + 1) * 9);
    std::memcpy(raster.data.data() + 4 * size_t{i}, &root, 4);
  }
  return raster;
}

/// Rough ground on no grid: coefficients of all levels count, and corrections follow.
Raster rough(uint32_t width, uint32_t height) {
  Raster raster = make({Pattern::kRidges, width, height, 1, TKS_F32});
  for (uint32_t i = 0; i < width * height; ++i) {
    const double x = i % width, y = i / width;
    const auto sample = static_cast<float>(400 + 300 * std::sin(x / 9) * std::cos(y / 7) +
                                           30 * std::sin(x * y / 50));
    std::memcpy(raster.data.data() + 4 * size_t{i}, &sample, 4);
  }
  return raster;
}

Raster aboveGeoid() {
  Raster whole = make({Pattern::kRidges, kWidth, kHeight, 1, TKS_U16, 3});
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
    const auto step = static_cast<uint16_t>(sampleAt(whole.data, TKS_U16, i) / 64);
    std::memcpy(whole.data.data() + 2 * i, &step, 2);
  }
  return samples::withOffsets(whole, samples::OffsetKind::kGeoid);
}

std::vector<CorrectedCase> cases() {
  return {{"exact", smoothSteps(), 0, CorrectionKind::kSteps},
          {"bounded", make({Pattern::kRidges, kWidth, kHeight, 1, TKS_U16}), 1500,
           CorrectionKind::kSteps},
          {"gridless", roots(), 0, CorrectionKind::kSamples},
          {"geoid", aboveGeoid(), 0, CorrectionKind::kRelative}};
}

Bytes encodeCase(const CorrectedCase& corrected, uint32_t threads = 1) {
  tks_encode_options options = inRegions(lossless(), 32);
  if (corrected.max_error > 0) {
    options.lossless = 0;
    options.max_error = corrected.max_error;
  }
  options.index = TKS_INDEX_PACKETS;
  options.threads = threads;
  return encode(&corrected.heights, nullptr, options);
}

double largestError(const Raster& heights, const std::vector<std::byte>& decoded) {
  double largest = 0;
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
    const double error =
        sampleAt(heights.data, heights.sample, i) - sampleAt(decoded, heights.sample, i);
    largest = std::max(largest, std::abs(error));
  }
  return largest;
}

TEST(CorrectionTracks, KeepWhatWasPromised) {
  for (const CorrectedCase& corrected : cases()) {
    SCOPED_TRACE(corrected.name);
    const Bytes bytes = encodeCase(corrected);
    const auto parsed = readHeader(bytes);
    ASSERT_TRUE(parsed.ok());
    EXPECT_EQ(parsed->header.layers.corrections, corrected.kind);
    EXPECT_EQ(correctionTracks(*parsed->header.geometry, parsed->header.layers), 20u);
    EXPECT_LE(largestError(corrected.heights, Stream(bytes).heights()), corrected.max_error);
    EXPECT_TRUE(encodeCase(corrected, 3) == bytes) << "threads";
  }
}

TEST(CorrectionTracks, WindowsFit) {
  for (const CorrectedCase& corrected : cases()) {
    SCOPED_TRACE(corrected.name);
    expectWindows(encodeCase(corrected));
  }
}

/// Corrections belong to the samples: a window of a level takes the regions around it, not those
/// that lie around the same columns and rows of the samples.
TEST(CorrectionTracks, LevelWindowsFit) {
  constexpr uint32_t kWide = 300, kHigh = 260;
  const Raster heights = rough(kWide, kHigh);
  const Bytes bytes = encode(&heights, nullptr, inRegions(lossless(), 16));
  const auto parsed = readHeader(bytes);
  ASSERT_TRUE(parsed.ok());
  ASSERT_GT(correctionTracks(*parsed->header.geometry, parsed->header.layers), 1u);
  for (uint32_t level = 1; level <= 3; ++level) {
    const Stream stream(bytes);
    ASSERT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
    const uint32_t width = ((kWide - 1) >> level) + 1, height = ((kHigh - 1) >> level) + 1;
    std::vector<std::byte> all(sizeof(float) * width * height);
    ASSERT_EQ(tks_decode_heights(stream.get(), all.data(), all.size()), TKS_OK);
    for (uint32_t trial = 0; trial < 20; ++trial) {
      const tks_window window = windowOf(trial, width, height);
      const Stream another(bytes);  // which has taken no track for the level
      ASSERT_EQ(tks_set_levels(another.get(), level, 0), TKS_OK);
      ASSERT_NO_FATAL_FAILURE(
          expectWindow(another, tks_decode_heights_window, window,
                       cropBytes(all, sizeof(float) * width, sizeof(float), window)))
          << "level " << level;
    }
  }
}

/// Corrections come behind all coefficients, so that no prefix corrects what is still to change.
TEST(CorrectionTracks, ComeLast) {
  for (const CorrectedCase& corrected : cases()) {
    SCOPED_TRACE(corrected.name);
    const auto parsed = readHeader(encodeCase(corrected));
    ASSERT_TRUE(parsed.ok());
    const uint64_t coefficients = coefficientTracks(*parsed->header.geometry);
    const auto of_corrections = [&](const IndexEntry& entry) {
      return entry.packet.track >= coefficients;
    };
    EXPECT_TRUE(std::is_partitioned(parsed->header.index.begin(), parsed->header.index.end(),
                                    [&](const auto& entry) { return !of_corrections(entry); }));
    EXPECT_TRUE(of_corrections(parsed->header.index.back()));
  }
}

/// While coefficients lack a packet, the corrections of regions that it reaches are not used.
TEST(CorrectionTracks, WaitForTheirCoefficients) {
  for (const CorrectedCase& corrected : cases()) {
    SCOPED_TRACE(corrected.name);
    const Bytes bytes = encodeCase(corrected);
    const auto parsed = readHeader(bytes);
    ASSERT_TRUE(parsed.ok());
    const uint64_t coefficients = coefficientTracks(*parsed->header.geometry);
    const IndexedPackets packets(parsed->header, parsed->bytes);
    std::vector<IndexedPacket> list;
    for (const IndexedPacket& packet : packets) list.push_back(packet);
    const auto is_last = [&](const IndexedPacket& p) {
      return p.entry.packet.track < coefficients;
    };
    const size_t missing = static_cast<size_t>(
        std::find_if(list.rbegin(), list.rend(), is_last).base() - list.begin() - 1);
    Stream some(Prefix(bytes).first(parsed->bytes)), without(Prefix(bytes).first(parsed->bytes));
    for (size_t i = 0; i < list.size(); ++i) {
      if (i == missing) continue;
      const IndexedPacket& p = list[i];
      const auto put = [&](Stream& stream) {
        ASSERT_EQ(tks_put(stream.get(), p.begin, bytes.data() + p.begin, p.end - p.begin), TKS_OK);
      };
      put(some);
      if (p.entry.packet.track < coefficients) put(without);
    }
    const std::vector<std::byte> now = some.heights(), lossy = without.heights();
    for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
      const tks_sample type = corrected.heights.sample;
      const double sample = sampleAt(now, type, i);
      const double error = std::abs(sample - sampleAt(corrected.heights.data, type, i));
      ASSERT_TRUE(sample == sampleAt(lossy, type, i) || error <= corrected.max_error) << i;
    }
    const IndexedPacket& p = list[missing];
    ASSERT_EQ(tks_put(some.get(), p.begin, bytes.data() + p.begin, p.end - p.begin), TKS_OK);
    EXPECT_LE(largestError(corrected.heights, some.heights()), corrected.max_error);
  }
}

/// For cameras, too, corrections come behind all coefficients, those of seen ground first.
TEST(CorrectionTracks, ComeLastForCameras) {
  const tks_screen_camera view = mapOf(0, 0, 40, 40);
  for (const CorrectedCase& corrected : cases()) {
    SCOPED_TRACE(corrected.name);
    const Bytes bytes = encodeCase(corrected);
    Stream stream(bytes);
    tks_buffer buffer = {};
    ASSERT_EQ(tks_reorder(stream.get(), &view, 1, &buffer), TKS_OK) << stream.message();
    const Bytes order(buffer.data, buffer.data + buffer.size);
    tks_free_buffer(&buffer);
    EXPECT_LE(largestError(corrected.heights, Stream(order).heights()), corrected.max_error);
    const auto parsed = readHeader(order);
    ASSERT_TRUE(parsed.ok());
    const uint64_t coefficients = coefficientTracks(*parsed->header.geometry);
    const auto is_coefficient = [&](const IndexEntry& e) { return e.packet.track < coefficients; };
    const auto& index = parsed->header.index;
    EXPECT_TRUE(std::is_partitioned(index.begin(), index.end(), is_coefficient));
    const auto first = std::partition_point(index.begin(), index.end(), is_coefficient);
    ASSERT_NE(first, index.end());
    EXPECT_EQ(first->packet.track, coefficients) << "seen ground";
  }
}

TEST(CorrectionTracks, CostLittle) {
  for (const CorrectedCase& corrected : cases()) {
    SCOPED_TRACE(corrected.name);
    tks_encode_options options = inRegions(lossless(), 1);
    options.lossless = corrected.max_error == 0;
    options.max_error = corrected.max_error;
    const size_t one = encode(&corrected.heights, nullptr, options).size();
    EXPECT_LT(encodeCase(corrected).size(), one + one / 4 + 1500);  // 20 regions and their index
  }
}

/// A budget that lossless heights have room in ends exact, and its prefixes are those of a smaller
/// one.
TEST(CorrectionTracks, EndBudgetsThatHaveRoom) {
  for (const CorrectedCase& corrected : cases()) {
    if (corrected.max_error > 0) continue;
    SCOPED_TRACE(corrected.name);
    const size_t lossless_bytes = encodeCase(corrected).size();
    const Bytes ample = encode(&corrected.heights, nullptr,
                               inRegions(budget(2 * lossless_bytes + 20000), 32)),
                little =
                    encode(&corrected.heights, nullptr, inRegions(budget(lossless_bytes / 4), 32));
    EXPECT_EQ(Stream(ample).info().lossless, 1);
    EXPECT_LT(ample.size(), lossless_bytes * 3 / 2);
    EXPECT_EQ(largestError(corrected.heights, Stream(ample).heights()), 0);
    const double cut =
        squaredError(corrected.heights, Stream(Prefix(ample).first(little.size())).heights());
    EXPECT_LT(cut, 1.1 * squaredError(corrected.heights, Stream(little).heights()));
  }
}

}  // namespace
}  // namespace tetrakis::test
