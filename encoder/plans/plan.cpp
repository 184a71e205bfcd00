// SPDX-License-Identifier: Apache-2.0
#include "encoder/plans/plan.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "codec/wavelet/lifting/lifting_kernel.hpp"

namespace tetrakis::inline plans {

void ComponentNotes::add(WeighedPlan weighed) {
  const auto known = std::find_if(plans_.begin(), plans_.end(), [&](const WeighedPlan& noted) {
    return noted.plan == weighed.plan;
  });
  if (known == plans_.end()) {
    plans_.push_back(std::move(weighed));
    return;
  }
  if (weighed.expected) known->expected = weighed.expected;
  if (known->verdict == Verdict::kTaken) return;
  if (weighed.coded) known->coded = weighed.coded;
  if (weighed.coded || !known->coded) known->verdict = weighed.verdict;
}

namespace {

constexpr std::array<const char*, kFilters> kFilterNames = {"short", "six-tap", "quiet",
                                                            "long",  "smooth",  "orthogonal"};

const char* nameOf(Layer layer) {
  switch (layer) {
    case Layer::kMask:
      return "mask";
    case Layer::kLateMask:
      return "late mask";
    case Layer::kBridges:
      return "bridges";
    case Layer::kFlatAreas:
      return "flat areas";
    case Layer::kCutOut:
      return "cut-out";
    case Layer::kOverlay:
      return "overlay";
    case Layer::kPriorities:
      return "priorities";
    case Layer::kRegions:
      return "regions";
  }
  return "";
}

/// Appends a word to words that commas separate.
void append(std::string& words, const char* word) {
  if (!words.empty()) words += ", ";
  words += word;
}

}  // namespace

std::string filterWords(const Plan& plan) {
  std::string words;
  if (!plan.filters) return words;
  for (const uint8_t filter : *plan.filters) append(words, kFilterNames.at(filter));
  return words;
}

std::string layerWords(const Plan& plan) {
  std::string words;
  for (const Layer layer : plan.layers) append(words, nameOf(layer));
  return words;
}

const char* predictorWords(const Plan& plan) {
  switch (plan.residual.predictor) {
    case Predictor::kNone:
      return "";
    case Predictor::kDecoded:
      return "base";
    case Predictor::kNeighbours:
      return "neighbours";
    case Predictor::kRelative:
      return "relative steps";
    case Predictor::kFacets:
      return "facets";
  }
  return "";
}

}  // namespace tetrakis::inline plans
