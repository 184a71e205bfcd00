// SPDX-License-Identifier: Apache-2.0
// The wavelet of planes whose last column lies beside the first one: exact inverse, constants, and
// no column is told from another.
#include <gtest/gtest.h>

#include <algorithm>

#include "codec/wavelet/lifting/lifting.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

WaveletSpec ring(WaveletSpec spec) {
  spec.ring = true;
  return spec;
}

std::vector<WaveletSpec> ringSpecs() {
  std::vector<WaveletSpec> specs = allSpecs();
  for (WaveletSpec& spec : specs) spec.ring = true;
  return specs;
}

/// The columns of every row, so many places further on round the ring.
Plane turned(const Plane& plane, const Size& size, uint32_t by) {
  Plane out = plane;
  for (size_t y = 0; y < size.height; ++y) {
    const auto row = out.begin() + static_cast<ptrdiff_t>(y * size.width);
    std::rotate(row, row + size.width - by % size.width, row + size.width);
  }
  return out;
}

TEST(RingWavelet, RestoresEveryWidth) {
  Random random(1);
  for (const WaveletSpec& spec : ringSpecs()) {
    for (const int bits : {kNarrowBits, kWideBits}) {
      for (const uint32_t height : {1u, 2u, 5u, 16u, 23u}) {
        for (uint32_t width = 1; width <= 70; ++width) {
          const Size size{width, height};
          const WaveletSpec exact = withBits(spec, bits);
          const Plane samples = randomPlane(random, size.count(), -32768, 32767);
          ASSERT_EQ(inverse(exact, forward(exact, samples, size), size), samples)
              << exact << ", " << size;
        }
      }
    }
  }
}

/// Lifting is invertible modulo 2^32; only doubling loses a bit.
TEST(RingWavelet, RestoresValuesThatWrapAround) {
  Random random(2);
  for (const FilterId id : kAllFilters) {
    for (const bool whole : {false, true}) {
      for (const int bits : {8, kNarrowBits, kWideBits}) {
        WaveletSpec spec = ring(uniform(id, whole, bits));
        spec.first_doubled = 0;
        for (const Size& size : {Size{2, 1}, Size{3, 5}, Size{17, 23}, Size{1000, 3}}) {
          for (const Plane& samples : {randomPlane(random, size.count(), kLowest, kHighest),
                                       extremePlane(random, size.count(), kLowest, kHighest)})
            ASSERT_EQ(inverse(spec, forward(spec, samples, size), size), samples) << spec;
        }
      }
    }
  }
}

TEST(RingWavelet, RestoresWhatLiesBesideVoids) {
  Random random(3);
  for (const WaveletSpec& spec : ringSpecs()) {
    for (const Size& size : kMaskedSizes) {
      for (const VoidShape shape : kVoidShapes) {
        const auto valid = validity(shape, size.width, size.height);
        const Plane samples = randomPlane(random, size.count(), -(1 << 26), 1 << 26);
        ASSERT_EQ(inverse(spec, forward(spec, samples, size, valid), size, valid), samples)
            << spec << ", " << size;
      }
    }
  }
}

TEST(RingWavelet, RestoresWhatLiesBesideHeldSamples) {
  Random random(4);
  const std::vector<int32_t> levels = {-54321};
  for (const WaveletSpec& spec : ringSpecs()) {
    for (const Size& size : kMaskedSizes) {
      for (const VoidShape shape : kVoidShapes) {
        const auto free = validity(shape, size.width, size.height);
        Plane samples = randomPlane(random, size.count(), -(1 << 26), 1 << 26);
        std::vector<uint16_t> numbers(free.size());
        for (size_t i = 0; i < free.size(); ++i) {
          numbers[i] = free[i] == 0;
          if (free[i] == 0) samples[i] = levels.front();
        }
        const Pyramid pyramid(size.extent(), {}, {numbers, levels});
        Plane coded = samples;
        forwardWavelet(spec, pyramid, coded);
        inverseWavelet(spec, pyramid, coded);
        ASSERT_EQ(coded, samples) << spec << ", " << size;
      }
    }
  }
}

/// But for roundings of filters of four steps.
TEST(RingWavelet, FindsNoDetailInConstants) {
  const auto rounds = [](FilterId id) {
    return id == FilterId::kQuiet || id == FilterId::kOrthogonal;
  };
  for (const WaveletSpec& spec : ringSpecs()) {
    if (rounds(spec.filters.back())) continue;
    for (uint32_t width = 1; width <= 70; ++width) {
      const Size size{width, 9};
      const Plane coded = forward(spec, Plane(size.count(), 1000), size);
      for (const Subband& band : subbandsOf(size)) {
        if (band.orientation == Orientation::kLL || rounds(spec.filter(band.level))) continue;
        forEachCoefficient(band, width, [&](size_t coefficient, size_t) {
          ASSERT_EQ(coded[coefficient], 0) << spec << ", " << size;
        });
      }
    }
  }
}

TEST(RingWavelet, TurnsCoefficientsAsSamplesAreTurned) {
  Random random(5);
  const Size size{96, 40};  // 96, 48, 24, 12, 6, 3 columns
  for (const WaveletSpec& spec : ringSpecs()) {
    const Plane samples = randomPlane(random, size.count(), -32768, 32767);
    const Plane coded = forward(spec, samples, size);
    for (const uint32_t by : {32u, 64u}) {
      const Plane other = forward(spec, turned(samples, size, by), size);
      for (const Subband& band : subbandsOf(size)) {
        for (uint32_t row = 0; row < band.height; ++row) {
          const size_t line = size_t{band.planeRow(row)} * size.width + band.x;
          for (uint32_t column = 0; column < band.width; ++column) {
            const uint32_t to = (column + (by >> band.splits_x)) % band.width;
            ASSERT_EQ(other[line + to], coded[line + column]) << spec << ", by " << by;
          }
        }
      }
    }
  }
}

TEST(RingWavelet, TurnsOneRowByAnyEvenNumberOfColumns) {
  Random random(6);
  for (const FilterId id : kAllFilters) {
    for (uint32_t width = 2; width <= 70; width += 2) {
      RowLifting lifting(width, Ends::kJoined);
      const Size row{width, 1}, half{width / 2, 2};
      const Plane samples = randomPlane(random, width, -32768, 32767);
      Plane coded = samples;
      lifting.analyse(coded.data(), width, id, true);
      for (uint32_t by = 2; by < width; by += 2) {
        Plane other = turned(samples, row, by);
        lifting.analyse(other.data(), width, id, true);
        ASSERT_EQ(other, turned(coded, half, by / 2)) << width << " columns, by " << by;
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
