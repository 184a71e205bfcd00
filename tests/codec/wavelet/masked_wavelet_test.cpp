// SPDX-License-Identifier: Apache-2.0
// The wavelet of planes with voids: exact inverse, and no value crosses a coast.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "conformance/samples/void_masks.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

TEST(MaskedWavelet, IsReversible) {
  Random random(1);
  for (const WaveletSpec& spec : allSpecs()) {
    for (const int bits : {kNarrowBits, kWideBits}) {
      for (const Size& size : kMaskedSizes) {
        for (const VoidShape shape : kVoidShapes) {
          const auto valid = validity(shape, size.width, size.height);
          const Plane samples = randomPlane(random, size.count(), -(1 << 26), 1 << 26);
          const WaveletSpec exact = withBits(spec, bits);
          ASSERT_EQ(inverse(exact, forward(exact, samples, size, valid), size, valid), samples)
              << exact << ", " << size;
        }
      }
    }
  }
}

TEST(MaskedWavelet, RestoresValuesThatWrapAround) {
  Random random(2);
  for (const FilterId id : kAllFilters) {
    for (const int bits : {kNarrowBits, kWideBits}) {
      for (const Size& size : kMaskedSizes) {
        for (const VoidShape shape : kVoidShapes) {
          const auto valid = validity(shape, size.width, size.height);
          const WaveletSpec spec = uniform(id, false, bits);
          for (const Plane& samples : {randomPlane(random, size.count(), kLowest, kHighest),
                                       extremePlane(random, size.count(), kLowest, kHighest)}) {
            ASSERT_EQ(inverse(spec, forward(spec, samples, size, valid), size, valid), samples);
          }
        }
      }
    }
  }
}

/// Samples of 26 bits have coefficients below 2^30, beside voids and doubled too. The low bands of
/// four-step filters grow: these are not offered for so many bits.
TEST(MaskedWavelet, AmplifiesLittle) {
  Random random(3);
  for (const FilterId id : kTwoStepFilters) {
    for (const Size& size : {Size{17, 17}, Size{64, 65}, Size{2, 300}, Size{130, 90}}) {
      for (const VoidShape shape : kVoidShapes) {
        const auto valid = validity(shape, size.width, size.height);
        const Plane samples = extremePlane(random, size.count(), -(1 << 25), 1 << 25);
        for (const int32_t c : forward(uniform(id, true, 26), samples, size, valid)) {
          ASSERT_LT(std::abs(int64_t{c}), int64_t{1} << 30) << static_cast<int>(id) << ", " << size;
        }
      }
    }
  }
}

/// Voids are only moved to where the coefficient of their vertex stands.
TEST(MaskedWavelet, LeavesVoidsAlone) {
  for (const FilterId id : kAllFilters) {
    for (const Size& size : kMaskedSizes) {
      Plane samples(size.count());
      std::iota(samples.begin(), samples.end(), 1000);
      for (const VoidShape shape : kVoidShapes) {
        const auto valid = validity(shape, size.width, size.height);
        const Plane plane = forward(uniform(id), samples, size, valid);
        for (const Subband& band : subbandsOf(size)) {
          forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
            ASSERT_TRUE(valid[sample] || plane[coefficient] == samples[sample]) << size;
          });
        }
      }
    }
  }
}

/// What stands in a void changes no coefficient of a valid vertex, and no decoded sample.
TEST(MaskedWavelet, VoidsAreNotRead) {
  Random random(4);
  for (const WaveletSpec& spec : allSpecs()) {
    for (const Size& size : kMaskedSizes) {
      for (const VoidShape shape : kVoidShapes) {
        const auto valid = validity(shape, size.width, size.height);
        const Plane a = randomPlane(random, size.count(), -1000, 1000);
        Plane b = a;
        for (size_t i = 0; i < valid.size(); ++i) b[i] = valid[i] ? a[i] : 1 << 25;
        const Plane forward_a = forward(spec, a, size, valid),
                    forward_b = forward(spec, b, size, valid);
        for (const Subband& band : subbandsOf(size)) {
          forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
            ASSERT_TRUE(!valid[sample] || forward_a[coefficient] == forward_b[coefficient]) << size;
          });
        }
        Plane zeroed = forward_a;
        for (const Subband& band : subbandsOf(size)) {
          forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
            if (!valid[sample]) zeroed[coefficient] = 0;
          });
        }
        const Plane back = inverse(spec, zeroed, size, valid);
        for (size_t i = 0; i < valid.size(); ++i) ASSERT_TRUE(!valid[i] || back[i] == a[i]);
      }
    }
  }
}

TEST(MaskedWavelet, AMaskWithoutVoidsIsNoMask) {
  Random random(5);
  for (const WaveletSpec& spec : allSpecs()) {
    for (const int bits : {kNarrowBits, kWideBits}) {
      // But with any mask rows and columns are lifted one after the other.
      if (spec.whole && bits <= WaveletSpec::kJointBits) continue;
      for (const Size& size : kMaskedSizes) {
        const WaveletSpec exact = withBits(spec, bits);
        const std::vector<uint8_t> valid(size.count(), 1);
        // Masked sums never wrap: narrow ones agree as long as they do not either.
        const int32_t bound = bits == kNarrowBits ? 1 << 12 : 1 << 20;
        const Plane samples = randomPlane(random, size.count(), -bound, bound);
        ASSERT_EQ(forward(exact, samples, size, valid), forward(exact, samples, size));
        ASSERT_EQ(inverse(exact, samples, size, valid), inverse(exact, samples, size));
      }
    }
  }
}

/// A void among the first samples of a line is not felt beyond the reach of the filter: the masked
/// way and the fast one are the same arithmetic.
TEST(MaskedWavelet, VoidsAreNotFeltFarAway) {
  constexpr size_t kReach = 2 + 4 * 2 * kMaxPairs;  // four steps
  Random random(6);
  for (const FilterId id : kAllFilters) {
    for (const Size& size : {Size{101, 1}, Size{1, 101}, Size{100, 1}}) {
      std::vector<uint8_t> valid(size.count(), 1);
      valid[2] = 0;
      const Plane samples = randomPlane(random, size.count(), -30000, 30000);
      const Plane masked = forward(uniform(id), samples, size, valid),
                  plain = forward(uniform(id), samples, size);
      for (const Subband& band : subbandsOf(size)) {
        if (band.level != 1) continue;
        forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
          ASSERT_TRUE(sample < kReach || masked[coefficient] == plain[coefficient]) << sample;
        });
      }
    }
  }
}

/// A vertex without valid neighbours keeps its value.
TEST(MaskedWavelet, ALoneSampleStaysWhatItIs) {
  for (const WaveletSpec& spec : allSpecs()) {
    const Size size{40, 23};
    for (size_t lone = 0; lone < size.count(); lone += 7) {
      std::vector<uint8_t> valid(size.count(), 0);
      valid[lone] = 1;
      Plane samples(size.count(), 0);
      samples[lone] = -4321;
      const Plane plane = forward(spec, samples, size, valid);
      for (const Subband& band : subbandsOf(size)) {
        const int low = band.orientation == Orientation::kLL ? band.level : band.level - 1;
        const int doublings = spec.whole ? (low >= 3) + (low >= 4) : 0;
        forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
          ASSERT_EQ(plane[coefficient], sample == lone ? -4321 * (1 << doublings) : 0)
              << spec << ", level " << band.level;
        });
      }
    }
  }
}

/// Along one line a constant has no detail but where no coarser vertex is in reach.
TEST(MaskedWavelet, ConstantLinesHaveDetailsOnlyWhereTheyMust) {
  constexpr int32_t kValue = 5000;
  for (const FilterId id : kTwoStepFilters) {
    const auto reach = static_cast<int64_t>(2 * liftingFilter(id).steps[0].pairs - 1);
    for (const Size& size : {Size{301, 1}, Size{1, 300}}) {
      for (const VoidShape shape : kVoidShapes) {
        const auto valid = validity(shape, size.width, size.height);
        const auto count = static_cast<int64_t>(size.count());
        const Plane plane = forward(uniform(id), Plane(size.count(), kValue), size, valid);
        for (const Subband& band : subbandsOf(size)) {
          const int64_t step =
              band.orientation == Orientation::kLL ? 0 : int64_t{1} << (band.level - 1);
          forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
            if (!valid[sample]) return;
            bool predicted = false;
            for (int64_t k = 1; step > 0 && k <= reach; k += 2) {
              for (int64_t at : {static_cast<int64_t>(sample) - k * step,
                                 static_cast<int64_t>(sample) + k * step}) {
                if (at >= 0 && at < count) predicted |= valid[static_cast<size_t>(at)] != 0;
              }
            }
            ASSERT_TRUE(!predicted || plane[coefficient] == 0);
            ASSERT_TRUE(plane[coefficient] == 0 || plane[coefficient] == kValue);
          });
        }
      }
    }
  }
}

TEST(MaskedWavelet, ConstantsHaveFewDetails) {
  const Size size{65, 65};
  const auto valid = validity(VoidShape::kCoast, size.width, size.height);
  for (const FilterId id : kAllFilters) {
    const Plane plane = forward(uniform(id), Plane(valid.size(), 5000), size, valid);
    size_t details = 0;
    for (const Subband& band : subbandsOf(size)) {
      forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
        details += valid[sample] && std::abs(plane[coefficient]) > 1;
      });
    }
    EXPECT_LE(details, 40u) << static_cast<int>(id);
  }
}

}  // namespace
}  // namespace tetrakis::test
