// SPDX-License-Identifier: Apache-2.0
#include "encoder/plans/plan_words.hpp"

#include <array>

#include "codec/wavelet/lifting/lifting_filter.hpp"

namespace tetrakis::inline plans {

namespace {

constexpr std::array<const char*, kFilters> kFilterNames = {"short", "six-tap", "quiet", "long",
                                                            "smooth"};

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
