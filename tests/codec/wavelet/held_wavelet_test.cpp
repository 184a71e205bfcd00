// SPDX-License-Identifier: Apache-2.0
// The wavelet of planes with held samples: exact inverse from free coefficients alone, and nothing
// rings where a constant ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/forest_shapes.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

/// Samples of which those that a shape leaves out are held, at one of two levels.
struct HeldPlane {
  Plane samples;
  std::vector<uint16_t> numbers;
  std::vector<int32_t> levels;

  HeldPlane(Plane plane, const Size& size, VoidShape shape, std::vector<int32_t> two_levels)
      : samples(std::move(plane)), numbers(size.count()), levels(std::move(two_levels)) {
    const std::vector<uint8_t> free = validity(shape, size.width, size.height);
    for (size_t i = 0; i < free.size(); ++i) {
      if (free[i]) continue;
      numbers[i] = static_cast<uint16_t>(1 + (i / 3) % 2);
      samples[i] = levels[numbers[i] - 1u];
    }
  }
  HeldSamples held() const { return {numbers, levels}; }
};

/// The coefficients, with anything in the places of held samples.
Plane coded(const WaveletSpec& spec, const Pyramid& pyramid, const HeldPlane& plane) {
  Plane coefficients = plane.samples;
  forwardWavelet(spec, pyramid, coefficients);
  for (const Subband& band : pyramid.subbands()) {
    forEachCoefficient(band, pyramid.plane().width, [&](size_t coefficient, size_t sample) {
      if (plane.numbers[sample] != 0) coefficients[coefficient] = 123456789;
    });
  }
  return coefficients;
}

TEST(HeldWavelet, IsReversibleFromFreeCoefficients) {
  Random random(1);
  for (const WaveletSpec& spec : allSpecs()) {
    for (const int bits : {kNarrowBits, kWideBits}) {
      for (const Size& size : kMaskedSizes) {
        for (const VoidShape shape : kVoidShapes) {
          const HeldPlane plane(randomPlane(random, size.count(), -(1 << 26), 1 << 26), size, shape,
                                {-1234567, 7654321});
          const Pyramid pyramid(size.extent(), {}, plane.held());
          const WaveletSpec exact = withBits(spec, bits);
          Plane decoded = coded(exact, pyramid, plane);
          inverseWavelet(exact, pyramid, decoded);
          for (size_t i = 0; i < decoded.size() && pyramid.levels() == 0; ++i) {
            if (plane.numbers[i] != 0) decoded[i] = plane.samples[i];
          }
          ASSERT_EQ(decoded, plane.samples) << exact << ", " << size << ", " << shape;
        }
      }
    }
  }
}

TEST(HeldWavelet, IsReversibleBesideVoidsAndWithThreads) {
  Random random(2);
  for (const WaveletSpec& spec : allSpecs()) {
    for (const Size& size : {Size{17, 17}, Size{40, 23}, Size{600, 300}, Size{2, 300}}) {
      const HeldPlane plane(randomPlane(random, size.count(), -(1 << 24), 1 << 24), size,
                            VoidShape::kCoast, {-(1 << 24), 99});
      const std::vector<uint8_t> valid = validity(VoidShape::kSpeckle, size.width, size.height);
      const Pyramid pyramid(size.extent(), valid, plane.held());
      Plane decoded = coded(spec, pyramid, plane);
      inverseWavelet(spec, pyramid, decoded, {.threads = 3});
      for (size_t i = 0; i < decoded.size(); ++i) {
        if (!valid[i]) decoded[i] = plane.samples[i];
      }
      ASSERT_EQ(decoded, plane.samples) << spec << ", " << size;
    }
  }
}

/// A plane of one height, half of it held, has no coefficient but those of its lowest band.
TEST(HeldWavelet, LeavesNoDetailInConstants) {
  for (const FilterId id : kTwoStepFilters) {
    for (const Size& size : kMaskedSizes) {
      for (const VoidShape shape : kVoidShapes) {
        const HeldPlane plane(Plane(size.count(), 777), size, shape, {777, 777});
        const Pyramid pyramid(size.extent(), {}, plane.held());
        Plane coefficients = plane.samples;
        forwardWavelet(uniform(id, true), pyramid, coefficients);
        for (const Subband& band : pyramid.subbands()) {
          if (band.orientation == Orientation::kLL) continue;
          forEachCoefficient(band, size.width, [&](size_t coefficient, size_t) {
            ASSERT_EQ(coefficients[coefficient], 0) << size << ", " << shape;
          });
        }
      }
    }
  }
}

/// Held areas are as far as anything else from a window that ends before them.
TEST(HeldWavelet, WindowsAreThoseOfThePlane) {
  Random random(3);
  const Size size{83, 70};
  for (const WaveletSpec& spec : allSpecs()) {
    const HeldPlane plane(randomPlane(random, size.count(), -5000, 5000), size, VoidShape::kCoast,
                          {-700, 300});
    const Pyramid pyramid(size.extent(), {}, plane.held());
    const Plane coefficients = coded(spec, pyramid, plane);
    for (const Window& window :
         {Window{0, 0, 83, 70}, Window{31, 8, 20, 33}, Window{82, 69, 1, 1}}) {
      WindowSynthesis synthesis(spec, pyramid, {0, window});
      synthesis.allocate();
      // Blocks hold the coefficients that a window needs; the first of them stands for itself.
      if (window.width == size.width) {
        for (const Subband& band : pyramid.subbands()) {
          for (uint32_t row = 0; row < synthesis.needed(band).height; ++row) {
            const std::span<int32_t> to = synthesis.row(band, row);
            std::copy_n(coefficients.data() + pyramid.indexOf(band, row), to.size(), to.data());
          }
        }
        ASSERT_EQ(synthesis.run(1), plane.samples) << spec;
      } else {
        const std::vector<int32_t> shown = synthesis.run(1);
        const std::vector<uint16_t> numbers =
            slice(std::span<const uint16_t>(plane.numbers), size.extent(), View{0, window});
        for (size_t i = 0; i < shown.size(); ++i) {
          if (numbers[i] == 0) continue;
          ASSERT_EQ(shown[i], plane.levels[numbers[i] - 1u]) << spec;
        }
      }
    }
  }
}

/// Samples that patches share are held alike.
HeldPlane sharedBy(const Forest& forest, HeldPlane plane) {
  shareOwned(forest, std::span(plane.samples), forest.side() - 1);
  shareOwned(forest, std::span(plane.numbers), forest.side() - 1);
  return plane;
}

TEST(HeldWavelet, OfForestsIsReversibleFromFreeCoefficients) {
  Random random(3);
  for (const ForestShape& shape : forestShapes()) {
    for (const int depth : {1, 2, 4}) {
      const auto forest = std::make_shared<const Forest>(depth, shape.sides);
      const Extent raster = forest->raster();
      const Size size{raster.width, raster.height};
      for (const FilterId id : kTwoStepFilters) {
        for (const VoidShape voids : kVoidShapes) {
          const HeldPlane plane =
              sharedBy(*forest, HeldPlane(randomPlane(random, size.count(), -(1 << 20), 1 << 20),
                                          size, voids, {-123456, 765432}));
          const Pyramid pyramid(*forest, plane.held());
          WaveletSpec spec = withBits(uniform(id, true), kWideBits);
          spec.forest = forest;
          Plane decoded = coded(spec, pyramid, plane);
          inverseWavelet(spec, pyramid, decoded, {.threads = 2});
          for (size_t i = 0; i < decoded.size() && pyramid.levels() == 0; ++i) {
            if (plane.numbers[i] != 0) decoded[i] = plane.samples[i];
          }
          ASSERT_EQ(decoded, plane.samples) << shape.name << depth << ", " << voids;
        }
      }
    }
  }
}

/// A forest of one height, half of it held, has no coefficient but those of its lowest bands.
TEST(HeldWavelet, OfForestsLeavesNoDetailInConstants) {
  const auto forest = std::make_shared<const Forest>(4, cubeShape().sides);
  const Size size{forest->raster().width, forest->raster().height};
  for (const FilterId id : kTwoStepFilters) {
    const HeldPlane plane =
        sharedBy(*forest, HeldPlane(Plane(size.count(), 777), size, VoidShape::kCoast, {777, 777}));
    const Pyramid pyramid(*forest, plane.held());
    WaveletSpec spec = uniform(id, true);
    spec.forest = forest;
    Plane coefficients = plane.samples;
    forwardWavelet(spec, pyramid, coefficients);
    for (const Subband& band : pyramid.subbands()) {
      if (band.orientation == Orientation::kLL) continue;
      for (uint32_t row = 0; row < band.height; ++row) {
        for (uint32_t x = 0; x < band.width; ++x)
          ASSERT_EQ(coefficients[pyramid.indexOf(band, row) + x], 0);
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
