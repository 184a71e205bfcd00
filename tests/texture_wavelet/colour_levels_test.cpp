// SPDX-License-Identifier: Apache-2.0
// Colour axes that turn from level to level.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/random_planes.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/colour/colour_fit.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::test {
namespace {

std::vector<int32_t*> pointersTo(std::vector<Plane>& planes) {
  std::vector<int32_t*> pointers;
  for (Plane& plane : planes) pointers.push_back(plane.data());
  return pointers;
}

TEST(ColourLevels, EveryTransformOfEveryCoefficientIsReversibleAtEveryLevel) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const auto width = static_cast<uint32_t>(1 + random() % 70),
               height = static_cast<uint32_t>(1 + random() % 70);
    ColourTransform transform;
    transform.level_shears.resize(random() % (1 + ColourTransform::kMostLevelShears));
    for (Shears& shears : transform.level_shears) {
      for (int16_t& shear : shears) shear = static_cast<int16_t>(random());
    }
    std::vector<Plane> planes;
    for (size_t c = 0; c < 3 + random() % 2; ++c)
      planes.push_back(extremePlane(random, size_t{width} * height, INT32_MIN, INT32_MAX));
    const std::vector<Plane> before = planes;
    const Pyramid pyramid({width, height});
    const int level = static_cast<int>(random() % static_cast<size_t>(pyramid.levels() + 1));
    forwardColourLevels(transform, pyramid, pointersTo(planes));
    std::vector<ViewSynthesis> views(planes.size(),
                                     ViewSynthesis(WaveletSpec(), pyramid, {level, {}}));
    for (size_t c = 0; c < views.size(); ++c) {
      views[c].allocate();
      for (const Subband& band : pyramid.subbands()) {
        for (uint32_t row = 0; row < views[c].needed(band).height; ++row)
          std::copy_n(planes[c].data() + pyramid.indexOf(band, row), band.width,
                      views[c].row(band, row).begin());
      }
    }
    inverseColourLevels(transform, pyramid, views);
    for (size_t c = 0; c < views.size(); ++c) {
      for (const Subband& band : pyramid.subbands()) {
        ASSERT_EQ(views[c].needed(band).height, pyramid.isIn(band, level) ? band.height : 0);
        for (uint32_t row = 0; row < views[c].needed(band).height; ++row) {
          const int32_t* const truth = before[c].data() + pyramid.indexOf(band, row);
          ASSERT_TRUE(std::ranges::equal(views[c].row(band, row), std::span(truth, band.width)));
        }
      }
    }
  }
}

TEST(ColourLevels, LevelOneAndAlphaStayAsTheyAre) {
  Random random(2);
  ColourTransform transform;
  transform.level_shears = {{128, 64, -37, 1, 12, -125}};
  std::vector<Plane> planes;
  for (size_t c = 0; c < 4; ++c) planes.push_back(randomPlane(random, 64 * 64, -1000, 1000));
  const std::vector<Plane> before = planes;
  const Pyramid pyramid({64, 64});
  forwardColourLevels(transform, pyramid, pointersTo(planes));
  EXPECT_EQ(planes[3], before[3]);
  for (const Subband& band : pyramid.subbands()) {
    const size_t first = size_t{band.planeRow(0)} * 64 + band.x;
    for (size_t c = 0; c < 3; ++c)
      EXPECT_EQ(planes[c][first] == before[c][first], band.level == 1) << band.level << " " << c;
  }
}

/// Fine details are grey, coarse shapes lie along another axis: what chroma at half the resolution
/// leaves of a photograph.
Texels greyDetailsOverColour(uint32_t side) {
  Random random(3);
  std::normal_distribution<double> normal;
  const auto smooth = [&](uint32_t cells) {
    std::vector<double> knots((cells + 1) * (cells + 1));
    for (double& knot : knots) knot = normal(random);
    return [=](uint32_t x, uint32_t y) {
      const double u = 1.0 * x * cells / side, v = 1.0 * y * cells / side;
      const auto i = static_cast<uint32_t>(u), j = static_cast<uint32_t>(v);
      const double a = u - i, b = v - j;
      const double* k = knots.data() + j * (cells + 1) + i;
      return (1 - b) * ((1 - a) * k[0] + a * k[1]) +
             b * ((1 - a) * k[cells + 1] + a * k[cells + 2]);
    };
  };
  const auto coarse = smooth(side / 8);
  Texels texels{side, side, 3, 8, {}};
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      const double shape = 40 * coarse(x, y), grain = 8 * normal(random);
      for (const double share : {0.9, 0.5, 0.1}) {
        const double value = std::round(120 + share * shape + grain);
        texels.samples.push_back(static_cast<uint16_t>(std::clamp(value, 0.0, 255.0)));
      }
    }
  }
  return texels;
}

double cosine(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double ab = 0, aa = 0, bb = 0;
  for (size_t i = 0; i < 3; ++i) {
    ab += a[i] * b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
  }
  return std::abs(ab) / std::sqrt(aa * bb);
}

TEST(ColourLevels, TheFitFollowsDetailsAndShapes) {
  const Texels texels = greyDetailsOverColour(256);
  std::vector<Plane> planes(3, Plane(texels.samples.size() / 3));
  for (size_t i = 0; i < texels.samples.size(); ++i) planes[i % 3][i / 3] = texels.samples[i];
  const std::vector<const int32_t*> pointers = {planes[0].data(), planes[1].data(),
                                                planes[2].data()};
  const ColourTransform fitted = fitColour(pointers, texels.extent());
  ASSERT_FALSE(fitted.level_shears.empty());
  EXPECT_GT(cosine(colourMatrix(fitted, 1)[0], {1, 1, 1}), 0.995);
  EXPECT_GT(cosine(colourMatrix(fitted, 5)[0], {0.9, 0.5, 0.1}), 0.99);
}

TEST(ColourLevels, TurnedTexturesComeBack) {
  const Texels texels = greyDetailsOverColour(128);
  const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossless, {});
  ASSERT_GT(encoded.header.colour_shears.size(), 1u);
  EXPECT_EQ(decodeTexture(encoded.header, {encoded.tracks.front().codeword}).samples,
            texels.samples);
}

}  // namespace
}  // namespace tetrakis::test
