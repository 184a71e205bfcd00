// SPDX-License-Identifier: Apache-2.0
// What PROJ's database says of the units of coordinate reference systems.
#include "tools/files/place/crs_units.hpp"

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/length_unit.hpp"
#include "tools/files/pictures/tiff.hpp"
#include "tools/files/place/proj_objects.hpp"

namespace tetrakis::tools {
namespace {

/// A grid of a building site, say: straight axes that lie nowhere on Earth.
bool isLocalGrid(PJ_CONTEXT* context, const PJ* crs) {
  if (proj_get_type(crs) != PJ_TYPE_ENGINEERING_CRS) return false;
  const ProjObject system(proj_crs_get_coordinate_system(context, crs));
  return system && proj_cs_get_type(context, system.get()) == PJ_CS_TYPE_CARTESIAN;
}

ProjObject partWith(PJ_CONTEXT* context, ProjObject crs, CrsAxis axis) {
  if (axis == CrsAxis::kVertical) return verticalPart(context, std::move(crs));
  crs = horizontalPart(context, std::move(crs));
  if (crs && proj_get_type(crs.get()) != PJ_TYPE_PROJECTED_CRS && !isLocalGrid(context, crs.get()))
    crs.reset();
  return crs;
}

/// Of its first axis: metres or radians in one, and its name; nothing if there is none.
std::optional<CrsUnit> axisUnit(PJ_CONTEXT* context, const PJ* crs) {
  const ProjObject system(proj_crs_get_coordinate_system(context, crs));
  CrsUnit unit;
  const char* name = nullptr;
  if (!system || !proj_cs_get_axis_info(context, system.get(), 0, nullptr, nullptr, nullptr,
                                        &unit.metres, &name, nullptr, nullptr)) {
    return std::nullopt;
  }
  if (name) unit.name = name;
  return unit;
}

CrsUnit named(const char* name, double metres) {
  const std::string ours = lengthName(metres);
  if (ours.empty()) return {name ? name : "", metres};
  return {ours, *metresPerUnit(ours)};
}

}  // namespace

std::optional<CrsUnit> crsUnit(const std::string& crs, CrsAxis axis) {
  const ProjContext context = quietContext();
  if (!context) return std::nullopt;
  const ProjObject part = partWith(context.get(), findCrs(context.get(), crs), axis);
  if (!part) return std::nullopt;
  const auto unit = axisUnit(context.get(), part.get());
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

bool isInDegrees(const std::string& crs) {
  const ProjContext context = quietContext();
  if (!context) return false;
  const ProjObject part = horizontalPart(context.get(), findCrs(context.get(), crs));
  if (!part) return false;
  const PJ_TYPE type = proj_get_type(part.get());
  if (type != PJ_TYPE_GEOGRAPHIC_2D_CRS && type != PJ_TYPE_GEOGRAPHIC_3D_CRS) return false;
  const auto unit = axisUnit(context.get(), part.get());
  return unit && isDegree(unit->metres);
}

std::optional<CrsUnit> epsgUnit(uint16_t code) {
  for (const LengthUnit& known : kLengthUnits) {
    if (known.code == code) return CrsUnit{known.name, known.metres};
  }
  const ProjContext context = quietContext();
  const char* name = nullptr;
  const char* category = nullptr;
  double metres = 0;
  if (!context ||
      !proj_uom_get_info_from_database(context.get(), "EPSG", std::to_string(code).c_str(), &name,
                                       &metres, &category)) {
    return std::nullopt;
  }
  return category == std::string_view("linear") && metres > 0 ? std::optional(named(name, metres))
                                                              : std::nullopt;
}

}  // namespace tetrakis::tools
