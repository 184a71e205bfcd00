// SPDX-License-Identifier: Apache-2.0
// Heights to samples, against the formula of docs/FORMAT.md, section 8, for any steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "codec/geometry/steps/decoded_heights.hpp"
#include "tests/support/random_planes.hpp"

namespace tetrakis::test {
namespace {

struct Scale {
  double base, step;
};

constexpr Scale kScales[] = {{0, 1},          {100, 3},       {-7, 255},      {32767, 1 << 26},
                             {0.5, 1},        {-0.25, 0.5},   {1 << 26, 1},   {-(1 << 26), 7},
                             {1e9, 1},        {-3e9, 65536},  {12, 1e-3},     {65535, 1 << 25},
                             {-1e300, 1e292}, {1e308, 1e308}, {-128.5, 0.75}, {3, 67108865}};

/// Heights near 0, where rounding matters, and wild ones.
Plane someHeights(Random& random) {
  Plane heights = randomPlane(random, 400, -1000, 1000);
  for (const Plane& more :
       {randomPlane(random, 400, -(1 << 20), 1 << 20), randomPlane(random, 400, kLowest, kHighest),
        extremePlane(random, 20, kLowest, kHighest)})
    heights.insert(heights.end(), more.begin(), more.end());
  return heights;
}

template <class T>
T expected(const Scale& scale, int32_t height, int fraction_bits) {
  const int64_t half = (int64_t{1} << fraction_bits) >> 1;
  const auto q = static_cast<double>((height + half) >> fraction_bits);
  const double low = static_cast<double>(std::numeric_limits<T>::min());
  const double high = static_cast<double>(std::numeric_limits<T>::max());
  return static_cast<T>(std::clamp(std::round(scale.base + q * scale.step), low, high));
}

template <class T>
void expectFormula(tks_sample sample) {
  Random random(static_cast<unsigned>(sample) + 1);
  for (const Scale& scale : kScales) {
    for (const int fraction_bits : {0, 1, 4, 8}) {
      DecodedHeights decoded;
      decoded.geometry.heights = someHeights(random);
      decoded.geometry.fraction_bits = fraction_bits;
      GeometryHeader header{};
      header.sample = static_cast<uint8_t>(sample);
      header.base = scale.base;
      header.step = scale.step;
      const Plane& heights = decoded.geometry.heights;
      std::vector<T> samples(heights.size());
      fromSteps(decoded, header, {}, samples.data());
      for (size_t i = 0; i < heights.size(); ++i) {
        ASSERT_EQ(samples[i], expected<T>(scale, heights[i], fraction_bits))
            << heights[i] << " with base " << scale.base << ", step " << scale.step;
      }
    }
  }
}

TEST(HeightSamples, FollowTheFormula) {
  expectFormula<uint8_t>(TKS_U8);
  expectFormula<int8_t>(TKS_I8);
  expectFormula<uint16_t>(TKS_U16);
  expectFormula<int16_t>(TKS_I16);
  expectFormula<uint32_t>(TKS_U32);
  expectFormula<int32_t>(TKS_I32);
}

}  // namespace
}  // namespace tetrakis::test
