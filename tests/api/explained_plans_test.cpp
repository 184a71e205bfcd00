// SPDX-License-Identifier: Apache-2.0
// What the encoder says of the plans that it weighed: it is true of the stream, and telling it
// changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "conformance/samples/facets.hpp"
#include "conformance/samples/few_values.hpp"
#include "conformance/samples/offset_heights.hpp"
#include "conformance/samples/patches.hpp"
#include "encoder/plans/plan.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// A plan with texts of its own: those of the library end with the call.
struct Told {
  tks_weighed_plan plan;
  std::string filters, predictor, layers;

  uint64_t bytes() const { return plan.needed_bytes + plan.header_bytes; }
};

struct Explained {
  Bytes stream;
  std::vector<Told> heights, texture;

  static void take(void* user, const tks_weighed_plan* plan) {
    auto& self = *static_cast<Explained*>(user);
    EXPECT_EQ(plan->size, sizeof *plan);
    (plan->is_texture != 0 ? self.texture : self.heights)
        .push_back({*plan, plan->filters, plan->predictor, plan->layers});
  }
};

Explained explained(const Raster* heights, const Raster* texture, tks_encode_options options) {
  Explained result;
  options.explain = Explained::take;
  options.explain_user = &result;
  result.stream = encode(heights, texture, options);
  return result;
}

/// The one plan that was taken.
const Told& takenOf(const std::vector<Told>& plans) {
  const auto taken = [](const Told& told) { return told.plan.verdict == TKS_VERDICT_TAKEN; };
  EXPECT_EQ(std::count_if(plans.begin(), plans.end(), taken), 1);
  const auto found = std::find_if(plans.begin(), plans.end(), taken);
  return found != plans.end() ? *found : plans.at(0);
}

/// What holds of the plans of a component whatever the target is. sent: bytes of it in the stream.
void expectTrue(const std::vector<Told>& plans, uint64_t sent) {
  const Told& taken = takenOf(plans);
  EXPECT_NE(taken.plan.coded, 0);
  EXPECT_EQ(taken.plan.needed_bytes, sent);
  for (const auto& [plan, filters, predictor, layers] : plans) {
    EXPECT_EQ(plan.coded != 0, plan.verdict != TKS_VERDICT_EXPECTED_LONGER);
    EXPECT_LE(plan.needed_bytes, plan.coded_bytes);
    EXPECT_TRUE(plan.coded != 0 || plan.expected_bytes >= 0);
    EXPECT_LT(plan.expected_bytes, 1e9);
    EXPECT_EQ(filters.empty(), plan.base != TKS_BASE_WAVELET || plan.coded == 0) << filters;
    EXPECT_EQ(predictor.empty(), plan.residual == TKS_RESIDUAL_NONE) << predictor;
    EXPECT_EQ(plan.within > 0, plan.residual == TKS_RESIDUAL_WITHIN);
    EXPECT_TRUE(plan.cut < 0 || plan.residual != TKS_RESIDUAL_NONE);
  }
}

struct Terrain {
  std::string name;
  Raster heights;
};

std::vector<Terrain> terrains() {
  const Raster ridges = make({Pattern::kRidges, 71, 59, 1, TKS_U8, 3});
  std::vector<Terrain> all = {{"ridges", make({Pattern::kRidges, 71, 59, 1, TKS_I16, 3})},
                              {"floats", make({Pattern::kRidges, 71, 59, 1, TKS_F32, 3})},
                              {"plain", make({Pattern::kFlat, 71, 59, 1, TKS_U8, 1})},
                              {"terraces", make({Pattern::kSteps, 71, 59, 1, TKS_U16, 5})},
                              {"noise", make({Pattern::kNoise, 71, 59, 1, TKS_U16, 5})},
                              {"point", make({Pattern::kRidges, 1, 1, 1, TKS_I16, 1})},
                              {"facets", samples::facets(120, 90, 20.7)},
                              {"patches", samples::patches(120, 90)},
                              {"feet", samples::withFewValues(ridges, samples::FewValues::kFeet)},
                              {"geoid", samples::withOffsets(ridges, samples::OffsetKind::kGeoid)}};
  return all;
}

TEST(ExplainedPlans, AreTrueOfEveryTerrainAndTarget) {
  for (const auto& [name, heights] : terrains()) {
    for (tks_encode_options options : {lossless(), within(1), budget(900), budget(20000)}) {
      SCOPED_TRACE(name + ", " + std::to_string(options.bytes) + " bytes, within " +
                   std::to_string(options.max_error));
      const Explained told = explained(&heights, nullptr, options);
      const Stream stream(told.stream);
      expectTrue(told.heights, stream.info().geometry_bytes);
      const tks_base base = takenOf(told.heights).plan.base;
      EXPECT_EQ(stream.info().heights_drawn, base == TKS_BASE_WAVELET   ? 0
                                             : base == TKS_BASE_DRAWING ? 1
                                                                        : 3);
      EXPECT_TRUE(told.texture.empty());
      EXPECT_EQ(told.stream, encode(&heights, nullptr, options));
    }
  }
}

/// No coded plan takes fewer bytes than the one that was taken, unless its prefixes are worse.
TEST(ExplainedPlans, TheTakenOneOfLosslessHeightsTakesTheFewestBytes) {
  size_t compared = 0;
  for (const auto& [name, heights] : terrains()) {
    SCOPED_TRACE(name);
    const Explained told = explained(&heights, nullptr, lossless());
    const Told& taken = takenOf(told.heights);
    EXPECT_EQ(taken.plan.rmse, 0);
    for (const Told& other : told.heights) {
      if (other.plan.coded == 0 || &other == &taken) continue;
      ++compared;
      if (other.bytes() < taken.bytes()) {
        EXPECT_EQ(other.plan.verdict, TKS_VERDICT_WORSE_PREFIXES);
      } else {
        EXPECT_EQ(other.plan.verdict, TKS_VERDICT_LONGER);
      }
    }
  }
  EXPECT_GT(compared, 4u);
}

TEST(ExplainedPlans, OfTexturesAreTrueBesideHeightsOnAnyThreads) {
  const Raster heights = make({Pattern::kRidges, 97, 81, 1, TKS_I16, 3});
  const Raster map = make({Pattern::kSteps, 96, 80, 3, TKS_U8, 2});
  const Raster noise = make({Pattern::kNoise, 64, 48, 3, TKS_U8, 2});
  const Raster pictures[] = {photograph(), map, noise};
  for (const Raster& picture : pictures) {
    tks_encode_options to_psnr = {};
    to_psnr.size = sizeof to_psnr;
    to_psnr.psnr = 38;
    for (tks_encode_options options : {lossless(), to_psnr, budget(6000)}) {
      const Explained told = explained(&heights, &picture, options);
      const Stream stream(told.stream);
      expectTrue(told.heights, stream.info().geometry_bytes);
      expectTrue(told.texture, stream.info().texture_bytes);
      options.threads = 2;
      const Explained again = explained(&heights, &picture, options);
      EXPECT_EQ(told.stream, again.stream);
      EXPECT_EQ(told.heights.size(), again.heights.size());
      EXPECT_EQ(told.texture.size(), again.texture.size());
      EXPECT_EQ(told.stream, encode(&heights, &picture, options));
    }
  }
}

TEST(ExplainedPlans, ScaleTheErrorsOfHeights) {
  const Raster raster = make({Pattern::kRidges, 97, 81, 1, TKS_I16, 3});
  tks_heights heights = raster.heights();
  heights.scale = -0.5;
  Explained told;
  tks_encode_options options = within(1);
  options.explain = Explained::take;
  options.explain_user = &told;
  encodeHeights(heights, options);
  const Explained unscaled = explained(&raster, nullptr, within(2));
  EXPECT_DOUBLE_EQ(2 * takenOf(told.heights).plan.rmse, takenOf(unscaled.heights).plan.rmse);
}

TEST(ExplainedPlans, NobodyIsToldOfAStreamThatFails) {
  const Raster raster = make({Pattern::kRidges, 97, 81, 1, TKS_I16, 3});
  const tks_heights heights = raster.heights();
  Explained told;
  tks_encode_options options = budget(3);
  options.explain = Explained::take;
  options.explain_user = &told;
  tks_buffer stream = {};
  EXPECT_EQ(tks_encode(&heights, nullptr, &options, &stream, nullptr, 0), TKS_USAGE);
  EXPECT_TRUE(told.heights.empty());
}

/// Later notes know better, but nothing takes back what was taken, nor what only one note knew.
TEST(ComponentNotes, KeepEachPlanOnce) {
  const Plan plan{.step = 2}, other{.step = 3};
  ComponentNotes notes;
  notes.add({plan, Verdict::kExpectedLonger, 70, {}});
  notes.add({other, Verdict::kLonger, {}, CodedOutcome{90, 90, 0, 0}});
  notes.add({plan, Verdict::kLonger, {}, CodedOutcome{80, 80, 0, 0}});
  notes.add({plan, Verdict::kExpectedLonger, 75, {}});
  ASSERT_EQ(notes.plans().size(), 2u);
  EXPECT_EQ(notes.plans()[0].plan, plan);
  EXPECT_EQ(notes.plans()[0].expected, 75);
  EXPECT_EQ(notes.plans()[0].coded->bytes, 80u);
  EXPECT_EQ(notes.plans()[0].verdict, Verdict::kLonger);
  notes.add({plan, Verdict::kTaken, {}, CodedOutcome{80, 60, 0, 0}});
  notes.add({plan, Verdict::kLonger, {}, CodedOutcome{80, 80, 0, 0}});
  EXPECT_EQ(notes.plans()[0].verdict, Verdict::kTaken);
  EXPECT_EQ(notes.plans()[0].coded->needed, 60u);
}

}  // namespace
}  // namespace tetrakis::test
