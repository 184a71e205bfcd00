// SPDX-License-Identifier: Apache-2.0
// Lifting of rows and columns in one go: its inverse, its roundings, its overflow.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

WaveletSpec doubledAt(FilterId id, int bits, int first_doubled) {
  WaveletSpec spec = uniform(id, true, bits);
  spec.first_doubled = first_doubled;
  return spec;
}

TEST(JointLifting, RestoresEverySizeWhereverLowBandsAreDoubled) {
  Random random(21);
  for (const FilterId id : kTwoStepFilters) {
    for (int first = 0; first <= 4; ++first) {
      for (uint32_t height = 1; height <= 19; ++height) {
        for (const uint32_t width : {1u, 2u, 4u, 5u, 6u, 7u, 16u, 33u, 70u}) {
          const Size size{width, height};
          const WaveletSpec spec = doubledAt(id, 16, first);
          const Plane plane = randomPlane(random, size.count(), -32768, 32767);
          ASSERT_EQ(inverse(spec, forward(spec, plane, size), size), plane) << spec << ", " << size;
        }
      }
    }
  }
}

/// Of the most bits that are lifted jointly.
TEST(JointLifting, RestoresTheExtremesOf20Bits) {
  Random random(22);
  const int32_t bound = 1 << 19;
  for (const FilterId id : kTwoStepFilters) {
    for (const Size& size : {Size{64, 64}, Size{255, 131}}) {
      for (int first = 0; first <= 4; ++first) {
        const WaveletSpec spec = doubledAt(id, 20, first);
        ASSERT_TRUE(spec.joint(1) && spec.jointlyWide(1));
        Plane plane = extremePlane(random, size.count(), -bound, bound - 1);
        ASSERT_EQ(inverse(spec, forward(spec, plane, size), size), plane) << spec << ", " << size;
        for (size_t i = 0; i < plane.size(); ++i)
          plane[i] = (i % size.width + i / size.width) % 2 == 0 ? -bound : bound - 1;
        ASSERT_EQ(inverse(spec, forward(spec, plane, size), size), plane) << spec << ", " << size;
      }
    }
  }
}

/// Lifting is invertible modulo 2^32; only doubling loses a bit.
TEST(JointLifting, RestoresValuesThatWrapAround) {
  Random random(23);
  for (const FilterId id : kTwoStepFilters) {
    for (const int bits : {8, 20}) {
      const Size size{45, 38};
      const Plane plane = randomPlane(random, size.count(), kLowest, kHighest);
      const WaveletSpec spec = doubledAt(id, bits, 0);
      ASSERT_EQ(inverse(spec, forward(spec, plane, size), size), plane) << spec;
    }
  }
}

TEST(JointLifting, ThreadsChangeNothing) {
  Random random(24);
  const Size size{300, 700};
  const Plane plane = randomPlane(random, size.count(), -1000, 1000);
  for (const FilterId id : kTwoStepFilters) {
    const WaveletSpec spec = doubledAt(id, 12, 2);
    Plane one = plane, many = plane;
    forwardWavelet(spec, Pyramid(size.extent()), one, 1);
    forwardWavelet(spec, Pyramid(size.extent()), many, 5);
    ASSERT_EQ(one, many);
    inverseWavelet(spec, Pyramid(size.extent()), many, {.threads = 3});
    ASSERT_EQ(many, plane);
  }
}

/// Squared distance of one level's coefficients from those of samples with twelve more bits.
double noiseOf(const WaveletSpec& spec, const Plane& samples, const Size& size) {
  constexpr int kMore = 12;
  WaveletSpec exact = withBits(spec, kWideBits);
  exact.whole = false;
  Plane raised = samples;
  for (int32_t& v : raised) v *= 1 << kMore;
  const Plane coarse = forward(spec, samples, size), fine = forward(exact, raised, size);
  double squares = 0;
  for (const Subband& band : subbandsOf(size)) {
    if (band.level != 1) continue;
    forEachCoefficient(band, size.width, [&](size_t i, size_t) {
      squares += std::pow(coarse[i] - std::ldexp(fine[i], -kMore), 2);
    });
  }
  return squares;
}

TEST(JointLifting, RoundsLessThanRowsAndColumns) {
  Random random(25);
  const Size size{256, 256};
  const Plane plane = randomPlane(random, size.count(), 0, 4000);
  for (const FilterId id : kTwoStepFilters) {
    WaveletSpec separable = uniform(id, true, 21);
    ASSERT_FALSE(separable.joint(1));
    const double joint = noiseOf(uniform(id, true, 16), plane, size);
    EXPECT_LT(joint, 0.75 * noiseOf(separable, plane, size)) << static_cast<int>(id);
  }
}

}  // namespace
}  // namespace tetrakis::test
