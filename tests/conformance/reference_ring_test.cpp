// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): heights and textures whose columns go
// round, and globes whose ground comes first.
#include <utility>

#include "conformance/samples/few_values.hpp"
#include "tests/conformance/agreement.hpp"

namespace tetrakis::test {
namespace {

tks_heights goingRound(tks_heights heights) {
  heights.domain = TKS_DOMAIN_CYLINDER;
  return heights;
}

tks_encode_options withPsnr(double psnr) {
  tks_encode_options options = budget(0);
  options.psnr = psnr;
  return options;
}

TEST(ReferenceRing, AgreesOnEveryByteOfASmallStream) {
  const Raster heights = make({Pattern::kRidges, 13, 14, 1, TKS_I16, 3});
  const Bytes stream = encodeHeights(goingRound(heights.heights()), lossless());
  expectAgreementOnPrefixes(stream, stream.size());
}

TEST(ReferenceRing, AgreesOnAllShapesTypesAndTargets) {
  constexpr uint32_t kSizes[][2] = {{1, 1},   {2, 9},  {9, 2},   {5, 3},  {6, 40},
                                    {33, 22}, {40, 5}, {129, 2}, {65, 9}, {1, 129}};
  for (const auto& [width, height] : kSizes) {
    for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_I32, TKS_F32}) {
      const samples::Recipe recipe{Pattern::kRidges, width, height, 1, sample, 6};
      SCOPED_TRACE(nameOf(recipe));
      const Raster raster = make(recipe);
      const tks_heights heights = goingRound(raster.heights());
      for (const tks_encode_options& options : {lossless(), budget(400), within(9), withPsnr(40)}) {
        expectAgreementOnLayers(heights, options);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(ReferenceRing, AgreesOnOtherGroundAndInRegions) {
  for (const Pattern pattern : kPatterns) {
    const Raster raster = make({pattern, 51, 34, 1, TKS_I16, 5});
    const tks_heights heights = goingRound(raster.heights());
    for (const tks_encode_options& options :
         {lossless(), budget(700), inRegions(lossless()), inRegions(within(5))}) {
      expectAgreementOnLayers(heights, options);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(ReferenceRing, AgreesOnGlobesByArea) {
  const Raster raster = make({Pattern::kRidges, 320, 160, 1, TKS_I16, 5});
  const tks_heights globe = goingRound(raster.heights());
  tks_heights placed = globe;
  placed.first_latitude = 90;
  placed.last_latitude = -90;
  for (const tks_encode_options& options : {lossless(), budget(9000), inRegions(lossless())}) {
    const Bytes stream = encodeHeights(placed, options);
    ASSERT_NE(stream, encodeHeights(globe, options));
    expectAgreementOnPrefixes(stream);
    if (HasFatalFailure()) return;
  }
}

TEST(ReferenceRing, AgreesOnTextures) {
  for (const Pattern pattern : kPatterns) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      const Raster raster = make({pattern, 35, 22, channels, TKS_U8, 8});
      tks_image image = raster.image();
      image.domain = TKS_DOMAIN_CYLINDER;
      for (const tks_encode_options& options : {lossless(), budget(700), inRegions(lossless())})
        expectAgreementOnPrefixes(encodeGiven(nullptr, &image, options));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(ReferenceRing, AgreesBesideVoids) {
  for (const samples::VoidShape shape : samples::kVoidShapes) {
    for (const auto& [width, height] : {std::pair{5u, 2u}, {19u, 14u}, {40u, 9u}, {50u, 1u}}) {
      SCOPED_TRACE(static_cast<int>(shape));
      Raster raster = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
      const auto valid = samples::validity(shape, width, height);
      for (size_t i = 0; i < valid.size(); ++i) {
        const int16_t nodata = 77;
        if (!valid[i]) std::memcpy(raster.data.data() + 2 * i, &nodata, sizeof nodata);
      }
      tks_heights heights = goingRound(raster.heights());
      heights.has_nodata = 1;
      heights.nodata = 77;
      for (const tks_encode_options& options : {lossless(), within(500)}) {
        expectAgreementOnLayers(heights, options);
        if (HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
