// SPDX-License-Identifier: Apache-2.0
// Heights that are hard to take: every bit pattern of a float, integers of all 32 bits, bounds
// below any step, infinities. What happens is what include/tetrakis/tetrakis.h says.
#include <bit>
#include <limits>
#include <random>

#include "bitstream/stream/header.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

template <class T>
Raster rasterOf(const std::vector<T>& values, uint32_t width, tks_sample sample) {
  Raster raster{width, static_cast<uint32_t>(values.size() / width), 1, sample, {}};
  raster.data.resize(values.size() * sizeof(T));
  std::memcpy(raster.data.data(), values.data(), raster.data.size());
  return raster;
}

void expectRestored(const Raster& raster) {
  const Bytes bytes = encode(&raster, nullptr, lossless());
  Stream stream(bytes);
  ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
  EXPECT_TRUE(stream.info().lossless);
  EXPECT_TRUE(sameBytes(stream.heights(), raster.data));
}

TEST(HostileHeights, AnyFiniteBitPatternsComeBack) {
  std::mt19937 random(1);
  for (const uint32_t width : {2u, 5u, 11u}) {
    std::vector<float> values;
    while (values.size() < width * 24u) {
      const auto value = std::bit_cast<float>(static_cast<uint32_t>(random()));
      if (std::isfinite(value)) values.push_back(value);
    }
    expectRestored(rasterOf(values, width, TKS_F32));
  }
}

/// What is decoded of a part of them is as finite as they are.
TEST(HostileHeights, PrefixesOfTheLargestFloatsAreFinite) {
  constexpr float kMost = std::numeric_limits<float>::max();
  std::vector<float> checkers;
  for (uint32_t i = 0; i < 32 * 32; ++i) checkers.push_back((i + i / 32) % 2 ? kMost : -kMost);
  const Raster raster = rasterOf(checkers, 32, TKS_F32);
  for (const tks_encode_options& options : {lossless(), budget(400)}) {
    const Bytes bytes = encode(&raster, nullptr, options);
    const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    for (size_t length = header; length <= bytes.size(); ++length) {
      const std::vector<std::byte> decoded = Stream(Prefix(bytes).first(length)).heights();
      for (size_t i = 0; i < checkers.size(); ++i) {
        float value;
        std::memcpy(&value, &decoded[4 * i], 4);
        ASSERT_TRUE(std::isfinite(value)) << length;
      }
    }
  }
}

TEST(HostileHeights, ZerosOfBothSignsAndSubnormals) {
  constexpr float kTiny = std::numeric_limits<float>::denorm_min();
  expectRestored(rasterOf<float>({0.0f, -0.0f, 0.0f, -0.0f}, 2, TKS_F32));
  expectRestored(rasterOf<float>({-0.0f, -0.0f, -0.0f, -0.0f}, 2, TKS_F32));
  expectRestored(rasterOf<float>({kTiny, -kTiny, 0.0f, 3 * kTiny, -0.0f, 1e-40f}, 3, TKS_F32));
  expectRestored(rasterOf<float>({kTiny, 8848.0f, -1e-39f, 0.1f, 1e-30f, 1e30f}, 2, TKS_F32));
}

TEST(HostileHeights, MeasuredFloatsOfFullPrecision) {
  const Raster ridges = make({Pattern::kRidges, 60, 40, 1, TKS_I32});
  std::vector<float> values;
  for (size_t i = 0; i < 2400; ++i) {
    values.push_back(static_cast<float>(sampleAt(ridges.data, TKS_I32, i) * 1e-3 / 3));
  }
  const Raster raster = rasterOf(values, 60, TKS_F32);
  expectRestored(raster);
  EXPECT_LT(encode(&raster, nullptr, lossless()).size(), raster.data.size() * 9 / 10);
}

TEST(HostileHeights, IntegersOfAll32Bits) {
  std::mt19937 random(2);
  std::vector<uint32_t> values(240);
  for (uint32_t& v : values) v = static_cast<uint32_t>(random());
  values[0] = 0;
  values[1] = 0xffffffff;
  expectRestored(rasterOf(values, 20, TKS_U32));
  expectRestored(rasterOf(values, 30, TKS_I32));
}

/// Infinity is no height: refused with its place, unless it is the nodata value.
TEST(HostileHeights, InfinityIsRefusedOrVoid) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Raster raster = rasterOf<float>({1, 2, 3, 4, 5, -kInfinity}, 2, TKS_F32);
  tks_heights heights = raster.heights();
  const tks_encode_options options = lossless();
  tks_buffer buffer = {};
  char message[256] = "";
  EXPECT_EQ(tks_encode(&heights, nullptr, &options, &buffer, message, sizeof message), TKS_USAGE);
  EXPECT_NE(std::string(message).find("column 1, row 2"), std::string::npos) << message;
  heights.has_nodata = 1;
  heights.nodata = static_cast<double>(-kInfinity);
  const Bytes bytes = encodeHeights(heights, options);
  Stream stream(bytes);
  EXPECT_TRUE(sameBytes(stream.heights(), raster.data));
}

/// Ground of whole metres, as floats.
std::vector<float> wholeMetres(uint32_t side) {
  const Raster ridges = make({Pattern::kRidges, side, side, 1, TKS_U8});
  std::vector<float> values;
  for (size_t i = 0; i < size_t{side} * side; ++i)
    values.push_back(static_cast<float>(sampleAt(ridges.data, TKS_U8, i)));
  return values;
}

size_t losslessBytes(const Raster& raster) {
  const Bytes bytes = encode(&raster, nullptr, lossless());
  Stream stream(bytes);
  EXPECT_TRUE(sameBytes(stream.heights(), raster.data));
  return bytes.size();
}

/// What one sample is must not make all the others finer.
TEST(HostileHeights, AnOddSampleCostsAFewBytes) {
  const std::vector<float> plain = wholeMetres(96);
  const size_t before = losslessBytes(rasterOf(plain, 96, TKS_F32));
  for (const float odd : {-0.0f, 0.37f, 1e-42f, 1e30f, -3.4028235e38f, 3.4028235e38f, -9999.5f}) {
    std::vector<float> values = plain;
    values[1234] = odd;
    EXPECT_LT(losslessBytes(rasterOf(values, 96, TKS_F32)), before + 300) << odd;
  }
}

/// Rounding makes them, as many as there is sea.
TEST(HostileHeights, NegativeZerosCostLittle) {
  std::vector<float> sea = wholeMetres(96);
  for (float& v : sea) v = std::max(v - 100, 0.0f);
  const size_t before = losslessBytes(rasterOf(sea, 96, TKS_F32));
  for (size_t i = 0; i < sea.size(); ++i) {
    if (sea[i] == 0 && i / 96 < 48) sea[i] = -0.0f;
  }
  EXPECT_LT(losslessBytes(rasterOf(sea, 96, TKS_F32)), before + before / 8);
}

/// An undeclared void of 3.4e38 takes neither the bound nor the budget from the rest.
TEST(HostileHeights, AnOutlierDoesNotDrownTheRest) {
  std::vector<float> values = wholeMetres(300);
  for (float& v : values) v *= 1.37f;
  values[777] = std::numeric_limits<float>::max();
  const Raster raster = rasterOf(values, 300, TKS_F32);
  tks_encode_options bounded = lossless();
  bounded.lossless = 0;
  bounded.max_error = 0.5;
  EXPECT_LE(largestError(raster, Stream(encode(&raster, nullptr, bounded)).heights()), 0.5);
  const auto decoded = Stream(encode(&raster, nullptr, budget(20000))).heights();
  double squares = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const double error = i == 777 ? 0 : sampleAt(decoded, TKS_F32, i) - double{values[i]};
    squares += error * error;
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(values.size())), 10);
}

/// Noise takes what it takes and a header, of every type, beside voids and in textures.
TEST(HostileHeights, NoiseIsStored) {
  for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_U32, TKS_F32}) {
    std::mt19937 random(3);
    Raster raster{30, 21, 1, sample, {}};
    while (raster.data.size() < size_t{30} * 21 * tks_sample_bytes(sample)) {
      auto byte = static_cast<uint8_t>(random());
      const bool exponent = sample == TKS_F32 && raster.data.size() % 4 == 3;
      if (exponent && (byte & 0x7f) == 0x7f) byte = 0;  // neither infinite nor NaN
      raster.data.push_back(static_cast<std::byte>(byte));
    }
    const Bytes bytes = encode(&raster, nullptr, lossless());
    EXPECT_LE(bytes.size(), raster.data.size() + 80);
    for (auto cut = static_cast<size_t>(Stream(bytes).info().header_bytes); cut < bytes.size();
         cut += 97) {
      Stream stream(Prefix(bytes).first(cut));
      EXPECT_EQ(stream.heights().size(), raster.data.size());
    }
    Stream stream(bytes);
    EXPECT_EQ(stream.info().heights_drawn, 3);
    EXPECT_TRUE(sameBytes(stream.heights(), raster.data));
  }
}

TEST(HostileHeights, NoiseInTexturesIsStored) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    std::mt19937 random(4);
    Raster image{40, 50, 3, sample, {}};
    while (image.data.size() < size_t{40} * 50 * 3 * tks_sample_bytes(sample))
      image.data.push_back(static_cast<std::byte>(random()));
    const Bytes bytes = encode(nullptr, &image, lossless());
    EXPECT_LE(bytes.size(), image.data.size() + 64);
    Stream stream(bytes);
    EXPECT_EQ(stream.info().texture_drawn, 3);
    EXPECT_TRUE(sameBytes(stream.texture(), image.data));
    expectTextureWindow(stream, {7, 9, 12, 5}, image.data);
  }
}

/// Each prefix of a stored plane is nearer to it, byte by byte of the samples.
TEST(HostileHeights, StoredSamplesComeHighBytesFirst) {
  std::mt19937 random(5);
  std::vector<uint16_t> values(600);
  for (uint16_t& v : values) v = static_cast<uint16_t>(random());
  const Raster raster = rasterOf(values, 30, TKS_U16);
  const Bytes bytes = encode(&raster, nullptr, lossless());
  const Stream whole(bytes);
  const size_t header = static_cast<size_t>(whole.info().header_bytes);
  double before = std::numeric_limits<double>::infinity();
  for (const size_t end : {header, header + 300, header + 603, header + 900, bytes.size()}) {
    Stream stream(Prefix(bytes).first(end));
    const double squares = squaredError(raster, stream.heights());
    EXPECT_LT(squares, before);
    before = squares;
  }
  EXPECT_EQ(before, 0);
}

/// A nodata value that the type cannot hold voids nothing, and the proof of a bound knows that:
/// whatever a conversion makes of it is a height.
TEST(HostileHeights, NodataBeyondTheTypeMeetsNoSample) {
  const Raster raster = make({Pattern::kRidges, 24, 20, 1, TKS_U8});
  for (double nodata = 256; nodata < 512; nodata += 1) {
    tks_heights heights = raster.heights();
    heights.has_nodata = 1;
    heights.nodata = nodata;
    SCOPED_TRACE(nodata);
    const Bytes bytes = encodeHeights(heights, within(2));
    Stream stream(bytes);
    EXPECT_LE(largestError(raster, stream.heights()), 2);
  }
}

TEST(ErrorBound, HoldsForAllTypesPatternsAndBounds) {
  for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_U16, TKS_I32, TKS_U32, TKS_F32}) {
    for (const Pattern pattern : {Pattern::kRidges, Pattern::kSteps, Pattern::kExtreme}) {
      for (const double error : {0.001, 0.5, 1.0, 7.5, 300.0}) {
        // The small one is audited at every byte by the encoder, the large one at every point.
        const bool large = error == 7.5 && (pattern == Pattern::kRidges || sample == TKS_I16);
        const Raster raster = make({pattern, large ? 50u : 9u, large ? 45u : 7u, 1, sample});
        const Bytes bytes = encode(&raster, nullptr, within(error));
        Stream stream(bytes);
        ASSERT_LE(largestError(raster, stream.heights()), error)
            << int(sample) << " " << int(pattern);
        EXPECT_EQ(stream.info().max_error, error);
      }
    }
  }
}

/// A bound that no 2^26 steps reach: bit for bit instead.
/// What is drawn is the samples, rounded to a float in the unit: all of it, windows, and meshes
/// whose vertices are samples.
TEST(ErrorBound, HoldsForSurfacesAndMeshesOfEverySample) {
  for (const tks_sample sample : {TKS_U8, TKS_I8, TKS_I16, TKS_U16, TKS_I32, TKS_U32, TKS_F32}) {
    const Raster raster = make({Pattern::kRidges, 37, 29, 1, sample});
    tks_heights heights = raster.heights();
    heights.scale = 0.1;
    heights.offset = -20;
    for (const tks_encode_options& options : {lossless(), within(0.1), within(0.5), within(40)}) {
      const Bytes bytes = encodeHeights(heights, options);
      Stream stream(bytes);
      const std::vector<std::byte> samples = stream.heights();
      const auto shown = [&](size_t i) {
        return static_cast<float>(sampleAt(samples, sample, i) * 0.1 - 20);
      };
      std::vector<float> surface(size_t{37} * 29), part(size_t{11} * 7);
      ASSERT_EQ(tks_decode_surface(stream.get(), surface.data(), surface.size()), TKS_OK);
      for (size_t i = 0; i < surface.size(); ++i) ASSERT_EQ(surface[i], shown(i)) << i;
      const tks_window window{20, 15, 11, 7};
      ASSERT_EQ(tks_decode_surface_window(stream.get(), &window, part.data(), part.size()), TKS_OK);
      EXPECT_EQ(part.back(), surface[size_t{21} * 37 + 30]);
      for (const tks_mesh_kind kind : {TKS_MESH_BUDGET, TKS_MESH_CODED}) {
        tks_mesh mesh{};
        ASSERT_EQ(tks_decode_mesh(stream.get(), kind, 0, &mesh), TKS_OK);
        for (uint32_t v = 0; v < mesh.vertex_count; ++v)
          ASSERT_EQ(mesh.height[v], shown(mesh.grid_index[v])) << v;
        tks_free_mesh(&mesh);
      }
    }
  }
}

TEST(ErrorBound, FinerThanAnyStepIsLossless) {
  const Raster raster = rasterOf<float>({1e-30f, 1e30f, 3.3f, -7e12f}, 2, TKS_F32);
  const Bytes bytes = encode(&raster, nullptr, within(1e-20));
  Stream stream(bytes);
  EXPECT_TRUE(stream.info().lossless);
  EXPECT_TRUE(sameBytes(stream.heights(), raster.data));
}

/// A step that is given is taken as it is: a bound below it is refused.
TEST(ErrorBound, FinerThanTheGivenStepIsRefused) {
  const Raster raster = make({Pattern::kRidges, 20, 20, 1, TKS_F32});
  tks_heights heights = raster.heights();
  heights.step = 5;
  tks_buffer buffer = {};
  const tks_encode_options finer = within(1);
  EXPECT_EQ(tks_encode(&heights, nullptr, &finer, &buffer, nullptr, 0), TKS_USAGE);
  const Bytes bytes = encodeHeights(heights, within(4));
  Stream stream(bytes);
  EXPECT_LE(largestError(raster, stream.heights()), 4);
}

/// Cut late enough to do without corrections, the same bound takes far more bytes than this.
TEST(ErrorBound, IsCheaperThanItsLosslessStream) {
  const Raster raster = make({Pattern::kRidges, 129, 129, 1, TKS_I16});
  const size_t whole = encode(&raster, nullptr, lossless()).size();
  size_t before = whole;
  for (const double error : {10.0, 100.0, 1000.0, 8000.0}) {
    const size_t bytes = encode(&raster, nullptr, within(error)).size();
    EXPECT_LT(bytes, before) << error;
    before = bytes;
  }
  EXPECT_LT(before, whole / 20);
}

/// Within the bound the multiples of a unit that samples lie near will do.
TEST(ErrorBound, HeightsNearAGridCostWhatTheGridDoes) {
  constexpr uint32_t kSide = 64;
  for (const double unit : {1.0, 0.3048}) {
    std::vector<float> whole, near;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      const double wave = 40 * std::sin(i % kSide / 17.0) * std::cos(double(i / kSide) / 11);
      const double multiple = unit * std::round(wave + i * 2654435761U % 3);
      whole.push_back(static_cast<float>(multiple));
      near.push_back(static_cast<float>(multiple + i * 40503U % 1000 * 1e-6 - 5e-4));
    }
    const Raster of_whole = rasterOf(whole, kSide, TKS_F32);
    const size_t exact = encode(&of_whole, nullptr, lossless()).size();
    const Raster raster = rasterOf(near, kSide, TKS_F32);
    for (const double error : {0.001, 0.1}) {
      const Bytes bytes = encode(&raster, nullptr, within(error));
      EXPECT_LE(largestError(raster, Stream(bytes).heights()), error) << unit;
      EXPECT_LE(bytes.size(), exact + exact / 50 + 16) << unit << ", within " << error;
    }
  }
}

/// Every prefix of a stream with corrections decodes, and the bound is reached by the last byte.
TEST(ErrorBound, PrefixesImprove) {
  const Raster raster = make({Pattern::kRidges, 27, 31, 1, TKS_I16});
  const Bytes bytes = encode(&raster, nullptr, within(1200));
  double best = std::numeric_limits<double>::infinity();
  for (size_t n = 0; n <= bytes.size(); ++n) {
    Stream stream(Prefix(bytes).first(n));
    if (stream.status() == TKS_TRUNCATED) continue;
    const double squares = squaredError(raster, stream.heights());
    ASSERT_LE(squares, 1.02 * best) << "at byte " << n << " of " << bytes.size();
    best = std::min(best, squares);
  }
}

}  // namespace
}  // namespace tetrakis::test
