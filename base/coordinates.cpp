// SPDX-License-Identifier: Apache-2.0
#include "base/coordinates.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace tetrakis::inline base {

namespace {

bool isAnyOf(const auto& codes, int code) {
  for (const int each : codes)
    if (each == code) return true;
  return false;
}

bool isMercator(const std::string& crs) {
  for (const char* name : {"Pseudo-Mercator", "Pseudo Mercator", "Auxiliary_Sphere"})
    if (crs.find(name) != crs.npos) return true;
  return false;
}

/// Whether the text is a code of this authority, in upper or lower case: "EPSG".
bool isOf(const char* authority, const std::string& crs) {
  size_t i = 0;
  for (; authority[i] != 0; ++i)
    if (i >= crs.size() || std::toupper(static_cast<unsigned char>(crs[i])) != authority[i])
      return false;
  return i < crs.size() && crs[i] == ':';
}

}  // namespace

bool knownToBrowsers(const std::string& crs) {
  constexpr std::array kMercator = {3857, 3785, 900913, 102100, 102113};
  constexpr std::array kDegrees = {4326, 4269, 4258, 4979};
  if (isMercator(crs)) return true;
  const bool epsg = isOf("EPSG", crs);
  if (!epsg && !isOf("ESRI", crs)) return false;
  const int code = std::atoi(crs.c_str() + 5);  // behind the authority and its colon
  if (isAnyOf(kMercator, code)) return true;
  const auto isWithin = [code](int first, int last) { return code >= first && code <= last; };
  return epsg && (isAnyOf(kDegrees, code) || isWithin(32601, 32660) || isWithin(32701, 32760) ||
                  isWithin(26901, 26923) || isWithin(25828, 25838));
}

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

bool liesOn(const PlacedRaster& ground, const PlacedRaster& raster) {
  const double *const g = ground.geotransform, *const t = raster.geotransform;
  const double area = g[1] * g[5] - g[2] * g[4];
  const auto isInside = [&](double column, double row) {
    const double x = t[0] + column * t[1] + row * t[2] - g[0];
    const double y = t[3] + column * t[4] + row * t[5] - g[3];
    const double across = (g[5] * x - g[2] * y) / area, down = (g[1] * y - g[4] * x) / area;
    return across >= -1 && down >= -1 && across <= ground.width + 1.0 &&
           down <= ground.height + 1.0;
  };
  return isInside(0, 0) && isInside(raster.width, 0) && isInside(0, raster.height) &&
         isInside(raster.width, raster.height);
}

ColumnsRound columnsRound(const PlacedRaster& raster, double degrees) {
  /// Of a column: files write the width of one with some seven digits or more. A larger number
  /// glues sides with a gap in between.
  constexpr double kTolerance = 0.01;
  if (raster.geotransform == nullptr) return ColumnsRound::kNo;
  const double* const transform = raster.geotransform;
  const double column = transform[1] * degrees;
  if (column == 0 || transform[2] != 0 || transform[4] != 0) return ColumnsRound::kNo;
  const double more = raster.width - std::abs(360 / column);
  if (std::abs(more) < kTolerance) return ColumnsRound::kOnce;
  return std::abs(more - 1) < kTolerance ? ColumnsRound::kRepeating : ColumnsRound::kNo;
}

std::array<double, 2> edgeLatitudes(const PlacedRaster& raster, double degrees) {
  /// Edges of samples at a pole lie behind it. What is farther off is no latitude.
  constexpr double kFarthest = 180;
  if (raster.geotransform == nullptr) return {};
  const double* const transform = raster.geotransform;
  const double first = transform[3] * degrees;
  const double last = first + raster.height * transform[5] * degrees;
  const bool placed = std::abs(first) <= kFarthest && std::abs(last) <= kFarthest;
  if (transform[2] != 0 || transform[4] != 0 || !placed) return {};
  return {first, last};
}

double fineness(const PlacedRaster& ground, const PlacedRaster& raster) {
  const double *const g = ground.geotransform, *const t = raster.geotransform;
  if (t == nullptr)
    return std::max(
        {1.0, double(raster.width) / ground.width, double(raster.height) / ground.height});
  return std::max({1.0, std::hypot(g[1], g[4]) / std::hypot(t[1], t[4]),
                   std::hypot(g[2], g[5]) / std::hypot(t[2], t[5])});
}

}  // namespace tetrakis::inline base
