// SPDX-License-Identifier: Apache-2.0
// Kinds of sample terrain: the same bytes everywhere, and the trait that each is made for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "apps/tools/synth/synth.hpp"
#include "tests/support/synth_digest.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint32_t kSize = 129;
constexpr double kVoid = -9999;

/// Metres as stored; voids stay kVoid.
std::vector<double> metresOf(const HeightFile& file) {
  std::vector<double> metres;
  for (size_t i = 0; i < size_t{file.width} * file.height; ++i) {
    if (file.sample == TKS_U16) {
      uint16_t sample;
      std::memcpy(&sample, &file.data[2 * i], sizeof sample);
      metres.push_back(sample * file.scale);
    } else {
      float sample;
      std::memcpy(&sample, &file.data[4 * i], sizeof sample);
      metres.push_back(sample);
    }
  }
  return metres;
}

std::vector<double> metresOf(SynthKind kind, uint64_t seed) {
  return metresOf(synthesize({kSize, seed, kind}).heights);
}

/// Of all samples but the last column, the share whose step to the eastern neighbour `holds`.
template <class Holds>
double shareOfSteps(const std::vector<double>& metres, Holds holds) {
  size_t count = 0;
  for (size_t i = 0; i + 1 < metres.size(); ++i)
    count += (i + 1) % kSize != 0 && holds(std::abs(metres[i + 1] - metres[i]));
  return static_cast<double>(count) / ((kSize - 1) * kSize);
}

/// Sizes of the side-connected areas that `inside` holds for, by the height of one of their
/// samples.
template <class Inside>
std::vector<std::pair<double, size_t>> areasOf(const std::vector<double>& metres, Inside inside) {
  std::vector<std::pair<double, size_t>> areas;
  std::vector<bool> seen(metres.size());
  for (size_t start = 0; start < metres.size(); ++start) {
    if (seen[start] || !inside(metres[start], metres[start])) continue;
    std::vector<size_t> open{start};
    seen[start] = true;
    size_t area = 0;
    while (!open.empty()) {
      const size_t at = open.back();
      open.pop_back();
      ++area;
      const auto visit = [&](bool exists, size_t next) {
        if (!exists || seen[next] || !inside(metres[start], metres[next])) return;
        seen[next] = true;
        open.push_back(next);
      };
      visit(at % kSize > 0, at - 1);
      visit(at % kSize + 1 < kSize, at + 1);
      visit(at >= kSize, at - kSize);
      visit(at + kSize < metres.size(), at + kSize);
    }
    areas.emplace_back(metres[start], area);
  }
  return areas;
}

TEST(SynthKinds, MakeTheSameBytesEverywhere) {
  constexpr uint64_t kDigests[] = {0x4034d9316f42ecb5u, 0xe16895c828fac842u, 0x258a0ae1a04cdb93u,
                                   0xea646d0c221fbf14u, 0x45a49728f8f1c229u, 0x43987c57ef155ac7u,
                                   0x127a105b6a2645fbu, 0x2421035136751a12u, 0xc8c552b13c885c57u,
                                   0xf563fb7491c34841u, 0xf9011a9faa66495au, 0xbbdaa312fa1911ddu,
                                   0x59cd26fa64bc6c55u, 0x166395fab91e9920u};
  static_assert(std::size(kDigests) == kSynthKinds.size());
  for (size_t kind = 0; kind < kSynthKinds.size(); ++kind) {
    const SynthTerrain t = synthesize({65, 7, static_cast<SynthKind>(kind)});
    const uint64_t all = test::digest(t);
    EXPECT_EQ(all, kDigests[kind]) << kSynthKinds[kind] << std::hex << " 0x" << all;
  }
}

TEST(SynthKinds, HaveTheStatedShapeInEverySize) {
  for (size_t kind = 0; kind < kSynthKinds.size(); ++kind) {
    for (const uint32_t size : {2u, 3u, 17u, 129u}) {
      const SynthTerrain t = synthesize({size, 5, static_cast<SynthKind>(kind)});
      EXPECT_EQ(t.heights.width, size);
      EXPECT_EQ(t.heights.height, size);
      EXPECT_EQ(t.heights.data.size(), tks_sample_bytes(t.heights.sample) * size * size);
      EXPECT_EQ(t.texture.data.size(), size_t{12} * (size - 1) * (size - 1));
      EXPECT_EQ(t.map.data.size(), t.texture.data.size());
      const std::vector<double> metres = metresOf(t.heights);
      EXPECT_GE(metres[(size / 2) * (size + 1)], 0) << kSynthKinds[kind] << size;
      for (const double height : metres)
        ASSERT_TRUE((height >= 0 && height < 6600) || (t.heights.nodata && height == kVoid));
    }
  }
}

class SynthKindsOf : public testing::TestWithParam<uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, SynthKindsOf, testing::Values(1, 2, 3));

TEST_P(SynthKindsOf, CoastsHaveASeaAtZeroAndIslands) {
  const std::vector<double> metres = metresOf(SynthKind::kCoast, GetParam());
  const double sea =
      static_cast<double>(std::count(metres.begin(), metres.end(), 0.0)) / (kSize * kSize);
  EXPECT_GT(sea, 0.3);
  EXPECT_LT(sea, 0.6);
  EXPECT_GE(areasOf(metres, [](double, double there) { return there > 0; }).size(), 4u);
}

TEST_P(SynthKindsOf, LakesAreLevelAtSeveralHeights) {
  const std::vector<double> metres = metresOf(SynthKind::kLakes, GetParam());
  std::set<double> levels;
  for (const auto& [level, area] :
       areasOf(metres, [](double here, double there) { return here > 0 && here == there; })) {
    if (area >= 30) levels.insert(level);
  }
  EXPECT_GE(levels.size(), 4u);
  EXPECT_GT(shareOfSteps(metres, [](double step) { return step == 0; }), 0.1);
}

TEST_P(SynthKindsOf, StepsAreWholeTensOfFeet) {
  const std::vector<double> metres = metresOf(SynthKind::kSteps, GetParam());
  for (const double height : metres)
    ASSERT_EQ(height, static_cast<float>(3.048 * std::round(height / 3.048)));
  EXPECT_GT(shareOfSteps(metres, [](double step) { return step == 0; }), 0.2);
}

TEST_P(SynthKindsOf, VoidsAreABorderAndHoles) {
  const SynthTerrain terrain = synthesize({kSize, GetParam(), SynthKind::kVoids});
  const std::vector<double> metres = metresOf(terrain.heights);
  ASSERT_EQ(terrain.heights.nodata, kVoid);
  const auto voids = std::count(metres.begin(), metres.end(), kVoid);
  EXPECT_GT(voids, kSize * kSize / 20);
  EXPECT_LT(voids, kSize * kSize / 2);
  EXPECT_EQ(metres.front(), kVoid);
  EXPECT_EQ(metres.back(), kVoid);
  EXPECT_GE(areasOf(metres, [](double, double there) { return there == kVoid; }).size(), 6u);
}

TEST_P(SynthKindsOf, PlainsHaveNoiseOfCentimetres) {
  const std::vector<double> metres = metresOf(SynthKind::kPlain, GetParam());
  const auto [lowest, highest] = std::minmax_element(metres.begin(), metres.end());
  EXPECT_LT(*highest - *lowest, 5);
  EXPECT_GT(shareOfSteps(metres, [](double step) { return step > 0.005 && step < 0.1; }), 0.6);
}

TEST_P(SynthKindsOf, CitiesHaveFlatRoofsAndWalls) {
  const SynthTerrain terrain = synthesize({kSize, GetParam(), SynthKind::kCity});
  EXPECT_EQ(terrain.heights.spacing_x, 1);
  const std::vector<double> metres = metresOf(terrain.heights);
  EXPECT_GT(shareOfSteps(metres, [](double step) { return step == 0; }), 0.5);
  EXPECT_GT(shareOfSteps(metres, [](double step) { return step > 2.5; }), 0.05);
  EXPECT_LT(shareOfSteps(metres, [](double step) { return step > 0.35 && step < 2.5; }), 0.02);
}

TEST_P(SynthKindsOf, RescaledHeightsHaveFewValuesAndSomeBetweenThem) {
  const std::vector<double> metres = metresOf(SynthKind::kRescaled, GetParam());
  std::map<double, int> samples;
  for (const double height : metres) ++samples[height];
  int often = 0, rare = 0;
  for (const auto& [height, count] : samples) (count > 4 ? often : rare) += count > 4 ? 1 : count;
  EXPECT_LE(often, 256);
  EXPECT_GT(often, 100);
  EXPECT_GT(rare, kSize * kSize / 1000);
  EXPECT_LT(rare, kSize * kSize / 100);
}

TEST_P(SynthKindsOf, MosaicsAreWholeMetresInPart) {
  size_t whole = 0, others = 0;
  for (const double height : metresOf(SynthKind::kMosaic, GetParam()))
    ++(height == std::floor(height) ? whole : others);
  EXPECT_GT(whole, kSize * kSize / 8);
  EXPECT_GT(others, kSize * kSize / 8);
}

/// Neighbours are often copies of one sample, and rows of copies have no common length.
TEST_P(SynthKindsOf, TurnedHeightsAreCopiesInWholeMetres) {
  const SynthTerrain terrain = synthesize({kSize, GetParam(), SynthKind::kTurned});
  EXPECT_EQ(terrain.heights.scale, 1);
  const std::vector<double> metres = metresOf(terrain.heights);
  const double turned = shareOfSteps(metres, [](double step) { return step == 0; });
  const std::vector<double> mountains = metresOf(SynthKind::kMountains, GetParam());
  const double smooth = shareOfSteps(mountains, [](double step) { return step < 0.05; });
  EXPECT_GT(turned, smooth + 0.2);
}

/// Most samples go on from those to the left of them as these do.
TEST_P(SynthKindsOf, FacetsAreLinearBetweenPoints) {
  const SynthTerrain terrain = synthesize({kSize, GetParam(), SynthKind::kFacets});
  ASSERT_EQ(terrain.heights.sample, TKS_F32);
  const std::vector<double> metres = metresOf(terrain.heights);
  size_t straight = 0, all = 0;
  for (size_t i = 2; i < metres.size(); ++i) {
    if (i % kSize < 2) continue;
    ++all;
    const double bend = metres[i] - 2 * metres[i - 1] + metres[i - 2];
    straight += std::abs(bend) <= 1e-6 * std::abs(metres[i]) + 1e-6;
  }
  EXPECT_GT(straight, 2 * all / 3);
}

/// Differences of differences of samples four apart are a small part of the differences.
TEST_P(SynthKindsOf, SmoothGroundBendsLittle) {
  const auto bends_of = [](const std::vector<double>& metres) {
    double bends = 0, steps = 0;
    for (size_t i = 8; i < metres.size(); ++i) {
      if (i % kSize < 8) continue;
      bends += std::abs(metres[i] - 2 * metres[i - 4] + metres[i - 8]);
      steps += std::abs(metres[i] - metres[i - 4]);
    }
    return bends / steps;
  };
  const double smooth = bends_of(metresOf(SynthKind::kSmooth, GetParam()));
  EXPECT_LT(3 * smooth, bends_of(metresOf(SynthKind::kMountains, GetParam())));
}

}  // namespace
}  // namespace tetrakis::tools
