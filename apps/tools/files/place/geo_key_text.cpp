// SPDX-License-Identifier: Apache-2.0
// GeoTIFF keys as text (docs/FORMAT.md, section 2), which streams carry.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "apps/tools/files/place/geo_keys.hpp"
#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {
namespace {

/// Before keys whose vertical part is none to GDAL.
constexpr std::string_view kRevision10 = "1.0";

/// Always told from a code.
std::string numberText(double number) {
  std::string text = shortest(number);
  if (text.find_first_of(".en") == text.npos) text += ".0";
  return text;
}

std::string quotedText(const std::string& text) {
  std::string out(1, '"');
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

/// Takes the text apart from its front.
class Scanner {
 public:
  explicit Scanner(std::string_view rest) : rest_(rest) {}

  bool ended() const { return rest_.empty(); }
  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  template <class T>
  std::optional<T> number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
  }
  /// Up to one of these, or to the end.
  std::string_view until(std::string_view ends) {
    const std::string_view word = rest_.substr(0, rest_.find_first_of(ends));
    rest_.remove_prefix(word.size());
    return word;
  }
  /// Behind the opening quote.
  std::optional<std::string> text() {
    std::string out;
    while (true) {
      out += until("\"");
      if (!take('"')) return std::nullopt;
      if (!take('"')) return out;
      out += '"';
    }
  }

 private:
  std::string_view rest_;
};

bool takeValue(Scanner& in, uint16_t id, GeoKeys& keys) {
  if (in.take('"')) {
    const auto text = in.text();
    if (text) keys.texts[id] = *text;
    return text && text->find('\0') == text->npos;
  }
  const std::string_view word = in.until(", ");
  if (const auto code = in.number<uint16_t>(word)) {
    keys.codes[id] = *code;
    return true;
  }
  for (std::string_view next = word; next.find_first_of(".e") != next.npos; next = in.until(", ")) {
    const auto number = in.number<double>(next);
    if (!number || !std::isfinite(*number)) return false;
    keys.numbers[id].push_back(*number);
    if (!in.take(',')) return true;
  }
  return false;
}

}  // namespace

std::string textOf(const GeoKeys& keys) {
  std::map<uint16_t, std::string> values;
  for (const auto& [id, code] : keys.codes) values[id] = std::to_string(code);
  for (const auto& [id, text] : keys.texts) values[id] = quotedText(text);
  for (const auto& [id, numbers] : keys.numbers) {
    std::string& list = values[id];
    for (const double number : numbers) {
      if (!list.empty()) list += ',';
      list += numberText(number);
    }
  }
  std::string out(keys.minor_revision == 0 ? kRevision10 : "");
  for (const auto& [id, value] : values) {
    if (!out.empty()) out += ' ';
    out += std::to_string(id) + '=' + value;
  }
  return out;
}

std::optional<GeoKeys> parseGeoKeys(std::string_view text) {
  GeoKeys keys;
  Scanner in(text);
  if (in.until(" =") == kRevision10 && in.take(' ')) {
    keys.minor_revision = 0;
  } else {
    in = Scanner(text);
  }
  for (int last = 0; !in.ended();) {
    const auto id = in.number<uint16_t>(in.until("= "));
    if (!id || *id <= last || !in.take('=') || !takeValue(in, *id, keys)) return std::nullopt;
    last = *id;
    if (!in.take(' ') && !in.ended()) return std::nullopt;
  }
  return keys;
}

}  // namespace tetrakis::tools
