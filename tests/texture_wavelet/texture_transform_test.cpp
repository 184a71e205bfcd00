// SPDX-License-Identifier: Apache-2.0
// The texture's colour transform by its properties.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/random_planes.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/colour/colour_fit.hpp"

namespace tetrakis::test {
namespace {

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
    return fitColour(constant, {width, height});
  }
  ColourTransform chooseLossless(uint32_t width, uint32_t height) const {
    std::vector<const int32_t*> constant;
    for (const Plane& plane : values) constant.push_back(plane.data());
    return chooseLosslessColour(constant, {width, height});
  }
};

/// Colour planes to samples, as the decoder goes.
void restore(const ColourTransform& transform, int fraction_bits, Planes& planes) {
  inverseShears(transform, planes.pointers(), planes.values[0].size());
  for (size_t c = 0; c < planes.values.size(); ++c)
    restoreSamples(planes.values[c], transform.centre[c], fraction_bits);
}

bool survivesColour(const ColourTransform& transform, const Planes& samples,
                    int fraction_bits = 0) {
  Planes planes = samples;
  forwardColour(transform, planes.pointers(), samples.values[0].size(), fraction_bits);
  restore(transform, fraction_bits, planes);
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
    const ColourTransform transform = rotated({}, rotation);
    const Matrix3 matrix = colourMatrix(transform);
    // Shears off by half of 1/128 turn a row by a hundredth or two: cosine 0.9998.
    EXPECT_GT(alignment(matrix[0], rotation[0]), 0.9998);
    const double same = alignment(matrix[1], rotation[1]) + alignment(matrix[2], rotation[2]);
    const double swapped = alignment(matrix[1], rotation[2]) + alignment(matrix[2], rotation[1]);
    EXPECT_GT(std::max(same, swapped), 2 * 0.9998);
    const std::array<double, 3> energies = planeEnergies(transform);
    for (size_t i = 0; i < 3; ++i) {
      // Rows at right angles: the inverse has their directions and the reciprocal lengths.
      EXPECT_NEAR(energies[i] * dot(matrix[i], matrix[i]), 1, 0.002);
    }
  }
}

TEST(Colour, RotationsOfSixteenBitsFollowTheirMatrix) {
  Random random(10);
  for (int trial = 0; trial < 200; ++trial) {
    ColourTransform transform = rotated({}, randomRotation(random));
    for (uint16_t& centre : transform.centre) centre = random() % 2 == 0 ? 0 : 65535;
    const Matrix3 matrix = colourMatrix(transform);
    Planes samples;
    for (int c = 0; c < 3; ++c) samples.values.push_back(extremePlane(random, 16, 0, 65535));
    Planes planes = samples;
    forwardColour(transform, planes.pointers(), 16, 0);
    Planes scaled = planes;
    for (size_t i = 0; i < 16; ++i) {
      std::array<double, 3> colour;
      for (size_t c = 0; c < 3; ++c) colour[c] = samples.values[c][i] - transform.centre[c];
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(planes.values[c][i], dot(matrix[c], colour), 3);
        scaled.values[c][i] *= 4;
      }
    }
    restore(transform, 2, scaled);
    for (size_t c = 0; c < 3; ++c) {
      for (size_t i = 0; i < 16; ++i) EXPECT_NEAR(scaled.values[c][i], samples.values[c][i], 3);
    }
  }
}

/// Fraction bits come off again: exactly, and colour planes then follow their matrix more closely.
TEST(Colour, FractionBitsAreReversibleAndFiner) {
  Random random(17);
  for (int trial = 0; trial < 200; ++trial) {
    ColourTransform transform = rotated({}, randomRotation(random));
    for (size_t channels = 1; channels <= 4; ++channels) {
      Planes samples;
      for (size_t c = 0; c < channels; ++c) {
        samples.values.push_back(extremePlane(random, 50, 0, 65535));
      }
      for (int bits = 0; bits <= 2; ++bits) {
        ASSERT_TRUE(survivesColour(transform, samples, bits)) << channels << " " << bits;
      }
      for (Plane& plane : samples.values) plane = randomPlane(random, 50, 0, 255);
      for (int bits = 3; bits <= 8; ++bits) {
        ASSERT_TRUE(survivesColour(transform, samples, bits)) << channels << " " << bits;
      }
      Planes planes = samples;
      forwardColour(transform, planes.pointers(), 50, 8);
      if (channels < 3) continue;
      const Matrix3 matrix = colourMatrix(transform);
      for (size_t i = 0; i < 50; ++i) {
        std::array<double, 3> colour;
        for (size_t c = 0; c < 3; ++c) colour[c] = samples.values[c][i];
        for (size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(planes.values[c][i] / 256.0, dot(matrix[c], colour), 3 / 256.0);
        }
      }
    }
  }
}

TEST(Colour, EnergiesInvertTheMatrix) {
  Random random(11);
  for (int trial = 0; trial < 100; ++trial) {
    ColourTransform transform = randomTransform(random);
    for (int16_t& shear : transform.shears) shear /= 128;
    const Matrix3 m = colourMatrix(transform);
    // Columns of the inverse of a matrix of determinant +-1: cross products of its rows.
    const std::array<double, 3> energies = planeEnergies(transform);
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
    forwardColour(transform, image.pointers(), 31 * 17, 0);
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
    forwardColour(transform, image.pointers(), 64 * 64, 0);
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

/// One grey image of noise in all channels, with more noise of `own` in each.
Planes noisyColours(uint32_t count, int own, Random& random) {
  Planes planes{std::vector<Plane>(3, Plane(count))};
  const auto upTo = [&](int most) { return static_cast<int32_t>(random() % (most + 1u)); };
  for (uint32_t i = 0; i < count; ++i) {
    const int32_t grey = upTo(255 - own);
    for (Plane& plane : planes.values) plane[i] = grey + upTo(own);
  }
  return planes;
}

/// log2(1 + |gradient residual|), summed over all samples and colour planes.
double residualBits(const ColourTransform& transform, Planes planes, uint32_t width) {
  forwardColour(transform, planes.pointers(), planes.values[0].size(), 0);
  double bits = 0;
  for (const Plane& plane : planes.values) {
    for (size_t i = width + 1; i < plane.size(); ++i) {
      const int32_t residual = plane[i] - plane[i - 1] - plane[i - width] + plane[i - width - 1];
      if (i % width != 0) bits += std::log2(1 + std::abs(static_cast<double>(residual)));
    }
  }
  return bits;
}

TEST(LosslessColour, CostsNoMoreThanThatOfJpeg2000OrNone) {
  Random random(7);
  for (const int own : {0, 3, 40, 255}) {
    const Planes planes = noisyColours(64 * 48, own, random);
    const ColourTransform chosen = planes.chooseLossless(64, 48);
    ColourTransform none = chosen, jpeg2000 = chosen;
    none.shears = {};
    jpeg2000.order = 2;  // differences to green
    jpeg2000.shears = {0, -1024, 0, -1024, 256, 256};
    const double bits = residualBits(chosen, planes, 64) * 0.9999;  // sums of floats
    EXPECT_LE(bits, residualBits(jpeg2000, planes, 64)) << own;
    EXPECT_LE(bits, residualBits(none, planes, 64)) << own;
    EXPECT_TRUE(survivesColour(chosen, planes)) << own;
    if (own <= 3) {
      EXPECT_NE(chosen.shears, none.shears) << own;
    }
  }
}

TEST(LosslessColour, TakesAnySizeAndKeepsGreyAsItIs) {
  Random random(9);
  for (const uint32_t width : {1u, 2u, 300u}) {
    Planes planes = noisyColours(width * 2, 20, random);
    EXPECT_TRUE(survivesColour(planes.chooseLossless(width, 2), planes)) << width;
    planes.values.resize(1);
    const ColourTransform grey = planes.chooseLossless(width, 2);
    EXPECT_EQ(grey.shears, planes.fit(width, 2).shears);
  }
}

}  // namespace
}  // namespace tetrakis::test
