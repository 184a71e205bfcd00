// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder, which was written from docs/FORMAT.md alone: for every
// prefix of every stream, whole or damaged, both give the same bytes or both refuse.
#include <optional>
#include <string>
#include <utility>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/few_values.hpp"
#include "conformance/samples/header_seal.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/reference_status.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// The byte where two rasters part; their size if they do not.
size_t firstDifference(const std::optional<Bytes>& expected, const std::vector<std::byte>& actual) {
  if (!expected) return 0;
  const auto same = [](uint8_t a, std::byte b) { return a == std::to_integer<uint8_t>(b); };
  return static_cast<size_t>(
      std::mismatch(expected->begin(), expected->end(), actual.begin(), actual.end(), same).first -
      expected->begin());
}

/// Both decoders on the same bytes.
void expectAgreement(Prefix prefix) {
  const tks_limits limits = smallLimits();
  const reference::Decoded decoded = reference::decode(prefix, limits.max_samples);
  Stream stream(prefix, &limits);
  ASSERT_EQ(stream.status(), statusOf(decoded.outcome)) << stream.message();
  if (stream.status() != TKS_OK) return;
  ASSERT_EQ(decoded.heights.has_value(), stream.info().has_heights != 0);
  ASSERT_EQ(decoded.texture.has_value(), stream.info().has_texture != 0);
  const std::vector<std::byte> heights = stream.heights(), texture = stream.texture();
  ASSERT_EQ(decoded.heights ? decoded.heights->size() : 0, heights.size());
  ASSERT_EQ(decoded.texture ? decoded.texture->size() : 0, texture.size());
  ASSERT_EQ(firstDifference(decoded.heights, heights), heights.size()) << "heights";
  ASSERT_EQ(firstDifference(decoded.texture, texture), texture.size()) << "texture";
}

void expectAgreementOnPrefixes(const Bytes& stream, size_t most = 24) {
  const size_t stride = std::max<size_t>(1, stream.size() / most);
  for (size_t n = 0; n <= stream.size(); n += stride) {
    SCOPED_TRACE("prefix of " + std::to_string(n) + " of " + std::to_string(stream.size()));
    expectAgreement(Prefix(stream).first(n));
    if (::testing::Test::HasFatalFailure()) return;
  }
  expectAgreement(stream);
}

/// Encodes both ways and compares prefixes.
void expectAgreementOn(const Raster* heights, const Raster* image, uint64_t bytes = 0) {
  const Bytes stream = encode(heights, image, bytes == 0 ? lossless() : budget(bytes));
  ASSERT_FALSE(stream.empty());
  expectAgreementOnPrefixes(stream);
}

std::string nameOf(const samples::Recipe& r) {
  return std::to_string(r.width) + "x" + std::to_string(r.height) + " pattern " +
         std::to_string(static_cast<int>(r.pattern)) + " type " + std::to_string(r.sample) +
         " channels " + std::to_string(r.channels);
}

constexpr Pattern kPatterns[] = {Pattern::kFlat,  Pattern::kRamp,    Pattern::kRidges,
                                 Pattern::kSteps, Pattern::kChecker, Pattern::kExtreme};

TEST(Reference, AgreesOnEveryByteOfASmallJointStream) {
  const Raster heights = make({Pattern::kRidges, 13, 14, 1, TKS_I16, 3});
  const Raster image = make({Pattern::kRidges, 7, 9, 3, TKS_U8, 4});
  const Bytes stream = encode(&heights, &image, lossless());
  expectAgreementOnPrefixes(stream, stream.size());
}

TEST(Reference, AgreesOnHeightsOfAllTypesAndPatterns) {
  for (const Pattern pattern : kPatterns) {
    for (const tks_sample sample : {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32}) {
      const samples::Recipe recipe{pattern, 13, 10, 1, sample, 5};
      SCOPED_TRACE(nameOf(recipe));
      const Raster heights = make(recipe);
      const bool exact = pattern != Pattern::kExtreme || tks_sample_bytes(sample) < 4;
      expectAgreementOn(&heights, nullptr, exact ? 0 : 500);
      if (HasFatalFailure()) return;
    }
  }
}

/// Encodes with a target of the caller's and voids, whole and damaged, and compares prefixes.
void expectAgreementOnLayers(const tks_heights& heights, const tks_encode_options& options) {
  const Bytes stream = encodeHeights(heights, options);
  expectAgreementOnPrefixes(stream, 16);
  const size_t header = static_cast<size_t>(Stream(stream).info().header_bytes);
  for (size_t i = 0; i < 8; ++i) {
    Bytes damaged = stream;
    const size_t at = i < 4 ? 12 + 9 * i : header + samples::hash(uint32_t(i), 0, 1) % 200;
    if (at >= damaged.size()) continue;
    damaged[at] ^= static_cast<uint8_t>(1 << (i % 8));
    sealHeader(damaged);
    expectAgreement(damaged);
  }
}

/// A byte of the header says something else, and the rest is as sound as before.
TEST(Reference, AgreesOnDamagedGeoreferences) {
  const Raster surface = make({Pattern::kRidges, 4, 3, 1, TKS_I16, 3});
  const Raster picture = make({Pattern::kRidges, 2, 6, 1, TKS_U8, 4});
  tks_heights heights = surface.heights();
  tks_image image = picture.image();
  const double north_up[] = {399960, 30, 0, 5300040, 0, -30}, turned[] = {1, 3, 8, 0.5, 4, -6};
  std::copy_n(north_up, 6, heights.geotransform);
  heights.has_geotransform = image.has_geotransform = 1;
  heights.geo_keys = "1024=1";
  for (const bool shared : {false, true}) {
    std::copy_n(turned, 6, image.geotransform);
    if (shared)
      std::copy_n(std::begin({399960., 60., 0., 5300040., 0., -15.}), 6, image.geotransform);
    const Bytes stream = encodeGiven(&heights, &image, lossless());
    const size_t header = static_cast<size_t>(Stream(stream).info().header_bytes);
    for (size_t at = 8; at + 4 < header; ++at) {
      for (const int change : {1, 2, 4, 127, 128, 255}) {
        SCOPED_TRACE(std::to_string(at) + " changed by " + std::to_string(change));
        Bytes damaged = stream;
        damaged[at] ^= static_cast<uint8_t>(change);
        sealHeader(damaged);
        expectAgreement(damaged);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(Reference, AgreesOnVoids) {
  for (const samples::VoidShape shape : samples::kVoidShapes) {
    for (const auto& [width, height] : {std::pair{2u, 2u}, {19u, 14u}, {40u, 9u}, {50u, 1u}}) {
      SCOPED_TRACE(static_cast<int>(shape));
      Raster raster = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
      const auto valid = samples::validity(shape, width, height);
      for (size_t i = 0; i < valid.size(); ++i) {
        const int16_t nodata = 77;
        if (!valid[i]) std::memcpy(raster.data.data() + 2 * i, &nodata, sizeof nodata);
      }
      tks_heights heights = raster.heights();
      heights.has_nodata = 1;
      heights.nodata = 77;
      expectAgreementOnLayers(heights, lossless());
      tks_encode_options bounded = budget(0);
      bounded.max_error = 500;
      expectAgreementOnLayers(heights, bounded);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Reference, AgreesOnCorrections) {
  for (const tks_sample sample : {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32}) {
    SCOPED_TRACE(static_cast<int>(sample));
    for (const Pattern pattern : {Pattern::kRidges, Pattern::kExtreme}) {
      const Raster raster = make({pattern, 13, 11, 1, sample, 3});
      expectAgreementOnLayers(raster.heights(), lossless());
      for (const double error : {3.0, 700.0}) {
        tks_encode_options bounded = budget(0);
        bounded.max_error = error;
        expectAgreementOnLayers(raster.heights(), bounded);
      }
    }
  }
}

TEST(Reference, AgreesOnTablesOfValues) {
  for (const samples::FewValues kind : samples::kFewValues) {
    SCOPED_TRACE(static_cast<int>(kind));
    const Raster whole = make({Pattern::kRidges, 48, 40, 1, TKS_U8, 3});
    const Raster raster = samples::withFewValues(whole, kind);
    tks_encode_options options = lossless();
    expectAgreementOnLayers(raster.heights(), options);
    options.regions = 16;
    expectAgreementOnLayers(raster.heights(), options);
  }
}

TEST(Reference, AgreesOnFloatsOfAllMagnitudes) {
  Raster raster = make({Pattern::kExtreme, 17, 11, 1, TKS_U32, 3});
  raster.sample = TKS_F32;
  for (size_t i = 0; i < 17 * 11; ++i) {
    const auto bits = samples::hash(static_cast<uint32_t>(i), 1, 1) & 0xff7fffffu;  // no infinity
    std::memcpy(raster.data.data() + 4 * i, &bits, sizeof bits);
  }
  expectAgreementOnLayers(raster.heights(), lossless());
}

// 65 x 9 has several blocks, some of them narrow; 129 x 2 is split in x alone.
TEST(Reference, AgreesOnHeightsOfAllShapes) {
  constexpr uint32_t kSizes[][2] = {{2, 2},   {3, 17}, {2, 9},   {9, 2},   {3, 3},
                                    {33, 22}, {5, 40}, {40, 5},  {129, 2}, {2, 129},
                                    {65, 9},  {1, 1},  {129, 1}, {1, 129}};
  for (const auto& size : kSizes) {
    const samples::Recipe recipe{Pattern::kRidges, size[0], size[1], 1, TKS_I16, 6};
    SCOPED_TRACE(nameOf(recipe));
    const Raster heights = make(recipe);
    expectAgreementOn(&heights, nullptr);
    if (HasFatalFailure()) return;
  }
}

constexpr size_t kBodyBytes = 7;  // where the length of the header's body stands

/// Where fields of the only component lie (docs/FORMAT.md, section 2).
struct Places {
  size_t planes, wavelet;

  explicit Places(const Bytes& stream) {
    size_t at = kBodyBytes;
    const auto skipVarint = [&] {
      while (stream[at++] >= 128) {
      }
    };
    skipVarint();  // body_bytes
    const bool geometry = stream[at++] & 1;
    for (const bool varint : {true, false, true, true, true}) {  // payload_bytes to height
      varint ? skipVarint() : void(++at);
    }
    planes = at + (geometry ? 1 : 2);
    wavelet = planes + 1 + (geometry ? 1 : 0);
    for (int i = 0; geometry && i < 3; ++i) wavelet += 1 + stream[wavelet];  // f64
  }
};

constexpr size_t kFractionBits = 3;  // behind Places::wavelet

// A narrow range and a budget make the encoder work between the integers.
TEST(Reference, AgreesOnFractionsOfSteps) {
  constexpr std::pair<tks_sample, uint64_t> kBudgets[] = {{TKS_U8, 160}, {TKS_I8, 300}};
  for (const auto& [sample, bytes] : kBudgets) {
    const Raster heights = make({Pattern::kRidges, 40, 31, 1, sample, 7});
    SCOPED_TRACE(bytes);
    const Bytes stream = encode(&heights, nullptr, budget(bytes));
    ASSERT_GT(stream[Places(stream).wavelet + kFractionBits], 0);
    expectAgreementOnPrefixes(stream);
  }
}

/// The number that begins at stream[at]; `at` moves behind it.
uint64_t takeVarint(const Bytes& stream, size_t& at) {
  uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    value |= uint64_t{stream[at] & 0x7fu} << shift;
    if (stream[at++] < 128) return value;
  }
}

Bytes varintOf(uint64_t value) {
  Bytes bytes;
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<uint8_t>(value | 128));
  bytes.push_back(static_cast<uint8_t>(value));
  return bytes;
}

Bytes replaced(const Bytes& stream, size_t begin, size_t end, const Bytes& by) {
  Bytes out(stream.begin(), stream.begin() + static_cast<ptrdiff_t>(begin));
  out.insert(out.end(), by.begin(), by.end());
  out.insert(out.end(), stream.begin() + static_cast<ptrdiff_t>(end), stream.end());
  return out;
}

/// The stream of one component with other filters, fraction bits, sample bits and roundings than it
/// was made with. It decodes to something else, but to one thing.
Bytes withAnyWavelet(const Bytes& stream, uint32_t trial) {
  constexpr uint8_t kFractions[] = {0, 0, 1, 4, 8};
  constexpr uint8_t kSampleBits[] = {0, 16, 17, 20, 21, 32};
  constexpr uint64_t kRoundedBytes[] = {0, 50, 250, 1 << 20};
  const uint32_t h = samples::hash(trial, 0, 21);
  Bytes fields;
  for (uint32_t i = 0; i < 3; ++i) fields.push_back(h >> (2 * i) & 3);
  fields.push_back(kFractions[(h >> 8) % 5]);
  fields.push_back(kSampleBits[(h >> 16) % 6]);
  if (fields[kFractionBits] == 0) {
    fields.push_back(static_cast<uint8_t>((h >> 20) % 5));
    for (const uint8_t byte : varintOf(kRoundedBytes[h >> 30])) fields.push_back(byte);
  }
  const size_t begin = Places(stream).wavelet;
  size_t end = begin + kFractionBits + 2;
  if (stream[begin + kFractionBits] == 0) takeVarint(stream, ++end);
  Bytes out = replaced(stream, begin, end, fields);
  size_t body_end = kBodyBytes;
  const uint64_t body = takeVarint(stream, body_end);
  out = replaced(out, kBodyBytes, body_end, varintOf(body + out.size() - stream.size()));
  sealHeader(out);
  return out;
}

/// Floats with voids.
Raster withCoast(Raster heights) {
  constexpr uint32_t kNan = 0x7fc00000;
  const auto valid = samples::validity(samples::VoidShape::kCoast, heights.width, heights.height);
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) std::memcpy(heights.data.data() + 4 * i, &kNan, sizeof kNan);
  }
  return heights;
}

TEST(Reference, AgreesOnAllWavelets) {
  const Raster heights = make({Pattern::kRidges, 37, 27, 1, TKS_F32, 22});
  const Raster image = make({Pattern::kRidges, 22, 37, 2, TKS_U8, 23});
  const Raster coast = withCoast(heights);
  const Bytes streams[] = {encode(&heights, nullptr, lossless()),
                           encode(&coast, nullptr, lossless()),
                           encode(nullptr, &image, lossless())};
  for (uint32_t trial = 0; trial < 90; ++trial) {
    SCOPED_TRACE(trial);
    expectAgreementOnPrefixes(withAnyWavelet(streams[trial % 3], trial), 3);
    if (HasFatalFailure()) return;
  }
}

// More than ten splits: the norms of further ones follow a rule.
TEST(Reference, AgreesOnManyLevels) {
  const Raster heights = make({Pattern::kRidges, 8192, 2, 1, TKS_I16, 24});
  const Bytes stream = encode(&heights, nullptr, budget(600));
  for (uint32_t trial = 0; trial < 4; ++trial) {
    SCOPED_TRACE(trial);
    expectAgreement(withAnyWavelet(stream, trial));
  }
}

TEST(Reference, AgreesOnTexturesOfAllKinds) {
  for (const Pattern pattern : kPatterns) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      for (const tks_sample sample : {TKS_U8, TKS_U16}) {
        const samples::Recipe recipe{pattern, 10, 7, channels, sample, 8};
        SCOPED_TRACE(nameOf(recipe));
        const Raster image = make(recipe);
        expectAgreementOn(nullptr, &image);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(Reference, AgreesOnTexturesOfAllShapes) {
  constexpr uint32_t kSizes[][2] = {{1, 1},   {1, 40}, {40, 1},  {4, 4},   {5, 4},
                                    {3, 100}, {5, 5},  {34, 37}, {130, 5}, {200, 1}};
  for (const auto& size : kSizes) {
    for (const uint32_t channels : {1u, 3u}) {
      const samples::Recipe recipe{Pattern::kRidges, size[0], size[1], channels, TKS_U8, 9};
      SCOPED_TRACE(nameOf(recipe));
      const Raster image = make(recipe);
      expectAgreementOn(nullptr, &image);
      if (HasFatalFailure()) return;
    }
  }
}

/// Drawings whole, cut and damaged.
TEST(Reference, AgreesOnDrawnTextures) {
  constexpr uint32_t kSizes[][2] = {{9, 2}, {1, 60}, {33, 33}, {64, 21}};
  for (uint32_t trial = 0; trial < 32; ++trial) {
    const auto& size = kSizes[trial % 4];
    const samples::Recipe recipe{
        Pattern::kSteps, size[0], size[1], 1 + trial / 4 % 4, trial < 16 ? TKS_U8 : TKS_U16, trial};
    SCOPED_TRACE(nameOf(recipe));
    const Raster image = make(recipe);
    Bytes stream = encode(nullptr, &image, lossless());
    expectAgreementOnPrefixes(stream, 40);
    const auto header = static_cast<size_t>(Stream(stream).info().header_bytes);
    for (uint32_t k = 0; k < 12 && stream.size() > header; ++k) {
      const uint32_t h = samples::hash(trial, k, 31);
      stream[header + h % (stream.size() - header)] = static_cast<uint8_t>(h >> 24);
      expectAgreement(stream);
    }
    if (HasFatalFailure()) return;
  }
}

/// Overlays whole, cut, damaged and in regions.
TEST(Reference, AgreesOnOverlays) {
  for (uint32_t trial = 0; trial < 16; ++trial) {
    const uint32_t width = 30 + 13 * (trial % 4), height = 31;
    Raster image =
        make({Pattern::kRidges, width, height, 1 + trial % 4, trial < 8 ? TKS_U8 : TKS_U16, trial});
    samples::drawOver(image, samples::validity(samples::VoidShape::kCoast, width, height));
    tks_encode_options options = trial % 2 == 0 ? lossless() : budget(1000);
    options.regions = trial % 3 == 0 ? 16 : 1;
    SCOPED_TRACE(trial);
    Bytes stream = encode(nullptr, &image, options);
    expectAgreementOnPrefixes(stream, 30);
    const auto header = static_cast<size_t>(Stream(stream).info().header_bytes);
    for (uint32_t k = 0; k < 12; ++k) {
      const uint32_t h = samples::hash(trial, k, 33);
      stream[header + 2 + h % (k < 6 ? 60 : stream.size() - header - 2)] =
          static_cast<uint8_t>(h >> 24);
      expectAgreement(stream);
    }
    if (HasFatalFailure()) return;
  }
}

/// Textures with holes and lines: their wavelet mostly goes on there.
TEST(Reference, AgreesOnBridgedTextures) {
  using samples::VoidShape;
  constexpr uint32_t kSizes[][2] = {{40, 33}, {1, 90}, {77, 2}, {61, 50}};
  constexpr VoidShape kShapes[] = {VoidShape::kLines, VoidShape::kHoles, VoidShape::kSpeckle,
                                   VoidShape::kChecker};
  uint32_t bridged = 0;
  for (uint32_t trial = 0; trial < 32; ++trial) {
    const auto [width, height] = kSizes[trial % 4];
    const std::vector<uint8_t> mask = samples::validity(kShapes[trial / 4 % 4], width, height);
    Raster image = make({Pattern::kRidges, width, height, trial < 16 ? 4u : 2u,
                         trial % 8 < 5 ? TKS_U8 : TKS_U16, trial});
    if (trial % 3 != 0) samples::cutOut(image, mask);
    if (trial % 3 != 1) samples::drawOver(image, mask);
    tks_encode_options options = trial % 5 == 4 ? lossless() : budget(400 + width * height / 2);
    options.regions = trial % 3 == 2 ? 16 : 1;
    SCOPED_TRACE(trial);
    Bytes stream = encode(nullptr, &image, options);
    const auto parsed = readHeader(stream);
    ASSERT_TRUE(parsed.ok());
    bridged += parsed->header.texture->bridge > 0;
    expectAgreementOnPrefixes(stream, 20);
    for (uint32_t k = 0; k < 8 && stream.size() > parsed->bytes; ++k) {
      const uint32_t h = samples::hash(trial, k, 37);
      stream[parsed->bytes + h % (stream.size() - parsed->bytes)] = static_cast<uint8_t>(h >> 24);
      expectAgreement(stream);
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(bridged, 6u);
}

TEST(Reference, AgreesOnJointStreamsWithMetadataAndIndex) {
  const Raster heights = make({Pattern::kRidges, 20, 33, 1, TKS_U16, 10});
  const Raster image = make({Pattern::kRidges, 28, 20, 3, TKS_U8, 11});
  tks_heights h = heights.heights();
  h.scale = 0.25;
  h.offset = -100;
  h.unit = "m";
  h.crs = "EPSG:25832";
  const tks_image i = image.image();
  tks_encode_options options = budget(1000);
  options.index = 1;
  expectAgreementOnPrefixes(encodeGiven(&h, &i, options), 30);
}

// Several regions, groups of them, and last ones that are longer.
TEST(Reference, AgreesOnRegions) {
  constexpr uint32_t kSizes[][2] = {{24, 24}, {39, 40}, {100, 5}, {5, 100}, {71, 60}, {200, 25}};
  for (const auto& size : kSizes) {
    const Raster heights = make({Pattern::kRidges, size[0], size[1], 1, TKS_I16, 30});
    const Raster image = make({Pattern::kRidges, size[1], size[0], 3, TKS_U8, 31});
    for (tks_encode_options options : {lossless(), budget(900)}) {
      options.regions = 16;
      const Bytes stream = encode(&heights, &image, options);
      SCOPED_TRACE(size[0]);
      expectAgreementOnPrefixes(stream, 5);
      for (uint32_t trial = 0; trial < 3; ++trial) {
        Bytes damaged = stream;
        const uint32_t h = samples::hash(trial, size[0], 32);
        damaged[120 + h % (damaged.size() - 120)] ^= static_cast<uint8_t>(1 + (h >> 24) % 255);
        sealHeader(damaged);
        expectAgreement(damaged);
      }
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Reference, AgreesOnRegionsBesideLayers) {
  for (const samples::VoidShape shape :
       {samples::VoidShape::kCoast, samples::VoidShape::kSpeckle}) {
    Raster raster = make({Pattern::kRidges, 45, 40, 1, TKS_F32, 33});
    const auto valid = samples::validity(shape, 45, 40);
    for (size_t i = 0; i < valid.size(); ++i) {
      float v;
      std::memcpy(&v, raster.data.data() + 4 * i, sizeof v);
      v = valid[i] ? v / 3 : NAN;
      std::memcpy(raster.data.data() + 4 * i, &v, sizeof v);
    }
    for (tks_encode_options options : {lossless(), budget(700)}) {
      options.regions = 16;
      expectAgreementOnLayers(raster.heights(), options);
      if (HasFatalFailure()) return;
    }
  }
}

/// Streams whose payload is damaged: any bytes are a codeword, so the samples have to agree.
TEST(Reference, AgreesOnDamagedPayloads) {
  const Raster heights = make({Pattern::kExtreme, 18, 11, 1, TKS_I16, 12});
  const Raster image = make({Pattern::kRidges, 10, 9, 4, TKS_U16, 13});
  const Bytes good = encode(&heights, &image, lossless());
  Stream stream(good);
  ASSERT_EQ(stream.status(), TKS_OK);
  const size_t start = stream.info().header_bytes;
  for (uint32_t trial = 0; trial < 300; ++trial) {
    Bytes damaged = good;
    for (uint32_t k = 0; k <= trial % 4; ++k) {
      const uint32_t h = samples::hash(trial, k, 14);
      damaged[start + h % (damaged.size() - start)] = static_cast<uint8_t>(h >> 24);
    }
    SCOPED_TRACE(trial);
    expectAgreement(damaged);
    if (HasFatalFailure()) return;
  }
}

/// The header of a stream of one component, made to announce `planes`, and one packet of
/// `codeword`.
Bytes withCodeword(const Bytes& stream, uint8_t planes, const Bytes& codeword) {
  const size_t start = Stream(stream).info().header_bytes;
  Bytes out(stream.begin(), stream.begin() + static_cast<ptrdiff_t>(start));
  out[Places(stream).planes] = planes;
  sealHeader(out);
  uint64_t head = codeword.size() << 2 | (stream[start] & 1);
  for (; head >= 128; head >>= 7) out.push_back(static_cast<uint8_t>(head % 128 + 128));
  out.insert(out.end(), {static_cast<uint8_t>(head), 0});
  out.insert(out.end(), codeword.begin(), codeword.end());
  out.resize(std::min(out.size(), stream.size()));  // as far as payload_bytes
  return out;
}

/// `ones` bytes FF, which begin at the very end of the range and make coefficients as large as can
/// be, and behind them noise, or zeros.
Bytes codewordOf(size_t ones, size_t size, uint32_t seed, bool noise) {
  Bytes codeword(size, 255);
  for (size_t i = ones; i < size; ++i) {
    const uint32_t h = samples::hash(static_cast<uint32_t>(i), seed, 18);
    codeword[i] = static_cast<uint8_t>(noise ? h >> 24 : 0);
  }
  return codeword;
}

/// Every prefix, level and damaged byte of samples that are stored.
TEST(Reference, AgreesOnStoredSamples) {
  const Raster heights = withCoast(make({Pattern::kExtreme, 13, 9, 1, TKS_F32, 15}));
  const Raster image = make({Pattern::kExtreme, 7, 9, 2, TKS_U16, 16});
  for (const Bytes& good :
       {encode(&heights, nullptr, lossless()), encode(nullptr, &image, lossless())}) {
    for (size_t bytes = 0; bytes <= good.size(); ++bytes) {
      expectAgreement(Prefix(good).first(bytes));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Reference, AgreesOnArbitraryCodewords) {
  const Raster heights = make({Pattern::kExtreme, 33, 13, 1, TKS_U16, 15});
  const Raster coast = withCoast(make({Pattern::kRidges, 35, 26, 1, TKS_F32, 17}));
  const Raster image = make({Pattern::kRidges, 24, 21, 3, TKS_U8, 16});
  Raster cut = make({Pattern::kExtreme, 17, 16, 4, TKS_U8, 18});
  samples::cutOut(cut, samples::validity(samples::VoidShape::kCoast, 17, 16));
  // Noise is stored where a stream is to be lossless, and drawn where a budget holds that.
  const Bytes streams[] = {encode(&heights, nullptr, budget(450)),
                           encode(&coast, nullptr, lossless()), encode(nullptr, &image, lossless()),
                           encode(nullptr, &cut, budget(600))};
  for (const Bytes& good : streams) {
    ASSERT_GT(good.size(), 400u);
    for (uint32_t trial = 0; trial < 120; ++trial) {
      const Bytes codeword = codewordOf(trial / 3, 300, trial, trial % 2 == 0);
      const Bytes stream = trial % 3 == 0 ? good : withAnyWavelet(good, trial);
      SCOPED_TRACE(trial);
      expectAgreement(withCodeword(stream, trial % 4 < 2 ? 30 : 12, codeword));
      if (HasFatalFailure()) return;
    }
  }
}

/// Any value in any byte of the header.
void expectAgreementOnDamagedHeaders(const Bytes& good) {
  Stream stream(good);
  ASSERT_EQ(stream.status(), TKS_OK);
  for (size_t at = 0; at < stream.info().header_bytes; ++at) {
    for (const int value : {0, 1, 2, 3, 4, 5, 6, 7, 127, 128, 255, good[at] + 1, good[at] - 1}) {
      Bytes damaged = good;
      damaged[at] = static_cast<uint8_t>(value);
      sealHeader(damaged);
      SCOPED_TRACE("byte " + std::to_string(at) + " := " + std::to_string(value));
      expectAgreement(damaged);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

// Any value in any byte of the header, under a right checksum: both read the same samples from it,
// or both refuse for the same reason.
TEST(Reference, AgreesOnDamagedHeaders) {
  const Raster heights = make({Pattern::kRidges, 9, 7, 1, TKS_I16, 19});
  const Raster image = make({Pattern::kRidges, 6, 9, 3, TKS_U8, 20});
  tks_encode_options options = lossless();
  options.index = 1;
  expectAgreementOnDamagedHeaders(encode(&heights, &image, options));
  const Raster wide = make({Pattern::kRidges, 25, 7, 1, TKS_I16, 19});
  options.regions = 16;
  expectAgreementOnDamagedHeaders(encode(&wide, &image, options));
  Raster cut = make({Pattern::kRidges, 9, 6, 4, TKS_U8, 21});
  samples::cutOut(cut, samples::validity(samples::VoidShape::kCoast, 9, 6));
  expectAgreementOnDamagedHeaders(encode(nullptr, &cut, budget(300)));
}

}  // namespace
}  // namespace tetrakis::test
