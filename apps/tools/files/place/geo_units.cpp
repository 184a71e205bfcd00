// SPDX-License-Identifier: Apache-2.0
// In which units the grid and the heights of a GeoTIFF are (OGC GeoTIFF 1.1, 19-008r4, 7.5
// and 7.6).
#include "apps/tools/files/place/geo_units.hpp"

#include <cmath>

#include "apps/tools/files/place/crs_units.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

/// "Units = us_survey_feet" and "LUnits = ..." in ERDAS's and Esri's citations, "(ftUS)" in EPSG's
/// names, for CRSs that PROJ does not know.
std::optional<double> unitNamedIn(const std::string& citation) {
  constexpr std::string_view kUnits = "Units = ";
  if (const size_t at = citation.find(kUnits); at != citation.npos) {
    const std::string rest = citation.substr(at + kUnits.size());
    return metresPerUnit(canonicalUnit(rest.substr(0, rest.find_first_of("|\n\r"))));
  }
  const std::string grid = citation.substr(0, citation.find(" + "));  // before the heights' CRS
  if (grid.find("(ftUS)") != grid.npos) return metresPerUnit("us-ft");
  if (grid.find("(ft)") != grid.npos) return metresPerUnit("ft");
  return std::nullopt;
}

std::optional<double> gridUnitOfCrs(const GeoKeys& keys) {
  const std::string code = keys.epsg(kProjectedCrsGeoKey);
  if (!code.empty()) {
    if (const auto unit = crsUnit(code, CrsAxis::kHorizontal)) return unit->metres;
  }
  for (const GeoKey key : {kProjectedCitationGeoKey, kGtCitationGeoKey}) {
    const std::string citation = keys.text(key);
    if (citation.empty()) continue;
    if (const auto unit = crsUnit(citation, CrsAxis::kHorizontal)) return unit->metres;
    if (const auto metres = unitNamedIn(citation)) return metres;
  }
  return std::nullopt;
}

bool namesGridUnit(const GeoKeys& keys) {
  const uint16_t code = keys.code(kProjLinearUnitsGeoKey);
  return code != 0 && code != kUserDefined;
}

}  // namespace

std::optional<double> statedGridUnit(const GeoKeys& keys) {
  if (namesGridUnit(keys)) {
    const auto unit = epsgUnit(keys.code(kProjLinearUnitsGeoKey));
    return unit ? std::optional(unit->metres) : std::nullopt;
  }
  const double size = keys.number(kProjLinearUnitSizeGeoKey);
  return std::isfinite(size) && size > 0 && !isDegree(size) ? std::optional(size) : std::nullopt;
}

std::optional<double> gridUnit(const GeoKeys& keys) {
  const auto stated = statedGridUnit(keys);
  return stated || namesGridUnit(keys) ? stated : gridUnitOfCrs(keys);
}

double angleUnit(const GeoKeys& keys) {
  const uint16_t code = keys.code(kGeogAngularUnitsGeoKey);
  const std::string crs = keys.epsg(kGeodeticCrsGeoKey);
  const double of_crs = code == 0 && !crs.empty() ? degreesPerUnit(crs) : 0;
  if (code == 0) return of_crs > 0 ? of_crs : 1;
  return code == kUserDefined ? degreesIn(keys.number(kGeogAngularUnitSizeGeoKey))
                              : epsgAngle(code);
}

Ellipsoid statedEllipsoid(const GeoKeys& keys) {
  const double major = keys.number(kGeogSemiMajorAxisGeoKey);
  const double minor = keys.number(kGeogSemiMinorAxisGeoKey);
  const double inverse_flattening = keys.number(kGeogInvFlatteningGeoKey);
  if (!(major > 0)) return {};
  if (inverse_flattening > 0) return {major, 1 / inverse_flattening};
  return {major, minor > 0 ? 1 - minor / major : 0};
}

std::string wktIn(const GeoKeys& keys) {
  constexpr std::string_view kEsri = "ESRI PE String = ";
  const uint16_t model = keys.code(kGtModelTypeGeoKey);
  const std::string text = keys.text(kProjectedCitationGeoKey);
  if (model == kModelTypeProjected || model == kModelTypeGeographic || !text.starts_with(kEsri))
    return "";
  return text.substr(kEsri.size());
}

bool statesHeights(const GeoKeys& keys) {
  return keys.code(kVerticalGeoKey) != 0 || keys.code(kVerticalUnitsGeoKey) != 0;
}

std::optional<std::string> heightUnit(const GeoKeys& keys) {
  const uint16_t code = keys.code(kVerticalUnitsGeoKey);
  if (code != 0 && code != kUserDefined) {
    const auto unit = epsgUnit(code);
    return unit ? std::optional(unit->name) : std::nullopt;
  }
  const std::string datum = keys.epsg(kVerticalGeoKey);
  for (const std::string& crs :
       {datum, keys.text(kVerticalCitationGeoKey), keys.text(kGtCitationGeoKey)}) {
    if (crs.empty()) continue;
    if (const auto unit = crsUnit(crs, CrsAxis::kVertical)) return unit->name;
  }
  return std::nullopt;
}

}  // namespace tetrakis::tools
