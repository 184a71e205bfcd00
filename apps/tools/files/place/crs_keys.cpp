// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/crs_keys.hpp"

#include <charconv>
#include <cmath>
#include <utility>

#include "apps/tools/files/place/proj_objects.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint16_t kDegree = 9102;

/// What follows "EPSG:"; 0 for other texts and codes that no key holds.
uint16_t codeIn(std::string_view text) {
  constexpr std::string_view kEpsg = "EPSG:";
  uint16_t code = 0;
  if (!text.starts_with(kEpsg)) return 0;
  text.remove_prefix(kEpsg.size());
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code);
  return error == std::errc() && end == text.data() + text.size() && code < kUserDefined ? code : 0;
}

uint16_t codeOf(const PJ* crs) {
  const char* authority = proj_get_id_auth_name(crs, 0);
  const char* code = proj_get_id_code(crs, 0);
  if (!authority || !code) return 0;
  return codeIn(std::string(authority) + ':' + code);
}

bool isGeographic(const PJ* crs) {
  const PJ_TYPE type = proj_get_type(crs);
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

/// Of the first axis of a CRS. EPSG has two degrees, which differ in how they are written down.
uint16_t unitCodeOf(PJ_CONTEXT* context, const PJ* crs) {
  const ProjObject system(proj_crs_get_coordinate_system(context, crs));
  const char* authority = nullptr;
  const char* code = nullptr;
  if (!system ||
      !proj_cs_get_axis_info(context, system.get(), 0, nullptr, nullptr, nullptr, nullptr, nullptr,
                             &authority, &code) ||
      !authority || !code) {
    return 0;
  }
  constexpr uint16_t kAnyDegree = 9122;
  const uint16_t unit = codeIn(std::string(authority) + ':' + code);
  return unit == kAnyDegree ? kDegree : unit;
}

void setUnit(GeoKey key, uint16_t code, GeoKeys& keys) {
  if (code != 0) keys.codes[key] = code;
}

/// Beside a code GDAL states names, units and the ellipsoid.
void describeGeographic(PJ_CONTEXT* context, const PJ* crs, GeoKeys& keys) {
  keys.texts[kGeodeticCitationGeoKey] = proj_get_name(crs);
  setUnit(kGeogAngularUnitsGeoKey, unitCodeOf(context, crs), keys);
  const ProjObject ellipsoid(proj_get_ellipsoid(context, crs));
  double semi_major = 0, inverse_flattening = 0;
  if (!ellipsoid || !proj_ellipsoid_get_parameters(context, ellipsoid.get(), &semi_major, nullptr,
                                                   nullptr, &inverse_flattening)) {
    return;
  }
  keys.numbers[kGeogSemiMajorAxisGeoKey] = {semi_major};
  keys.numbers[kGeogInvFlatteningGeoKey] = {inverse_flattening};
}

void describeProjected(PJ_CONTEXT* context, const PJ* crs, GeoKeys& keys) {
  keys.texts[kGtCitationGeoKey] = proj_get_name(crs);
  const ProjObject base(proj_get_source_crs(context, crs));
  if (base) keys.texts[kGeodeticCitationGeoKey] = proj_get_name(base.get());
  setUnit(kGeogAngularUnitsGeoKey, base ? unitCodeOf(context, base.get()) : 0, keys);
  setUnit(kProjLinearUnitsGeoKey, unitCodeOf(context, crs), keys);
}

/// As Esri writes it, or, where that means another CRS (a datum of another name), as GDAL does.
std::string wktOf(PJ_CONTEXT* context, const PJ* crs) {
  const char* options[] = {"MULTILINE=NO", nullptr};
  std::string first;
  for (const PJ_WKT_TYPE type : {PJ_WKT1_ESRI, PJ_WKT1_GDAL}) {
    const char* const wkt = proj_as_wkt(context, crs, type, options);
    if (!wkt) continue;
    const std::string text = wkt;
    const ProjObject back(proj_create(context, text.c_str()));
    if (back && proj_is_equivalent_to_with_ctx(context, crs, back.get(), PJ_COMP_EQUIVALENT))
      return text;
    if (first.empty()) first = text;
  }
  return first;
}

/// Without a code: as WKT where GDAL and Esri look for it.
void setAsText(PJ_CONTEXT* context, const PJ* crs, GeoKeys& keys) {
  const std::string wkt = wktOf(context, crs);
  if (wkt.empty()) return;
  keys.codes[kGtModelTypeGeoKey] = kUserDefined;
  keys.texts[kProjectedCitationGeoKey] = "ESRI PE String = " + wkt;
}

/// compound: a vertical part follows.
void setHorizontal(PJ_CONTEXT* context, const PJ* crs, bool compound, GeoKeys& keys) {
  const uint16_t code = codeOf(crs);
  const bool geographic = isGeographic(crs);
  if (code == 0 || (!geographic && proj_get_type(crs) != PJ_TYPE_PROJECTED_CRS))
    return setAsText(context, crs, keys);
  keys.codes[kGtModelTypeGeoKey] = geographic ? kModelTypeGeographic : kModelTypeProjected;
  keys.codes[geographic ? kGeodeticCrsGeoKey : kProjectedCrsGeoKey] = code;
  if (compound) return;
  geographic ? describeGeographic(context, crs, keys) : describeProjected(context, crs, keys);
}

/// Of a CRS that PROJ does not know. Codes from 4000 to 4999 are geographic ones.
void setUnknown(const std::string& crs, GeoKeys& keys) {
  const uint16_t code = codeIn(crs);
  const bool geographic = code >= 4000 && code < 5000;
  keys.codes[kGtModelTypeGeoKey] = geographic ? kModelTypeGeographic : kModelTypeProjected;
  keys.codes[geographic ? kGeodeticCrsGeoKey : kProjectedCrsGeoKey] = code ? code : kUserDefined;
  if (code == 0) keys.texts[kProjectedCitationGeoKey] = crs;
}

/// Of heights above something without a code.
void setVerticalName(const std::string& datum, const std::string& unit, GeoKeys& keys) {
  keys.codes[kVerticalGeoKey] = kUserDefined;
  keys.texts[kVerticalCitationGeoKey] = datum;
  for (const LengthUnit& known : kLengthUnits)
    if (unit == known.name) keys.codes[kVerticalUnitsGeoKey] = known.code;
}

/// A grid whose spacing is known, but not where it lies.
void setLocalGrid(const HeightFile& heights, GeoKeys& keys) {
  double size = heights.spacing_x;
  if (heights.geotransform)
    size = std::hypot((*heights.geotransform)[1], (*heights.geotransform)[4]);
  const std::string unit = lengthName(heights.spacing_x / size);
  for (const LengthUnit& known : kLengthUnits) {
    if (unit != known.name) continue;
    keys.codes[kGtModelTypeGeoKey] = kModelTypeProjected;
    keys.codes[kGtRasterTypeGeoKey] = TKS_REGISTRATION_AREA;
    keys.codes[kProjectedCrsGeoKey] = kUserDefined;
    keys.codes[kProjLinearUnitsGeoKey] = known.code;
  }
}

void setRegistration(tks_registration registration, GeoKeys& keys) {
  if (registration != TKS_REGISTRATION_UNKNOWN)
    keys.codes[kGtRasterTypeGeoKey] = static_cast<uint16_t>(registration);
}

/// Longitude, latitude and height, without the height: EPSG has both under one name.
ProjObject flatPart(PJ_CONTEXT* context, const PJ* crs) {
  if (!crs || proj_get_type(crs) != PJ_TYPE_GEOGRAPHIC_3D_CRS) return nullptr;
  constexpr int kExactly = 0;
  const PJ_TYPE flat = PJ_TYPE_GEOGRAPHIC_2D_CRS;
  PJ_OBJ_LIST* const found =
      proj_create_from_name(context, "EPSG", proj_get_name(crs), &flat, 1, kExactly, 1, nullptr);
  const bool any = found && proj_list_get_count(found) > 0;
  ProjObject part(any ? proj_list_get(context, found, 0) : nullptr);
  proj_list_destroy(found);
  return part;
}

}  // namespace

bool addsHeightsTo(const std::string& crs, const std::string& spatial) {
  const ProjContext context = quietContext();
  const ProjObject found = findCrs(context.get(), spatial);
  const ProjObject flat = flatPart(context.get(), found.get());
  return flat && codeOf(flat.get()) != 0 && codeOf(flat.get()) == codeIn(crs);
}

GeoKeys crsKeys(const std::string& crs, const std::string& vertical_datum,
                const std::string& unit) {
  GeoKeys keys;
  const ProjContext context = quietContext();
  PJ_CONTEXT* const c = context.get();
  ProjObject horizontal = horizontalPart(c, findCrs(c, crs));
  uint16_t spatial = 0;
  if (ProjObject flat = flatPart(c, horizontal.get()); flat && codeOf(flat.get()) != 0) {
    spatial = codeOf(horizontal.get());
    horizontal = std::move(flat);
  }
  const ProjObject vertical =
      verticalPart(c, findCrs(c, vertical_datum.empty() ? crs : vertical_datum));
  uint16_t code = vertical ? codeOf(vertical.get()) : codeIn(vertical_datum);
  if (!vertical && vertical_datum.empty()) code = spatial;
  if (horizontal) {
    setHorizontal(c, horizontal.get(), code != 0, keys);
  } else if (!crs.empty()) {
    setUnknown(crs, keys);
  }
  if (code != 0) keys.codes[kVerticalGeoKey] = code;
  if (code == 0 && vertical) setVerticalName(proj_get_name(vertical.get()), unit, keys);
  if (code == 0 && !vertical && !vertical_datum.empty())
    setVerticalName(vertical_datum, unit, keys);
  if (horizontal && vertical)
    keys.texts[kGtCitationGeoKey] =
        std::string(proj_get_name(horizontal.get())) + " + " + proj_get_name(vertical.get());
  return keys;
}

GeoKeys keysOf(const HeightFile& heights) {
  const bool spaced = heights.spacing_x > 0 && heights.spacing_y > 0;
  const bool adrift = spaced && !heights.geotransform;  // in metres from somewhere: in no CRS
  GeoKeys keys;
  if (!adrift) keys = parseGeoKeys(heights.geo_keys).value_or(GeoKeys{});
  if (keys.empty()) {
    keys = crsKeys(adrift ? "" : heights.crs, heights.vertical_datum, heights.unit);
    if (adrift || (spaced && heights.crs.empty())) setLocalGrid(heights, keys);
  }
  if (keys.code(kVerticalGeoKey) == 0 && !heights.vertical_datum.empty()) {
    const GeoKeys vertical = crsKeys("", heights.vertical_datum, heights.unit);
    keys.codes.insert(vertical.codes.begin(), vertical.codes.end());
    keys.texts.insert(vertical.texts.begin(), vertical.texts.end());
  }
  setRegistration(heights.registration, keys);
  return keys;
}

GeoKeys keysOf(const Georeference& place) {
  GeoKeys keys = parseGeoKeys(place.geo_keys).value_or(GeoKeys{});
  if (keys.empty()) keys = crsKeys(place.crs, "", "");
  setRegistration(place.registration, keys);
  return keys;
}

}  // namespace tetrakis::tools
