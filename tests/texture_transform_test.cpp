// SPDX-License-Identifier: Apache-2.0
// The texture's component transform, wavelet and synthesis norms, by their properties.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "texture_wavelet/colour.hpp"
#include "texture_wavelet/colour_fit.hpp"
#include "texture_wavelet/norms.hpp"
#include "texture_wavelet/wavelet.hpp"

namespace tetrakis {
namespace {

using Plane = std::vector<int32_t>;
using Random = std::mt19937;

constexpr int32_t kLowest = std::numeric_limits<int32_t>::min();
constexpr int32_t kHighest = std::numeric_limits<int32_t>::max();

Plane randomPlane(Random& random, size_t count, int32_t low, int32_t high) {
  std::uniform_int_distribution<int32_t> value(low, high);
  Plane plane(count);
  for (int32_t& v : plane) v = value(random);
  return plane;
}

/// Only the two ends of a range: the largest details there are.
Plane extremePlane(Random& random, size_t count, int32_t low, int32_t high) {
  Plane plane(count);
  for (int32_t& v : plane) v = random() % 2 == 0 ? low : high;
  return plane;
}

bool survivesWavelet(const Plane& samples, uint32_t width, uint32_t height) {
  Plane plane = samples;
  forwardWavelet(plane, width, height);
  inverseWavelet(plane, width, height);
  return plane == samples;
}

struct Planes {
  std::vector<Plane> values;

  std::vector<int32_t*> pointers() {
    std::vector<int32_t*> result;
    for (Plane& plane : values) result.push_back(plane.data());
    return result;
  }
  ColourTransform fit(uint32_t width, uint32_t height) const {
    std::vector<const int32_t*> constant;
    for (const Plane& plane : values) constant.push_back(plane.data());
    return fitColour(constant, width, height);
  }
};

bool survivesColour(const ColourTransform& transform, const Planes& samples) {
  Planes planes = samples;
  const size_t count = samples.values[0].size();
  forwardColour(transform, planes.pointers(), count);
  inverseColour(transform, planes.pointers(), count, 0);
  return planes.values == samples.values;
}

ColourTransform randomTransform(Random& random) {
  ColourTransform transform;
  for (uint16_t& centre : transform.centre) centre = static_cast<uint16_t>(random());
  transform.order = static_cast<uint8_t>(random());
  for (int16_t& shear : transform.shears) shear = static_cast<int16_t>(random());
  return transform;
}

/// Uniformly distributed rotation, from a random unit quaternion.
Matrix3 randomRotation(Random& random) {
  std::normal_distribution<double> normal;
  double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  w /= length, x /= length, y /= length, z /= length;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// --- wavelet ---

TEST(Wavelet, RestoresEverySmallSize) {
  Random random(1);
  for (uint32_t height = 1; height <= 70; ++height) {
    for (uint32_t width = 1; width <= 70; ++width) {
      const Plane samples = randomPlane(random, size_t{width} * height, -32768, 32767);
      ASSERT_TRUE(survivesWavelet(samples, width, height)) << width << " x " << height;
    }
  }
}

TEST(Wavelet, RestoresLongAndOddShapes) {
  Random random(2);
  const uint32_t shapes[][2] = {{1, 1000}, {1000, 1},  {1000, 3},  {3, 1000},  {257, 255},
                                {129, 33}, {97, 1021}, {65536, 1}, {1, 65536}, {2, 32768}};
  for (const auto& [width, height] : shapes) {
    const size_t count = size_t{width} * height;
    EXPECT_TRUE(survivesWavelet(extremePlane(random, count, -128, 127), width, height));
    EXPECT_TRUE(survivesWavelet(extremePlane(random, count, -65535, 65535), width, height));
  }
}

TEST(Wavelet, RestoresValuesThatWrapAround) {
  Random random(3);
  // Up to the first doubled band nothing is lost to wrapping: lifting is invertible modulo 2^32.
  for (uint32_t side = 1; side <= 16; ++side) {
    const size_t count = size_t{side} * side;
    EXPECT_TRUE(survivesWavelet(randomPlane(random, count, kLowest, kHighest), side, side));
    EXPECT_TRUE(survivesWavelet(extremePlane(random, count, kLowest, kHighest), side, side));
  }
}

TEST(Wavelet, AnyCoefficientsAreLegal) {
  Random random(16);
  for (uint32_t width : {5u, 16u, 61u, 130u}) {
    const Plane coefficients = extremePlane(random, size_t{width} * 67, kLowest, kHighest);
    Plane first = coefficients, second = coefficients;
    inverseWavelet(first, width, 67);
    inverseWavelet(second, width, 67);
    EXPECT_EQ(first, second);
    EXPECT_NE(first, coefficients);
  }
}

TEST(Wavelet, KeepsConstantsOutOfTheDetailBands) {
  const uint32_t width = 83, height = 59;
  Plane plane(size_t{width} * height, 1234);
  forwardWavelet(plane, width, height);
  for (const Subband& band : subbandsOf(width, height)) {
    const int32_t expected = band.orientation == Orientation::kLL ? 1234 * 4 : 0;
    for (uint32_t y = band.y; y < band.y + band.height; ++y) {
      for (uint32_t x = band.x; x < band.x + band.width; ++x) {
        ASSERT_EQ(plane[size_t{y} * width + x], expected) << band.level;
      }
    }
  }
}

TEST(Wavelet, RoundingIsUnbiased) {
  Random random(4);
  const uint32_t side = 512;
  const Plane samples = randomPlane(random, size_t{side} * side, 0, 255);
  Plane coarse = samples, fine = samples;
  forwardWavelet(coarse, side, side);
  for (int32_t& v : fine) v <<= 8;
  forwardWavelet(fine, side, side);
  for (const Subband& band : subbandsOf(side, side)) {
    if (band.width < 64) continue;
    double bias = 0;
    for (uint32_t y = band.y; y < band.y + band.height; ++y) {
      for (uint32_t x = band.x; x < band.x + band.width; ++x) {
        const size_t i = size_t{y} * side + x;
        bias += coarse[i] - fine[i] / 256.0;
      }
    }
    // Ties, one in 128, bias a level by 0.01; the noise about that has a deviation of 0.4.
    const double count = static_cast<double>(band.width) * band.height;
    EXPECT_LT(std::abs(bias / count), 0.01 * band.level + 5 * 0.4 / std::sqrt(count)) << band.level;
  }
}

TEST(Wavelet, FractionBitsRemoveRoundingNoise) {
  Random random(5);
  const uint32_t side = 256;
  Plane coefficients = randomPlane(random, size_t{side} * side, -20, 20);
  Plane plain = coefficients, fine = coefficients, finest = coefficients;
  for (int32_t& v : fine) v *= 1 << 4;
  for (int32_t& v : finest) v *= 1 << 12;
  inverseWavelet(plain, side, side);
  inverseWavelet(fine, side, side);
  inverseWavelet(finest, side, side);
  double noise_plain = 0, noise_fine = 0;
  for (size_t i = 0; i < plain.size(); ++i) {
    noise_plain += std::pow(plain[i] - finest[i] / 4096.0, 2);
    noise_fine += std::pow(fine[i] / 16.0 - finest[i] / 4096.0, 2);
  }
  EXPECT_LT(noise_fine * 100, noise_plain);
}

TEST(Wavelet, SixteenBitsWithFractionsDoNotOverflow) {
  Random random(6);
  const uint32_t side = 300;
  // Components of 16-bit RGB reach 3 * 65535; random blocks of all sizes excite every band.
  for (uint32_t block : {1u, 2u, 5u, 16u, 64u, 300u}) {
    Plane samples(size_t{side} * side);
    const Plane signs = extremePlane(random, samples.size(), -200000, 200000);
    for (uint32_t y = 0; y < side; ++y) {
      for (uint32_t x = 0; x < side; ++x) {
        samples[size_t{y} * side + x] = signs[size_t{y / block} * side + x / block];
      }
    }
    Plane coefficients = samples;
    forwardWavelet(coefficients, side, side);
    for (int32_t& v : coefficients) v *= 2;
    inverseWavelet(coefficients, side, side);
    for (size_t i = 0; i < samples.size(); ++i) {
      ASSERT_NEAR(coefficients[i] / 2.0, samples[i], 8) << block;
    }
  }
}

TEST(Subbands, TileThePlaneCoarsestFirst) {
  for (uint32_t height = 1; height <= 70; ++height) {
    for (uint32_t width = 1; width <= 70; ++width) {
      std::vector<int> owners(size_t{width} * height, 0);
      const std::vector<Subband> bands = subbandsOf(width, height);
      for (size_t i = 0; i < bands.size(); ++i) {
        const Subband& band = bands[i];
        EXPECT_EQ(static_cast<size_t>(band.orientation), i == 0 ? 0 : (i - 1) % 3 + 1);
        EXPECT_EQ(band.level, bands[0].level - (i == 0 ? 0 : static_cast<int>((i - 1) / 3)));
        for (uint32_t y = band.y; y < band.y + band.height; ++y) {
          for (uint32_t x = band.x; x < band.x + band.width; ++x) ++owners[size_t{y} * width + x];
        }
      }
      EXPECT_EQ(std::count(owners.begin(), owners.end(), 1), width * height);
      EXPECT_LE(std::max(bands[0].width, bands[0].height), kSmallestSide);
    }
  }
}

// --- norms ---

/// L2 norm of the band's synthesis function: a strong impulse through the integer synthesis.
double measuredNorm(const Subband& band, uint32_t width, uint32_t height) {
  constexpr int32_t kImpulse = 1 << 18;
  Plane plane(size_t{width} * height, 0);
  const uint32_t x = band.x + band.width / 2, y = band.y + band.height / 2;
  plane[size_t{y} * width + x] = kImpulse;
  inverseWavelet(plane, width, height);
  double energy = 0;
  for (int32_t v : plane) energy += static_cast<double>(v) * v;
  return std::sqrt(energy) / kImpulse;
}

void expectNorms(uint32_t width, uint32_t height) {
  for (const Subband& band : subbandsOf(width, height)) {
    if (band.width == 0 || band.height == 0) continue;
    // Synthesis functions are some eleven coefficients wide; no room for the ends.
    const bool room_x = band.width >= 14 || width == 1, room_y = band.height >= 14 || height == 1;
    if (!room_x || !room_y) continue;
    const double norm = measuredNorm(band, width, height);
    EXPECT_NEAR(normOf(band) / norm, 1, 0.004) << band.level;
    EXPECT_NEAR(normLog2(band), kNormSteps * std::log2(norm), 0.6) << band.level;
  }
}

TEST(Norms, MatchImpulsesInThePlane) {
  expectNorms(600, 500);
}
TEST(Norms, MatchImpulsesAlongRows) {
  expectNorms(65536, 1);
}
TEST(Norms, MatchImpulsesAlongColumns) {
  expectNorms(1, 65536);
}

// --- colour ---

TEST(Colour, EveryTransformIsReversible) {
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const ColourTransform transform = randomTransform(random);
    for (size_t channels = 1; channels <= 4; ++channels) {
      Planes samples;
      for (size_t c = 0; c < channels; ++c) {
        samples.values.push_back(trial % 2 == 0 ? randomPlane(random, 50, kLowest, kHighest)
                                                : extremePlane(random, 50, 0, 65535));
      }
      ASSERT_TRUE(survivesColour(transform, samples));
    }
  }
}

TEST(Colour, AdversarialShearsAreReversible) {
  Random random(8);
  for (int16_t shear : {int16_t{-32768}, int16_t{32767}, int16_t{-1}, int16_t{0}}) {
    ColourTransform transform;
    transform.shears.fill(shear);
    for (int order = 0; order < 256; ++order) {
      transform.order = static_cast<uint8_t>(order);
      Planes samples;
      for (int c = 0; c < 3; ++c) {
        samples.values.push_back(extremePlane(random, 64, kLowest, kHighest));
      }
      ASSERT_TRUE(survivesColour(transform, samples));
    }
  }
}

/// Cosine of the angle between two directions, whatever their signs.
double alignment(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::abs(dot(a, b)) / std::sqrt(dot(a, a) * dot(b, b));
}

TEST(Colour, ShearsRealiseEveryRotation) {
  Random random(9);
  for (int trial = 0; trial < 1000; ++trial) {
    const Matrix3 rotation = randomRotation(random);
    ColourTransform transform;
    setRotation(transform, rotation);
    const Matrix3 matrix = colourMatrix(transform);
    EXPECT_GT(alignment(matrix[0], rotation[0]), 0.99999);
    const double same = alignment(matrix[1], rotation[1]) + alignment(matrix[2], rotation[2]);
    const double swapped = alignment(matrix[1], rotation[2]) + alignment(matrix[2], rotation[1]);
    EXPECT_GT(std::max(same, swapped), 2 * 0.99999);
    const std::array<double, 3> energies = componentEnergies(transform);
    for (size_t i = 0; i < 3; ++i) {
      // Rows at right angles: the inverse has their directions and the reciprocal lengths.
      EXPECT_NEAR(energies[i] * dot(matrix[i], matrix[i]), 1, 0.002);
    }
  }
}

TEST(Colour, RotationsOfSixteenBitsFollowTheirMatrix) {
  Random random(10);
  for (int trial = 0; trial < 200; ++trial) {
    ColourTransform transform;
    setRotation(transform, randomRotation(random));
    for (uint16_t& centre : transform.centre) centre = random() % 2 == 0 ? 0 : 65535;
    const Matrix3 matrix = colourMatrix(transform);
    Planes samples;
    for (int c = 0; c < 3; ++c) samples.values.push_back(extremePlane(random, 16, 0, 65535));
    Planes planes = samples;
    forwardColour(transform, planes.pointers(), 16);
    Planes scaled = planes;
    for (size_t i = 0; i < 16; ++i) {
      std::array<double, 3> colour;
      for (size_t c = 0; c < 3; ++c) colour[c] = samples.values[c][i] - transform.centre[c];
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(planes.values[c][i], dot(matrix[c], colour), 3);
        scaled.values[c][i] *= 4;
      }
    }
    inverseColour(transform, scaled.pointers(), 16, 2);
    for (size_t c = 0; c < 3; ++c) {
      for (size_t i = 0; i < 16; ++i) EXPECT_NEAR(scaled.values[c][i], samples.values[c][i], 3);
    }
  }
}

TEST(Colour, EnergiesInvertTheMatrix) {
  Random random(11);
  for (int trial = 0; trial < 100; ++trial) {
    ColourTransform transform = randomTransform(random);
    for (int16_t& shear : transform.shears) shear /= 16;
    const Matrix3 m = colourMatrix(transform);
    // Columns of the inverse of a matrix of determinant +-1: cross products of its rows.
    const std::array<double, 3> energies = componentEnergies(transform);
    for (size_t i = 0; i < 3; ++i) {
      const auto &a = m[(i + 1) % 3], &b = m[(i + 2) % 3];
      const std::array<double, 3> column = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                            a[0] * b[1] - a[1] * b[0]};
      EXPECT_NEAR(dot(column, column) / energies[i], 1, 1e-6);
    }
  }
}

/// An image of three independent textures of different strength, seen through a rotation.
Planes mixedImage(Random& random, const Matrix3& rotation, uint32_t side) {
  std::exponential_distribution<double> exponential;
  const double strengths[] = {30, 8, 2};
  Planes image;
  image.values.assign(3, Plane(size_t{side} * side));
  for (size_t i = 0; i < size_t{side} * side; ++i) {
    std::array<double, 3> colour = {512, 512, 512};
    for (size_t s = 0; s < 3; ++s) {
      const double source = strengths[s] * exponential(random) * (random() % 2 == 0 ? 1 : -1);
      for (size_t c = 0; c < 3; ++c) colour[c] += source * rotation[s][c];
    }
    for (size_t c = 0; c < 3; ++c) image.values[c][i] = static_cast<int32_t>(colour[c]);
  }
  return image;
}

TEST(ColourFit, FindsTheAxesOfIndependentSources) {
  Random random(12);
  for (int trial = 0; trial < 5; ++trial) {
    const Matrix3 rotation = randomRotation(random);
    const Planes image = mixedImage(random, rotation, 128);
    const ColourTransform transform = image.fit(128, 128);
    const Matrix3 matrix = colourMatrix(transform);
    EXPECT_GT(alignment(matrix[0], rotation[0]), 0.995);
    EXPECT_TRUE(survivesColour(transform, image));
  }
}

TEST(ColourFit, PutsTheMeanAtZero) {
  Random random(13);
  for (size_t channels = 1; channels <= 4; ++channels) {
    Planes image;
    for (size_t c = 0; c < channels; ++c) {
      image.values.push_back(randomPlane(random, 31 * 17, 0, 65535));
    }
    const ColourTransform transform = image.fit(31, 17);
    EXPECT_TRUE(survivesColour(transform, image));
    forwardColour(transform, image.pointers(), 31 * 17);
    for (const Plane& plane : image.values) {
      double sum = 0;
      for (int32_t v : plane) sum += v;
      EXPECT_LT(std::abs(sum / (31 * 17)), 2.5);
    }
  }
}

TEST(ColourFit, GreyImagesHaveNoChroma) {
  Random random(14);
  for (int32_t highest : {1, 255, 65535}) {
    Planes image;
    image.values.assign(3, randomPlane(random, 64 * 64, 0, highest));
    const ColourTransform transform = image.fit(64, 64);
    EXPECT_TRUE(survivesColour(transform, image));
    forwardColour(transform, image.pointers(), 64 * 64);
    for (size_t c = 1; c < 3; ++c) {
      EXPECT_EQ(std::count(image.values[c].begin(), image.values[c].end(), 0), 64 * 64);
    }
  }
}

TEST(ColourFit, SmallAndFlatImagesAreLegal) {
  Random random(15);
  for (uint32_t width = 1; width <= 5; ++width) {
    for (uint32_t height = 1; height <= 5; ++height) {
      Planes image;
      for (int c = 0; c < 3; ++c) {
        image.values.push_back(Plane(size_t{width} * height, static_cast<int32_t>(random() % 256)));
      }
      EXPECT_TRUE(survivesColour(image.fit(width, height), image));
      image.values[0][0] ^= 1;
      EXPECT_TRUE(survivesColour(image.fit(width, height), image));
    }
  }
}

}  // namespace
}  // namespace tetrakis
