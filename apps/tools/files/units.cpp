// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

constexpr std::string_view kSuffixes[] = {"m", "cm", "mm", "km", "ft", "us-ft"};

/// Reads a finite number and moves `text` behind it.
std::optional<double> takeNumber(std::string_view& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return value;
}

bool isSuffix(std::string_view text) {
  for (const std::string_view suffix : kSuffixes)
    if (text == suffix) return true;
  return false;
}

}  // namespace

Result<double> parseLength(const std::string& text, const std::string& unit) {
  std::string_view rest = text;
  const std::optional<double> value = takeNumber(rest);
  if (!value || *value < 0 || (!rest.empty() && !isSuffix(rest)))
    return Status(TKS_USAGE, "'" + text + "' is not a length; write for example 0.5, 0.5m or 50cm");
  if (rest.empty()) return *value;
  const std::optional<double> metres = metresPerUnit(unit);
  if (!metres)
    return Status(TKS_USAGE, "'" + text + "' is a length, but the heights are in '" + unit +
                                 "'; leave the suffix out");
  return *value * *metresPerUnit(std::string(rest)) / *metres;
}

Result<uint64_t> parseSize(const std::string& text) {
  const Status unknown(TKS_USAGE, "'" + text +
                                      "' is not a number of bytes; write for example 65536, 64k, "
                                      "1M or 2G");
  uint64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error == std::errc::result_out_of_range)
    return Status(TKS_USAGE, "'" + text + "' is more than 2^64 bytes");
  if (error != std::errc()) return unknown;
  std::string suffix(end, text.data() + text.size());
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::string_view kPowers = "kmg";
  int bits = 0;
  if (const size_t power = suffix.empty() ? kPowers.npos : kPowers.find(suffix[0]);
      power != kPowers.npos) {
    bits = 10 * static_cast<int>(power + 1);
    suffix.erase(0, 1);
    if (suffix == "ib") suffix.erase(0, 1);
  }
  if (!suffix.empty() && suffix != "b") return unknown;
  if (count << bits >> bits != count)
    return Status(TKS_USAGE, "'" + text + "' is more than 2^64 bytes");
  return count << bits;
}

Result<double> parseRate(const std::string& text, const std::string& of) {
  std::string_view rest = text;
  std::optional<double> rate = takeNumber(rest);
  constexpr std::string_view kPowers = "kMG";
  if (const size_t power = rest.empty() ? kPowers.npos : kPowers.find(rest[0]);
      rate && power != kPowers.npos) {
    *rate *= std::pow(1000, static_cast<double>(power) + 1);
    rest.remove_prefix(1);
  }
  if (rest.starts_with(of)) rest.remove_prefix(of.size());
  if (!rate || !(*rate > 0) || !std::isfinite(*rate) || (!rest.empty() && rest != "/s"))
    return Status(TKS_USAGE,
                  "'" + text + "' is no rate; write for example 256k/s or 256k" + of + "/s");
  return *rate;
}

Result<std::array<double, 2>> parseSpacing(const std::string& text) {
  std::string_view rest = text;
  const std::optional<double> x = takeNumber(rest);
  std::optional<double> y = x;
  if (x && rest.starts_with(',')) {
    rest.remove_prefix(1);
    y = takeNumber(rest);
  }
  if (!x || !y || !rest.empty() || *x <= 0 || *y <= 0)
    return Status(
        TKS_USAGE,
        "'" + text + "' is not a spacing; write metres per sample, for example 30 or 30,25");
  return std::array<double, 2>{*x, *y};
}

}  // namespace tetrakis::tools
