// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): textures.
#include "bitstream/stream/header.hpp"
#include "tests/conformance/agreement.hpp"

namespace tetrakis::test {
namespace {

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
  for (uint32_t trial = 0; trial < 16; ++trial) {
    const auto& size = kSizes[(trial + trial / 4) % 4];
    const samples::Recipe recipe{
        Pattern::kSteps, size[0], size[1], 1 + trial % 4, trial < 8 ? TKS_U8 : TKS_U16, trial};
    SCOPED_TRACE(nameOf(recipe));
    const Raster image = make(recipe);
    Bytes stream = encode(nullptr, &image, lossless());
    expectAgreementOnPrefixes(stream, 61);
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
    expectAgreementOnPrefixes(stream, 61);
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

}  // namespace
}  // namespace tetrakis::test
