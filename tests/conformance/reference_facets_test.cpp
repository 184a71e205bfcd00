// SPDX-License-Identifier: Apache-2.0
// Corrections from facets at the ends of all ranges, by the codec and by the reference decoder.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "codec/geometry/facets/facet_coder.hpp"
#include "codec/geometry/facets/facets_encoder.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "conformance/reference_decoder/sample_corrections.hpp"
#include "conformance/reference_decoder/samples.hpp"
#include "conformance/samples/facets.hpp"

namespace tetrakis::test {
namespace {

constexpr Extent kFaceted = {43, 31};

/// Floats that exceed every limit there is: of units, sums, forecasts, steps.
std::vector<std::function<float(uint32_t x, uint32_t y, uint32_t random)>> extremeFloats() {
  const auto facet = [](double factor) {
    return [factor](uint32_t x, uint32_t y, uint32_t) {
      return static_cast<float>(factor * (samples::facetAt(x, y, 7.3, 5) - 90));
    };
  };
  return {facet(1),
          facet(1e-42),
          facet(1e36),
          [](uint32_t, uint32_t, uint32_t random) { return std::bit_cast<float>(random); },
          [](uint32_t, uint32_t, uint32_t random) { return random % 2 == 0 ? 3e38f : -3e38f; },
          [](uint32_t x, uint32_t, uint32_t random) {
            return random % 40 == 0 ? std::bit_cast<float>(random) : 0.3f * static_cast<float>(x);
          },
          [](uint32_t x, uint32_t y, uint32_t) { return (x / 9 + y / 9) % 2 == 0 ? 0.f : -0.f; },
          [](uint32_t x, uint32_t y, uint32_t) {
            return static_cast<float>(std::ldexp(1.0 + 0.001 * x, static_cast<int>(y * 8) - 140));
          }};
}

TEST(Reference, AgreesOnFacetsOfExtremeFloats) {
  std::mt19937 source(7);
  const auto random = [&] { return static_cast<uint32_t>(source()); };
  const auto kinds = extremeFloats();
  for (size_t trial = 0; trial < 6 * kinds.size(); ++trial) {
    const auto& kind = kinds[trial % kinds.size()];
    const int unit = std::array{1, 60, 98, 150, 254, 92}[trial / kinds.size()];
    std::vector<float> samples;
    DecodedHeights near;
    near.geometry.width = kFaceted.width;
    near.geometry.height = kFaceted.height;
    near.geometry.fraction_bits = static_cast<int>(trial % 9);
    for (uint32_t i = 0; i < kFaceted.samples(); ++i) {
      samples.push_back(kind(i % kFaceted.width, i / kFaceted.width, random()));
      near.geometry.valid.push_back(trial % 3 > 0 || random() % 3 > 0);
      near.geometry.heights.push_back(static_cast<int32_t>(random()) >> (trial % 16));
    }
    GeometryHeader header;
    header.width = kFaceted.width;
    header.height = kFaceted.height;
    header.sample = TKS_F32;
    header.base = trial % 2 == 0 ? 3.25 : -1e30;
    header.step = std::array{0.125, 1e-40, 1e30, 77.}[trial % 4];
    tks_heights input = {};
    input.size = sizeof input;
    input.data = samples.data();
    input.width = kFaceted.width;
    input.height = kFaceted.height;
    input.sample = TKS_F32;
    input.scale = 1;
    const std::vector<int32_t> steps = wholeSteps(near.geometry);
    const std::vector<uint8_t> whole =
        encodeFacets(input, {steps, kFaceted, near.geometry.valid},
                     {0, 0, kFaceted.width, kFaceted.height}, header, unit);
    for (const size_t bytes : {whole.size(), whole.size() / 2, size_t{3}}) {
      const auto codeword = std::span(whole).first(std::min(bytes, whole.size()));
      const DecodedHeights restored = restoreFacets(near, header, unit, codeword);
      std::vector<float> out(kFaceted.samples());
      GeometryLayers layers;
      layers.has_nodata = 1;
      layers.nodata = 1e9;  // which no sample has
      fromSteps(restored, header, layers, reinterpret_cast<std::byte*>(out.data()));

      reference::GeometryHeader stated;
      stated.width = static_cast<int>(kFaceted.width);
      stated.height = static_cast<int>(kFaceted.height);
      stated.sample = reference::kF32;
      stated.base = header.base;
      stated.step = header.step;
      reference::Layers of_facets;
      of_facets.facetUnit = unit;
      const reference::Plane plane{stated.width, stated.height, steps, near.geometry.valid};
      std::vector<uint32_t> expected;
      for (const int32_t step : steps) expected.push_back(reference::heightSampleOf(stated, step));
      reference::correctFromFacets(stated, of_facets, codeword, plane, expected);
      for (size_t i = 0; i < out.size(); ++i) {
        if (!near.geometry.valid[i]) continue;
        ASSERT_EQ(std::bit_cast<uint32_t>(out[i]), expected[i]) << trial << ", " << bytes;
        if (bytes == whole.size()) {
          ASSERT_EQ(std::memcmp(&out[i], &samples[i], 4), 0) << trial;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
