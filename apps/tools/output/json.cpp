// SPDX-License-Identifier: Apache-2.0
// Results on standard output: JSON for programs, the same as a table for people.
#include "apps/tools/output/json.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "base/shown_text.hpp"

namespace tetrakis::tools {
namespace {

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string dumpValue(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string shown(const Json& value) {
  if (value.is_null()) return "-";
  if (!value.is_string()) return dumpValue(value, -1);
  return shownText(value.get<std::string>());
}

void flatten(const std::string& key, const Json& value, Rows& rows) {
  if (!value.is_structured()) {
    rows.emplace_back(key, shown(value));
    return;
  }
  for (const auto& item : value.items())
    flatten(key.empty() ? item.key() : key + "." + item.key(), item.value(), rows);
}

}  // namespace

Json textOrNull(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json finiteOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json legible(Json json) {
  if (json.is_structured())
    for (Json& value : json) value = legible(value);
  if (!json.is_number_float()) return json;
  const double value = json.get<double>();
  const int before = value == 0 ? 1 : 1 + static_cast<int>(std::log10(std::abs(value)));
  char text[400];
  std::snprintf(text, sizeof text, "%.*g", std::max(6, before), value);
  return std::strtod(text, nullptr);
}

std::string dump(const Json& json) {
  return dumpValue(json, 2) + "\n";
}

std::string table(const Json& json) {
  Rows rows;
  flatten("", json, rows);
  size_t width = 0;
  for (const auto& [key, value] : rows) width = std::max(width, key.size());
  std::string text;
  for (const auto& [key, value] : rows)
    text += key + std::string(width - key.size() + 2, ' ') + value + "\n";
  return text;
}

Status print(const std::string& given) {
  const std::string text = shownLines(given);
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
    return Status();
  return Status(TKS_IO, std::string("cannot write standard output: ") + std::strerror(errno));
}

}  // namespace tetrakis::tools
