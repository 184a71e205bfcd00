// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/crs.hpp"

#include <cmath>
#include <numbers>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include "base/coordinates.hpp"

#include "base/shown_text.hpp"

namespace tetrakis::gdal {
namespace {

/// While one of these lives, GDAL's errors are neither printed nor kept.
class Quiet {
 public:
  Quiet() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~Quiet() { CPLPopErrorHandler(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  CPLErrorStateBackuper backup_;
};

/// Texts come from files: they must open no other file and no address.
SpatialReference parse(const std::string& text) {
  const Quiet quiet;
  const char* const options[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  SpatialReference system(new OGRSpatialReference);
  if (system->SetFromUserInput(text.c_str(), options) != OGRERR_NONE) return nullptr;
  system->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

/// The code of a part of the system (null: of all of it), as a text; "" if it has none.
std::string epsgOf(const OGRSpatialReference& system, const char* part) {
  const char* const authority = system.GetAuthorityName(part);
  const char* const code = system.GetAuthorityCode(part);
  if (authority == nullptr || code == nullptr || !EQUAL(authority, "EPSG")) return "";
  return std::string("EPSG:") + code;
}

bool says(const SpatialReference& candidate, const OGRSpatialReference& system) {
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                 "IGNORE_COORDINATE_EPOCH=YES", "CRITERION=EQUIVALENT", nullptr};
  return candidate && candidate->IsSame(&system, options);
}

std::string wktOf(const OGRSpatialReference& system) {
  const char* const options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  char* text = nullptr;
  const bool written = system.exportToWkt(&text, options) == OGRERR_NONE;
  std::string out = written ? asUtf8(text) : "";
  CPLFree(text);
  return out;
}

/// One over the other; the horizontal one alone where the two make no pair.
SpatialReference compound(SpatialReference horizontal, const std::string& vertical_datum) {
  const bool text =
      vertical_datum.starts_with("EPSG:") || vertical_datum.find('[') != std::string::npos;
  if (!text || horizontal->IsCompound() || horizontal->IsVertical()) return horizontal;
  const SpatialReference vertical = parse(vertical_datum);
  // Longitude, latitude and height
  if (vertical && vertical->IsGeographic() && vertical->GetAxesCount() == 3) {
    horizontal->PromoteTo3D(nullptr);
    return horizontal;
  }
  if (!vertical || !vertical->IsVertical()) return horizontal;
  const std::string name =
      std::string(horizontal->GetName()) + " + " + std::string(vertical->GetName());
  SpatialReference both(new OGRSpatialReference);
  const Quiet quiet;
  if (both->SetCompoundCS(name.c_str(), horizontal.get(), vertical.get()) != OGRERR_NONE)
    return horizontal;
  both->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return both;
}

}  // namespace

std::string asUtf8(const char* text) {
  if (CPLIsUTF8(text, -1) != FALSE) return text;
  char* const recoded = CPLRecode(text, CPL_ENC_ISO8859_1, CPL_ENC_UTF8);
  std::string out = recoded;
  CPLFree(recoded);
  return out;
}

CrsTexts crsTexts(const OGRSpatialReference& system) {
  const Quiet quiet;
  if (const std::string code = epsgOf(system, nullptr); !code.empty() && says(parse(code), system))
    return {code, "", ""};
  if (!system.IsCompound()) return {wktOf(system), "", ""};
  OGRSpatialReference horizontal(system);
  horizontal.StripVertical();
  const std::string over = epsgOf(horizontal, nullptr), up = epsgOf(system, "COMPD_CS|VERT_CS");
  const bool codes = !over.empty() && !up.empty() && says(parse(over + "+" + up.substr(5)), system);
  if (codes) return {over, up, ""};
  return {wktOf(system), "", ""};
}

double degreesOf(const OGRSpatialReference* system) {
  constexpr double kDegree = std::numbers::pi / 180, kAlike = 1e-9;
  if (system == nullptr || !system->IsGeographic()) return 0;
  const double degrees = system->GetAngularUnits() / kDegree;
  return std::abs(degrees - 1) < kAlike ? 1 : degrees;
}

std::string heightUnitOf(const OGRSpatialReference& system) {
  const Quiet quiet;
  if (system.IsCompound() || system.IsVertical()) {
    const char* name = nullptr;
    const double metres = system.GetTargetLinearUnits("VERT_CS", &name);
    const std::string ours = lengthName(metres);
    return ours.empty() && name != nullptr ? name : ours;
  }
  double metres = 0;
  const bool spatial = system.GetAxesCount() == 3 && !system.IsGeocentric() &&
                       system.GetAxis(nullptr, 2, nullptr, &metres) != nullptr;
  return spatial ? lengthName(metres) : "";
}

SpatialReference readCrs(const CrsTexts& texts, const std::string& file_name) {
  if (!texts.geo_keys.empty()) {
    const Quiet quiet;
    if (SpatialReference system = readGeoKeys(texts.geo_keys)) return system;
  }
  if (texts.crs.empty()) return nullptr;
  SpatialReference system = parse(texts.crs);
  if (system) return compound(std::move(system), texts.vertical_datum);
  CPLError(CE_Warning, CPLE_AppDefined,
           "%s: The reference system \"%.200s\" is none that PROJ knows; the raster is opened "
           "without one.",
           shownText(file_name).c_str(), shownText(texts.crs).c_str());
  return nullptr;
}

}  // namespace tetrakis::gdal
