// SPDX-License-Identifier: Apache-2.0
#include "base/length_unit.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tetrakis::inline base {

namespace {

struct NamedLength {
  std::string_view name;
  double metres;
};

constexpr NamedLength kLengths[] = {{"m", 1},     {"cm", 0.01},   {"mm", 0.001},
                                    {"km", 1000}, {"ft", 0.3048}, {"us-ft", 1200.0 / 3937}};

struct OtherName {
  std::string_view name, ours;
};

/// Lower case, words apart by blanks.
constexpr OtherName kOtherNames[] = {{"metre", "m"},
                                     {"meter", "m"},
                                     {"metres", "m"},
                                     {"meters", "m"},
                                     {"centimetre", "cm"},
                                     {"millimetre", "mm"},
                                     {"kilometre", "km"},
                                     {"foot", "ft"},
                                     {"feet", "ft"},
                                     {"international foot", "ft"},
                                     {"international feet", "ft"},
                                     {"us-ft", "us-ft"},
                                     {"ftus", "us-ft"},
                                     {"foot us", "us-ft"},
                                     {"us survey foot", "us-ft"},
                                     {"us survey feet", "us-ft"}};

}  // namespace

std::string canonicalUnit(std::string_view unit) {
  std::string plain(unit);
  std::transform(plain.begin(), plain.end(), plain.begin(), [](unsigned char c) {
    return c == '_' ? ' ' : static_cast<char>(std::tolower(c));
  });
  for (const OtherName& other : kOtherNames)
    if (plain == other.name) return std::string(other.ours);
  for (const NamedLength& length : kLengths)
    if (plain == length.name) return plain;
  return std::string(unit);
}

std::optional<double> metresPerUnit(std::string_view unit) {
  if (unit.empty()) return 1;
  const std::string ours = canonicalUnit(unit);
  for (const NamedLength& length : kLengths)
    if (ours == length.name) return length.metres;
  return std::nullopt;
}

std::string lengthName(double metres) {
  constexpr double kRelative = 1e-9;  // feet and survey feet differ by 2e-6
  for (const NamedLength& length : kLengths)
    if (std::abs(metres - length.metres) <= kRelative * length.metres)
      return std::string(length.name);
  return "";
}

}  // namespace tetrakis::inline base
