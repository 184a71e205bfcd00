// SPDX-License-Identifier: Apache-2.0
// What PROJ's database says of the units of coordinate reference systems.
#include "apps/tools/files/place/crs_units.hpp"

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/place/proj_objects.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

/// A grid of a building site, say: straight axes that lie nowhere on Earth.
bool isLocalGrid(PJ_CONTEXT* context, const PJ* crs) {
  if (proj_get_type(crs) != PJ_TYPE_ENGINEERING_CRS) return false;
  const ProjObject system(proj_crs_get_coordinate_system(context, crs));
  return system && proj_cs_get_type(context, system.get()) == PJ_CS_TYPE_CARTESIAN;
}

/// Of the axis with this number: metres or radians in one, and its name; nothing if there is none.
std::optional<CrsUnit> axisUnit(PJ_CONTEXT* context, const PJ* crs, int index) {
  const ProjObject system(proj_crs_get_coordinate_system(context, crs));
  CrsUnit unit;
  const char* name = nullptr;
  if (!system || !proj_cs_get_axis_info(context, system.get(), index, nullptr, nullptr, nullptr,
                                        &unit.metres, &name, nullptr, nullptr)) {
    return std::nullopt;
  }
  if (name) unit.name = name;
  return unit;
}

std::optional<CrsUnit> horizontalUnit(PJ_CONTEXT* context, const std::string& crs) {
  const ProjObject part = horizontalPart(context, findCrs(context, crs));
  const bool lengths = part && (proj_get_type(part.get()) == PJ_TYPE_PROJECTED_CRS ||
                                isLocalGrid(context, part.get()));
  return lengths ? axisUnit(context, part.get(), 0) : std::nullopt;
}

/// Of the third axis where a CRS has three.
std::optional<CrsUnit> verticalUnit(PJ_CONTEXT* context, const std::string& crs) {
  if (const ProjObject part = verticalPart(context, findCrs(context, crs)))
    return axisUnit(context, part.get(), 0);
  const ProjObject part = horizontalPart(context, findCrs(context, crs));
  const bool geocentric = part && proj_get_type(part.get()) == PJ_TYPE_GEOCENTRIC_CRS;
  return part && !geocentric ? axisUnit(context, part.get(), 2) : std::nullopt;
}

CrsUnit named(const char* name, double metres) {
  const std::string ours = lengthName(metres);
  if (ours.empty()) return {name ? name : "", metres};
  return {ours, *metresPerUnit(ours)};
}

/// By its EPSG code: metres or radians in one, and its name.
std::optional<CrsUnit> databaseUnit(uint16_t code, std::string_view wanted) {
  const ProjContext context = quietContext();
  const char* name = nullptr;
  const char* category = nullptr;
  double size = 0;
  if (!context ||
      !proj_uom_get_info_from_database(context.get(), "EPSG", std::to_string(code).c_str(), &name,
                                       &size, &category) ||
      category != wanted || !(size > 0)) {
    return std::nullopt;
  }
  return CrsUnit{name ? name : "", size};
}

}  // namespace

std::optional<CrsUnit> crsUnit(const std::string& crs, CrsAxis axis) {
  const ProjContext context = quietContext();
  if (!context) return std::nullopt;
  const auto unit = axis == CrsAxis::kVertical ? verticalUnit(context.get(), crs)
                                               : horizontalUnit(context.get(), crs);
  if (!unit || !(unit->metres > 0) || isDegree(unit->metres)) return std::nullopt;
  return named(unit->name.c_str(), unit->metres);
}

bool isDegree(double size) {
  constexpr double kRadiansPerDegree = std::numbers::pi / 180;
  return std::abs(size - kRadiansPerDegree) < 1e-9 * kRadiansPerDegree;
}

bool isKnownCrs(const std::string& crs) {
  const ProjContext context = quietContext();
  return context && findCrs(context.get(), crs);
}

double degreesPerUnit(const std::string& crs) {
  const ProjContext context = quietContext();
  if (!context) return 0;
  const ProjObject part = horizontalPart(context.get(), findCrs(context.get(), crs));
  if (!part) return 0;
  const PJ_TYPE type = proj_get_type(part.get());
  if (type != PJ_TYPE_GEOGRAPHIC_2D_CRS && type != PJ_TYPE_GEOGRAPHIC_3D_CRS) return 0;
  const auto unit = axisUnit(context.get(), part.get(), 0);
  return unit ? degreesIn(unit->metres) : 0;
}

double degreesIn(double radians) {
  if (isDegree(radians)) return 1;
  return std::isfinite(radians) && radians > 0 ? radians * 180 / std::numbers::pi : 0;
}

double epsgAngle(uint16_t code) {
  constexpr uint16_t kDegreeCode = 9102;
  if (code == kDegreeCode) return 1;
  const auto unit = databaseUnit(code, "angular");
  return unit ? degreesIn(unit->metres) : 0;
}

std::optional<CrsUnit> epsgUnit(uint16_t code) {
  for (const LengthUnit& known : kLengthUnits) {
    if (known.code == code) return CrsUnit{known.name, known.metres};
  }
  const auto unit = databaseUnit(code, "linear");
  return unit ? std::optional(named(unit->name.c_str(), unit->metres)) : std::nullopt;
}

}  // namespace tetrakis::tools
