// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): heights, and heights with a texture.
#include <utility>

#include "conformance/samples/few_values.hpp"
#include "tests/conformance/agreement.hpp"

namespace tetrakis::test {
namespace {

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

}  // namespace
}  // namespace tetrakis::test
