// SPDX-License-Identifier: Apache-2.0
// Stated norms of the synthesis functions against impulses that go through a synthesis in floating
// point, written here from the lifting equations; and the plan that is made from them.
#include <gtest/gtest.h>

#include <cmath>

#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using Real = std::vector<double>;

/// Inverse lifting of one line, low half before high half, by its equations.
Real merged(const Real& line, FilterId id) {
  const size_t n = line.size(), lows = n - n / 2;
  Real out(n);
  for (size_t i = 0; i < n; ++i) out[i < lows ? 2 * i : 2 * (i - lows) + 1] = line[i];
  const auto at = [&](ptrdiff_t p) {
    const auto last = static_cast<ptrdiff_t>(n) - 1;
    while (p < 0 || p > last) p = p < 0 ? -p : 2 * last - p;
    return out[static_cast<size_t>(p)];
  };
  const LiftingFilter filter = liftingFilter(id);
  for (size_t s = filter.steps.size(); s-- > 0;) {
    for (size_t t = s % 2 == 0 ? 1 : 0; t < n; t += 2) {
      double change = 0;
      for (size_t k = 0; k < filter.steps[s].pairs; ++k) {
        const auto p = static_cast<ptrdiff_t>(t), d = static_cast<ptrdiff_t>(2 * k + 1);
        change += filter.steps[s].weights[k] * (at(p - d) + at(p + d));
      }
      out[t] -= change / (1 << filter.shift);
    }
  }
  return out;
}

/// What one direction of an impulse in a band becomes: the synthesis is separable.
Real lineOf(const WaveletSpec& spec, std::vector<uint32_t> sides, bool high, int level) {
  const uint32_t whole = sides[static_cast<size_t>(level) - 1],
                 low = sides[static_cast<size_t>(level)];
  Real line(whole, 0.0);
  const bool split = low < whole;
  line[!split ? whole / 2 : high ? low + (whole - low) / 2 : low / 2] = 1;
  for (auto l = static_cast<size_t>(level); l >= 1; --l) {
    line.resize(sides[l - 1], 0.0);
    if (sides[l] < sides[l - 1]) line = merged(line, spec.filter(static_cast<int>(l)));
  }
  return line;
}

double energyOf(const Real& line) {
  double energy = 0;
  for (const double v : line) energy += v * v;
  return energy;
}

/// Squared norm of an impulse in the middle of the band, through the whole plane.
double measuredEnergy(const WaveletSpec& spec, const Size& size, const Subband& band) {
  std::vector<uint32_t> widths, heights;
  const Pyramid pyramid(size.extent());
  for (int level = 0; level <= pyramid.levels(); ++level) {
    widths.push_back(pyramid.low(level).extent.width);
    heights.push_back(pyramid.low(level).extent.height);
  }
  const Real x = lineOf(spec, widths, band.isHighX(), band.level),
             y = lineOf(spec, heights, band.isHighY(), band.level);
  const int low = band.orientation == Orientation::kLL ? band.level : band.level - 1;
  const int doublings = spec.whole ? (low >= 3) + (low >= 4) + (low >= 5) : 0;
  return energyOf(x) * energyOf(y) / std::pow(4, doublings);
}

/// Every subband as a whole.
std::vector<BandPart> allParts(const PlaneLayout& layout, uint32_t width, uint32_t height) {
  return layout.parts(regionsOf(width, height, 0).front());
}

void expectNorms(const Size& size) {
  for (const WaveletSpec& spec : allSpecs()) {
    const PlaneLayout layout(spec, Pyramid(size.extent()));
    const std::vector<BandPlan> plan = layout.plan(allParts(layout, size.width, size.height));
    for (size_t i = 0; i < layout.subbands().size(); ++i) {
      const Subband& band = layout.subbands()[i];
      // Synthesis functions are some twenty coefficients wide; no room for the ends.
      if (band.level == 0 || (band.width < 20 && size.width > 1) ||
          (band.height < 20 && size.height > 1) || band.width * band.height == 0)
        continue;
      const double log_norm = 0.5 * std::log2(measuredEnergy(spec, size, band));
      // Both directions are rounded down to 1 / 256, and so are the levels that are extrapolated.
      EXPECT_NEAR(0.5 * std::log2(layout.energy(i)), log_norm, 4.0 / 256)
          << spec << " " << band.level;
      EXPECT_NEAR(plan[i].log_norm, 16 * log_norm, 0.7) << spec << " " << band.level;
    }
  }
}

TEST(Norms, MatchImpulsesInThePlane) {
  expectNorms({600, 501});
}
TEST(Norms, MatchImpulsesAlongRows) {
  expectNorms({5000, 1});
}
/// Eleven levels with room: one more than is measured.
TEST(Norms, MatchImpulsesInLargePlanes) {
  expectNorms({1, 45000});
  expectNorms({45000, 45000});
}

/// The reference is what the integer transform computes.
TEST(Norms, IntegerSynthesisFollowsTheReference) {
  const Size size{90, 61};
  for (const WaveletSpec& spec : mixedSpecs()) {
    WaveletSpec wide = spec;
    wide.bits = kWideBits;
    for (const Subband& band : subbandsOf(size)) {
      if (band.width * band.height == 0) continue;
      Plane plane(size.count(), 0);
      plane[size_t{band.planeRow(band.height / 2)} * size.width + band.x + band.width / 2] = 1
                                                                                             << 20;
      inverseWavelet(wide, Pyramid(size.extent()), plane);
      double energy = 0;
      for (const int32_t v : plane) energy += std::pow(v / 1048576.0, 2);
      EXPECT_NEAR(energy / measuredEnergy(spec, size, band), 1, 1e-3) << spec << " " << band.level;
    }
  }
}

/// Parents: the same direction, one level coarser, half the size in the directions that are split.
TEST(PlaneLayout, ParentsCoverTheirChildren) {
  for (uint32_t height = 1; height <= 40; ++height) {
    for (uint32_t width = 1; width <= 70; width += 3) {
      const PlaneLayout layout(uniform(FilterId::kLong), Pyramid({width, height}));
      const std::vector<BandPlan> plan = layout.plan(allParts(layout, width, height), 100, 7, 5);
      for (const BandPlan& band : plan) {
        ASSERT_TRUE(band.models >= 5 && band.models < 5 + kPlaneModels);
        if (band.parent == BandPlan::kNone) continue;
        ASSERT_GE(band.parent, 100);
        const BandPlan& parent = plan[static_cast<size_t>(band.parent - 100)];
        ASSERT_LT(&parent, &band) << "coded before";
        ASSERT_EQ(parent.orientation, band.orientation);
        ASSERT_FALSE(parent.shape.empty());
        if (band.shape.empty()) continue;
        // One row or column of the margin may be read: it is zero.
        ASSERT_LE((band.shape.rows - 1) / 2, parent.shape.rows);
        ASSERT_LE((band.shape.columns - 1) / 2, parent.shape.columns);
      }
    }
  }
}

/// Siblings: the other directions of the level, of the same size but for a last row and column.
TEST(PlaneLayout, SiblingsHaveThePlacesOfEachOther) {
  for (uint32_t height = 1; height <= 40; ++height) {
    for (uint32_t width = 1; width <= 70; width += 3) {
      const PlaneLayout layout(uniform(FilterId::kLong), Pyramid({width, height}));
      const std::vector<BandPart> parts = allParts(layout, width, height);
      const std::vector<BandPlan> plan = layout.plan(parts, 100, 7, 5);
      for (size_t i = 0; i < plan.size(); ++i) {
        size_t expected = 0;
        for (size_t j = 1; i > 0 && j < plan.size(); ++j)
          expected += j != i && (j - 1) / 3 == (i - 1) / 3 && !plan[j].shape.empty();
        for (const int index : plan[i].siblings) {
          if (index == BandPlan::kNone) continue;
          const size_t sibling = static_cast<size_t>(index - 100);
          ASSERT_NE(sibling, i);
          ASSERT_EQ((sibling - 1) / 3, (i - 1) / 3);
          ASSERT_FALSE(plan[sibling].shape.empty());
          --expected;
          if (plan[i].shape.empty()) continue;
          ASSERT_LE(plan[i].shape.rows, plan[sibling].shape.rows + 1);
          ASSERT_LE(plan[i].shape.columns, plan[sibling].shape.columns + 1);
        }
        ASSERT_EQ(expected, 0u);
      }
    }
  }
}

TEST(PlaneLayout, GatheredCoefficientsArePutBack) {
  Random random(3);
  for (const Size& size : {Size{1, 1}, Size{37, 70}, Size{130, 5}, Size{3, 64}}) {
    const Plane plane = randomPlane(random, size.count(), -5000, 5000);
    const PlaneLayout layout(uniform(FilterId::kShort), Pyramid(size.extent()));
    ViewSynthesis back(uniform(FilterId::kShort), layout.pyramid(), {});
    back.allocate();
    for (const BandPart& part : allParts(layout, size.width, size.height)) {
      const Subband& subband = layout.subbands()[part.subband];
      const std::vector<int32_t> values = layout.gather(plane, part);
      Band band(part.shape(), subband.orientation);
      band.tier_states[0].plane = 0;
      band.tier_states[0].nonzero = true;
      band.makeCells();
      for (uint32_t row = 0; row < subband.height; ++row) {
        for (uint32_t column = 0; column < subband.width; ++column) {
          const size_t cell = band.shape.cell(row, column);
          band.magnitude[cell] = static_cast<uint32_t>(std::abs(values[cell]));
          band.sign[cell] = static_cast<int8_t>((values[cell] > 0) - (values[cell] < 0));
          const uint32_t bit = uint32_t{1} << column % 32;
          band.visited[band.shape.word(row, column / 32)] |= bit;
          if (values[cell] != 0) band.significant[band.shape.word(row, column / 32)] |= bit;
        }
      }
      back.put(band, 0, part);
    }
    EXPECT_EQ(back.run(1), inverse(uniform(FilterId::kShort), plane, size)) << size;
  }
}

}  // namespace
}  // namespace tetrakis::test
