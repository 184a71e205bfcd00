// SPDX-License-Identifier: Apache-2.0
#include "base/crs_name.hpp"

#include <array>
#include <cctype>
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

}  // namespace tetrakis::inline base
