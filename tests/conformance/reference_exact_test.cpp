// SPDX-License-Identifier: Apache-2.0
// Exact corrections at the ends of all ranges, by the codec and by the reference decoder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "codec/geometry/corrections/corrections_decoder.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "conformance/reference_decoder/layers.hpp"

namespace tetrakis::test {
namespace {

constexpr Extent kPlane = {41, 37};

/// Steps that exceed every limit there is: of forecasts, weights, divisors, far steps, numbers.
std::vector<std::function<uint32_t(uint32_t x, uint32_t y, uint32_t random)>> extremeSteps() {
  return {[](uint32_t, uint32_t, uint32_t random) { return random; },
          [](uint32_t, uint32_t, uint32_t random) { return random % 3 * 40 + 7; },
          [](uint32_t, uint32_t, uint32_t random) { return random % 5 * 41; },
          [](uint32_t, uint32_t, uint32_t random) { return random % 5 * 39 - 1000000; },
          [](uint32_t x, uint32_t y, uint32_t) { return (x / 9 + y / 9) % 2 * 2000000000u; },
          [](uint32_t, uint32_t, uint32_t random) { return random % 50 == 0 ? random : 5; },
          [](uint32_t, uint32_t, uint32_t random) { return random % 2 * 0x7fffffffu; },
          [](uint32_t x, uint32_t y, uint32_t) { return x * 1000003 + y * 77; },
          [](uint32_t, uint32_t, uint32_t) { return 0u; },
          [](uint32_t, uint32_t, uint32_t random) { return random % 70000 - 35000; },
          [](uint32_t, uint32_t, uint32_t random) { return 0x7fffffffu + random % 2; }};
}

TEST(Reference, AgreesOnExactCorrectionsOfExtremeSteps) {
  std::mt19937 source(7);
  const auto random = [&] { return static_cast<uint32_t>(source()); };
  const auto kinds = extremeSteps();
  for (size_t kind = 0; kind < kinds.size(); ++kind) {
    const int f = static_cast<int>(kind % 9);
    std::vector<int32_t> steps, heights;
    std::vector<uint8_t> valid;
    for (uint32_t i = 0; i < kPlane.samples(); ++i) {
      valid.push_back(kind % 3 > 0 || random() % 3 > 0);
      const uint32_t step =
          valid.back() ? kinds[kind](i % kPlane.width, i / kPlane.width, random()) : 0;
      const uint32_t near = (step << f) + random() % 90000 - 45000;
      const auto elsewhere = static_cast<int32_t>(random()) >> (3 + kind);
      steps.push_back(static_cast<int32_t>(step));
      heights.push_back(kind % 2 == 0 ? static_cast<int32_t>(near) : elsewhere);
    }
    const PlaneView<const int32_t> plane(heights, kPlane, valid);
    const std::vector<uint8_t> whole = encodeExactSteps(steps, plane, f);
    for (const size_t bytes : {whole.size(), whole.size() / 2, size_t{3}}) {
      const auto codeword = std::span(whole).first(std::min(bytes, whole.size()));
      std::vector<int32_t> shown = heights;
      size_t decided = 0;
      decodeExactSteps(codeword, plane, f, [&](size_t first, std::span<const int32_t> row) {
        for (size_t x = 0; x < row.size(); ++x, ++decided)
          if (valid[first + x])
            shown[first + x] = static_cast<int32_t>(static_cast<uint32_t>(row[x]) << f);
      });
      reference::Plane reference{static_cast<int>(kPlane.width), static_cast<int>(kPlane.height),
                                 heights, valid};
      reference::makeExact(codeword, reference, f);
      ASSERT_EQ(shown, reference.values) << kind << ", " << bytes;
      EXPECT_TRUE(bytes < whole.size() || decided == kPlane.samples()) << kind;
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
