// SPDX-License-Identifier: Apache-2.0
// What PROJ's database says of the units of coordinate reference systems.
#include "tools/files/crs_units.hpp"

#include <proj.h>

#include <memory>
#include <string_view>

#include "tools/files/tiff.hpp"
#include "tools/files/units.hpp"

namespace tetrakis::tools {
namespace {

struct Release {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
};
using Context = std::unique_ptr<PJ_CONTEXT, Release>;
using Object = std::unique_ptr<PJ, Release>;

/// One that prints nothing.
Context quietContext() {
  Context context(proj_context_create());
  if (context) proj_log_func(context.get(), nullptr, [](void*, int, const char*) {});
  return context;
}

/// PROJ also takes names that are only similar; those say nothing about a unit.
Object findCrs(PJ_CONTEXT* context, std::string text) {
  constexpr std::string_view kEsri = "ESRI PE String = ";
  if (text.starts_with(kEsri)) text.erase(0, kEsri.size());
  Object crs(proj_create(context, text.c_str()));
  const bool exact = text.starts_with("EPSG:") || text.find('[') != text.npos;
  if (crs && !exact && text != proj_get_name(crs.get())) crs.reset();
  return crs;
}

/// The part of a compound or bound CRS that has this axis, or null.
Object partWith(PJ_CONTEXT* context, Object crs, CrsAxis axis) {
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS) {
    crs.reset(proj_get_source_crs(context, crs.get()));
  }
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS) {
    crs.reset(proj_crs_get_sub_crs(context, crs.get(), axis == CrsAxis::kVertical ? 1 : 0));
  }
  const PJ_TYPE wanted = axis == CrsAxis::kVertical ? PJ_TYPE_VERTICAL_CRS : PJ_TYPE_PROJECTED_CRS;
  if (crs && proj_get_type(crs.get()) != wanted) crs.reset();
  return crs;
}

CrsUnit named(const char* name, double metres) {
  const std::string ours = lengthName(metres);
  if (ours.empty()) return {name ? name : "", metres};
  return {ours, *metresPerUnit(ours)};
}

}  // namespace

std::optional<CrsUnit> crsUnit(const std::string& crs, CrsAxis axis) {
  const Context context = quietContext();
  if (!context) return std::nullopt;
  const Object part = partWith(context.get(), findCrs(context.get(), crs), axis);
  if (!part) return std::nullopt;
  const Object system(proj_crs_get_coordinate_system(context.get(), part.get()));
  double metres = 0;
  const char* name = nullptr;
  if (!system || !proj_cs_get_axis_info(context.get(), system.get(), 0, nullptr, nullptr, nullptr,
                                        &metres, &name, nullptr, nullptr)) {
    return std::nullopt;
  }
  return metres > 0 ? std::optional(named(name, metres)) : std::nullopt;
}

std::optional<CrsUnit> epsgUnit(uint16_t code) {
  for (const LengthUnit& known : kLengthUnits) {
    if (known.code == code) return CrsUnit{known.name, known.metres};
  }
  const Context context = quietContext();
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
