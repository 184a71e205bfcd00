// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/proj_objects.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace tetrakis::tools {
namespace {

ProjObject partOf(PJ_CONTEXT* context, ProjObject crs, int index) {
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS)
    crs.reset(proj_crs_get_sub_crs(context, crs.get(), index));
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
    crs.reset(proj_get_source_crs(context, crs.get()));
  return crs;
}

/// As EPSG:32611, esri:102003 or urn:ogc:def:crs:EPSG::4326. Names and WKT have a blank or a
/// bracket in what comes first.
bool isCrsCode(std::string_view text) {
  const size_t colon = text.find(':');
  if (colon == 0 || colon == text.npos || colon + 1 == text.size()) return false;
  const auto in_authority = [](unsigned char letter) {
    return std::isalnum(letter) || letter == '_';
  };
  return std::all_of(text.begin(), text.begin() + static_cast<ptrdiff_t>(colon), in_authority) &&
         text.find_first_of(" [") == text.npos;
}

/// PROJ's general search also takes names that are only similar, for which it looks for a second.
ProjObject findNamed(PJ_CONTEXT* context, const std::string& name) {
  constexpr int kExactly = 0;
  const PJ_TYPE type = PJ_TYPE_CRS;
  PJ_OBJ_LIST* const found =
      proj_create_from_name(context, nullptr, name.c_str(), &type, 1, kExactly, 1, nullptr);
  ProjObject crs(found && proj_list_get_count(found) > 0 ? proj_list_get(context, found, 0)
                                                         : nullptr);
  proj_list_destroy(found);
  return crs;
}

}  // namespace

std::string withUpperCaseAuthority(std::string text) {
  if (!isCrsCode(text) || text.find(':') != text.rfind(':')) return text;
  const auto colon = text.begin() + static_cast<ptrdiff_t>(text.find(':'));
  std::transform(text.begin(), colon, text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return text;
}

ProjContext quietContext() {
  ProjContext context(proj_context_create());
  if (context) proj_log_func(context.get(), nullptr, [](void*, int, const char*) {});
  return context;
}

ProjObject findCrs(PJ_CONTEXT* context, std::string text) {
  constexpr std::string_view kEsri = "ESRI PE String = ";
  if (text.starts_with(kEsri)) text.erase(0, kEsri.size());
  if (text.empty()) return nullptr;
  const bool exact = isCrsCode(text) || text.find('[') != text.npos;
  const bool compound = text.find(" + ") != text.npos;
  ProjObject crs =
      exact || compound ? ProjObject(proj_create(context, text.c_str())) : findNamed(context, text);
  if (crs && !proj_is_crs(crs.get())) crs.reset();
  if (crs && !exact && text != proj_get_name(crs.get())) crs.reset();
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
    crs.reset(proj_get_source_crs(context, crs.get()));
  return crs;
}

ProjObject horizontalPart(PJ_CONTEXT* context, ProjObject crs) {
  crs = partOf(context, std::move(crs), 0);
  if (crs && proj_get_type(crs.get()) == PJ_TYPE_VERTICAL_CRS) crs.reset();
  return crs;
}

ProjObject verticalPart(PJ_CONTEXT* context, ProjObject crs) {
  crs = partOf(context, std::move(crs), 1);
  if (crs && proj_get_type(crs.get()) != PJ_TYPE_VERTICAL_CRS) crs.reset();
  return crs;
}

ProjObject transformation(PJ_CONTEXT* context, const PJ* from, const PJ* to) {
  const ProjObject raw(proj_create_crs_to_crs_from_pj(context, from, to, nullptr, nullptr));
  return raw ? ProjObject(proj_normalize_for_visualization(context, raw.get())) : nullptr;
}

}  // namespace tetrakis::tools
