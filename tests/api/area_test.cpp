// SPDX-License-Identifier: Apache-2.0
// Heights of known latitudes: where there is more ground, errors fall first.
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

tks_heights between(const Raster& raster, double first, double last) {
  tks_heights heights = raster.heights();
  heights.first_latitude = first;
  heights.last_latitude = last;
  return heights;
}

/// Squared errors over the area of a globe whose first row touches a pole.
double squaresOverArea(const Raster& globe, const Bytes& bytes) {
  const std::vector<std::byte> decoded = Stream(bytes).heights();
  double sum = 0;
  for (size_t i = 0; i < decoded.size() / tks_sample_bytes(globe.sample); ++i) {
    const double row = static_cast<double>(i / globe.width) + 0.5;
    const double error = sampleAt(decoded, globe.sample, i) - sampleAt(globe.data, globe.sample, i);
    sum += std::sin(std::numbers::pi * row / globe.height) * error * error;
  }
  return sum;
}

class Area : public testing::Test {
 protected:
  void expectAlike(const tks_heights& heights, const tks_encode_options& options,
                   const tks_image* image = nullptr) {
    tks_heights unplaced = heights;
    unplaced.first_latitude = unplaced.last_latitude = 0;
    EXPECT_EQ(encodeGiven(&heights, image, options), encodeGiven(&unplaced, image, options));
  }

  const Raster globe_ = make({Pattern::kRidges, 320, 160, 1, TKS_I16, 3});
};

TEST_F(Area, IsWhatErrorsOfAGlobeCountBy) {
  for (const double north : {90.0, -90.0}) {
    const tks_heights placed = between(globe_, north, -north);
    for (const uint64_t bytes : {4000u, 8000u, 16000u}) {
      for (const uint32_t regions : {1u, 64u}) {
        const tks_encode_options options = inRegions(budget(bytes), regions);
        const Bytes by_samples = encodeHeights(globe_.heights(), options);
        const Bytes by_area = encodeHeights(placed, options);
        EXPECT_LE(by_area.size(), bytes);
        EXPECT_LT(squaresOverArea(globe_, by_area), 0.97 * squaresOverArea(globe_, by_samples))
            << north << ", " << bytes << " bytes, regions " << regions;
      }
    }
  }
}

TEST_F(Area, OrdersLosslessStreams) {
  const Bytes by_samples = encodeHeights(globe_.heights(), lossless());
  Bytes by_area = encodeHeights(between(globe_, 90, -90), lossless());
  EXPECT_LT(static_cast<double>(by_area.size()), 1.005 * static_cast<double>(by_samples.size()));
  EXPECT_EQ(Stream(by_area).heights(), globe_.data);
  by_area.resize(by_samples.size() / 4);
  const Bytes prefix(by_samples.begin(),
                     by_samples.begin() + static_cast<ptrdiff_t>(by_area.size()));
  EXPECT_LT(squaresOverArea(globe_, by_area), squaresOverArea(globe_, prefix));
}

TEST_F(Area, ChangesNothingWhereItHardlyVaries) {
  for (const auto& [first, last] :
       {std::pair{5., -5.}, {62., 58.}, {60., -60.}, {72., 35.}, {45., 45.}, {120., 100.}})
    expectAlike(between(globe_, first, last), budget(6000));
}

TEST_F(Area, LeavesThePromisesOfSamplesAlone) {
  const tks_heights placed = between(globe_, 90, -90);
  tks_encode_options psnr = budget(0);
  psnr.psnr = 35;
  expectAlike(placed, psnr);
  expectAlike(placed, within(20));
}

TEST_F(Area, LeavesViewsOfATextureAlone) {
  const Raster picture = make({Pattern::kRidges, 320, 160, 3, TKS_U8, 5});
  const tks_image image = picture.image();
  tks_encode_options options = budget(6000);
  expectAlike(between(globe_, 90, -90), options, &image);
  tks_camera camera = {nullptr, {0, 9000, 4000}, {0, 0, 0}, {0, 1, 0}, 50, 640, 480, 1};
  options.cameras = &camera;
  options.camera_count = 1;
  expectAlike(between(globe_, 90, -90), options, &image);
}

TEST_F(Area, HasNoMapInBudgetsThatItWouldEat) {
  expectAlike(between(globe_, 90, -90), budget(250));
}

TEST_F(Area, IsUnknownOnForests) {
  const Raster patch = make({Pattern::kRidges, 129, 129, 1, TKS_I16, 3});
  const std::vector<uint32_t> borders(4, TKS_BORDER);
  tks_heights heights = between(patch, 90, -90);
  heights.domain = TKS_DOMAIN_FOREST;
  heights.forest = {7, 1, borders.data()};
  expectAlike(heights, lossless());
}

/// Samples on the poles reach half a row behind them, and a strip behind a pole has no area at all.
TEST_F(Area, MayEndBehindThePoles) {
  for (const auto& [first, last] : {std::pair{90.5, -90.5}, {-180., 180.}, {89., 180.}}) {
    const Bytes bytes = encodeHeights(between(globe_, first, last), lossless());
    EXPECT_EQ(Stream(bytes).heights(), globe_.data) << first;
  }
}

TEST_F(Area, SuitsGridsOfEveryShape) {
  for (const auto& [width, height] : {std::pair{1u, 400u}, {400u, 1u}, {2u, 2u}, {2000u, 50u}}) {
    const Raster grid = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
    const Bytes bytes = encodeHeights(between(grid, 90, -90), lossless());
    EXPECT_EQ(Stream(bytes).heights(), grid.data) << width;
  }
}

}  // namespace
}  // namespace tetrakis::test
