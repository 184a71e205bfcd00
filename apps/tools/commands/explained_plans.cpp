// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/explained_plans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace tetrakis::tools {
namespace {

constexpr std::array<const char*, 3> kBases = {"stored", "drawing", "wavelet"};
constexpr std::array<const char*, 3> kResiduals = {"none", "within", "exact"};
constexpr std::array<const char*, 7> kVerdicts = {
    "taken",   "expected longer", "longer",         "misses the target",
    "no room", "worse prefixes",  "worse in budget"};

template <size_t n>
const char* nameOf(const std::array<const char*, n>& names, int number) {
  return names.at(static_cast<size_t>(number));
}

/// The words of a list that commas separate.
Json wordsOf(std::string_view list) {
  Json words = Json::array();
  while (!list.empty()) {
    const size_t end = std::min(list.find(", "), list.size());
    words.push_back(std::string(list.substr(0, end)));
    list.remove_prefix(std::min(end + 2, list.size()));
  }
  return words;
}

Json ifPositive(double value) {
  return value > 0 ? Json(value) : Json();
}

Json codedJson(const tks_weighed_plan& plan) {
  if (plan.coded == 0) return {};
  return {{"bytes", plan.coded_bytes},
          {"needed_bytes", plan.needed_bytes},
          {"header_bytes", plan.header_bytes},
          {"rmse", plan.rmse}};
}

Json planJson(const tks_weighed_plan& plan) {
  return {{"verdict", nameOf(kVerdicts, plan.verdict)},
          {"base", nameOf(kBases, plan.base)},
          {"step", ifPositive(plan.step)},
          {"table_values", plan.table_values > 0 ? Json(plan.table_values) : Json()},
          {"filters", wordsOf(plan.filters)},
          {"fractions", plan.fractions != 0},
          {"cut", plan.cut < 0 ? Json() : Json(plan.cut)},
          {"residual", nameOf(kResiduals, plan.residual)},
          {"within", ifPositive(plan.within)},
          {"predictor", textOrNull(plan.predictor)},
          {"layers", wordsOf(plan.layers)},
          {"expected_bytes", plan.expected_bytes < 0
                                 ? Json()
                                 : Json(static_cast<uint64_t>(std::llround(plan.expected_bytes)))},
          {"coded", codedJson(plan)}};
}

std::string shown(const Json& value) {
  return value.is_null() ? "-" : legible(value).dump();
}

std::string joined(const Json& words, const char* between) {
  std::string text;
  for (const Json& word : words) text += (text.empty() ? "" : between) + word.get<std::string>();
  return text;
}

/// A plan in words: "wavelet long/six-tap/six-tap, step 1, cut at 0.31, exact by neighbours".
std::string sentence(const Json& plan) {
  std::string text = plan["base"].get<std::string>();
  if (!plan["filters"].empty()) text += " " + joined(plan["filters"], "/");
  if (plan["fractions"].get<bool>()) text += " with fractions";
  if (!plan["step"].is_null()) text += ", step " + shown(plan["step"]);
  if (!plan["table_values"].is_null())
    text += ", table of " + shown(plan["table_values"]) + " values";
  if (!plan["cut"].is_null()) text += ", cut at " + shown(plan["cut"]);
  const auto residual = plan["residual"].get<std::string>();
  if (residual == "within") text += ", within " + shown(plan["within"]);
  if (residual == "exact") text += ", exact";
  if (!plan["predictor"].is_null()) text += " by " + plan["predictor"].get<std::string>();
  if (!plan["layers"].empty()) text += "; " + joined(plan["layers"], ", ");
  return text;
}

constexpr size_t kNumbers = 4;
using Row = std::array<std::string, kNumbers + 2>;

Row rowOf(const Json& plan) {
  const auto outcome = [&](const char* key) {
    const Json& coded = plan["coded"];
    return shown(coded.is_null() ? coded : coded[key]);
  };
  return {shown(plan["expected_bytes"]),
          outcome("bytes"),
          outcome("needed_bytes"),
          outcome("rmse"),
          plan["verdict"].get<std::string>(),
          sentence(plan)};
}

/// Lines of which numbers end below each other, and words begin so.
std::string aligned(const std::vector<Row>& rows) {
  std::array<size_t, kNumbers + 2> widths{};
  for (const Row& row : rows)
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const Row& row : rows) {
    for (size_t i = 0; i + 1 < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      text += i < kNumbers ? "  " + space + row[i] : "  " + row[i] + space;
    }
    text += "  " + row.back() + "\n";
  }
  return text;
}

}  // namespace

void ExplainedPlans::askFor(tks_encode_options& options) {
  options.explain = &ExplainedPlans::take;
  options.explain_user = this;
}

void ExplainedPlans::take(void* self, const tks_weighed_plan* plan) {
  Json& list =
      static_cast<ExplainedPlans*>(self)->json_[plan->is_texture != 0 ? "texture" : "heights"];
  list.push_back(planJson(*plan));
}

std::string ExplainedPlans::table() const {
  std::string text;
  for (const auto& component : json_.items()) {
    if (component.value().is_null()) continue;
    std::vector<Row> rows = {{"expected", "coded", "needed", "rmse", "verdict", "plan"}};
    for (const Json& plan : component.value()) rows.push_back(rowOf(plan));
    text += component.key() + "\n" + aligned(rows);
  }
  return text;
}

}  // namespace tetrakis::tools
