// SPDX-License-Identifier: Apache-2.0
#include "api/explained.hpp"

#include <cmath>
#include <string>

#include "encoder/plans/plan_words.hpp"

namespace tetrakis::inline api {

namespace {

// The numbers of the C interface are those of the encoder's enumerations.
static_assert(static_cast<int>(Verdict::kWorseInBudget) == TKS_VERDICT_WORSE_IN_BUDGET);
static_assert(static_cast<int>(Residual::Kind::kExact) == TKS_RESIDUAL_EXACT);
static_assert(static_cast<int>(Coding::kWavelet) == TKS_BASE_WAVELET);

/// What a plan says in words, which outlive the struct that refers to them.
struct Words {
  std::string filters, layers;

  explicit Words(const Plan& plan) : filters(filterWords(plan)), layers(layerWords(plan)) {}
};

/// unit: of errors that the encoder has in samples.
tks_weighed_plan toldPlan(const WeighedPlan& weighed, const Words& words, double unit) {
  const Plan& plan = weighed.plan;
  const double step = unit * plan.step;
  tks_weighed_plan told = {};
  told.size = sizeof told;
  told.verdict = static_cast<tks_verdict>(weighed.verdict);
  told.base = static_cast<tks_base>(plan.base);
  told.residual = static_cast<tks_residual>(plan.residual.kind);
  told.step = plan.step;
  told.table_values = plan.table_values;
  told.fractions = plan.fractions ? 1 : 0;
  told.filters = words.filters.c_str();
  told.predictor = predictorWords(plan);
  told.layers = words.layers.c_str();
  told.cut = plan.cut ? *plan.cut * step : -1;
  told.within = plan.residual.within * step;
  told.expected_bytes = weighed.expected.value_or(-1);
  if (!weighed.coded) return told;
  told.coded = 1;
  told.coded_bytes = weighed.coded->bytes;
  told.needed_bytes = weighed.coded->needed;
  told.header_bytes = weighed.coded->in_header;
  told.rmse = weighed.coded->rmse * unit;
  return told;
}

void tell(const ComponentNotes& notes, bool is_texture, double unit,
          const tks_encode_options& options) {
  for (const WeighedPlan& weighed : notes.plans()) {
    const Words words(weighed.plan);
    tks_weighed_plan told = toldPlan(weighed, words, unit);
    told.is_texture = is_texture ? 1 : 0;
    options.explain(options.explain_user, &told);
  }
}

}  // namespace

void explain(const PlanNotes& notes, double scale, const tks_encode_options& options) {
  tell(notes.heights, false, std::abs(scale), options);
  tell(notes.texture, true, 1, options);
}

}  // namespace tetrakis::inline api
