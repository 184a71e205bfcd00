// SPDX-License-Identifier: Apache-2.0
// The types here own PROJ's objects and release them.
#pragma once

#include <proj.h>

#include <memory>
#include <string>

namespace tetrakis::tools {

struct ReleaseProj {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, ReleaseProj>;
using ProjObject = std::unique_ptr<PJ, ReleaseProj>;

/// "EPSG:4326" for "epsg:4326", as pyproj and PostGIS may write it; other texts as they are.
std::string withUpperCaseAuthority(std::string text);

/// One that prints nothing.
ProjContext quietContext();

/// A CRS by its code, WKT or exact name; of one that is bound to another, itself. Null if PROJ does
/// not know it.
ProjObject findCrs(PJ_CONTEXT* context, std::string text);

/// The horizontal or the vertical part of a compound CRS; any other that is one itself, or null.
ProjObject horizontalPart(PJ_CONTEXT* context, ProjObject crs);
ProjObject verticalPart(PJ_CONTEXT* context, ProjObject crs);

/// From coordinates of one CRS to those of another: x or longitude first, degrees where they are
/// angles. Null if PROJ knows no way, as between worlds.
ProjObject transformation(PJ_CONTEXT* context, const PJ* from, const PJ* to);

}  // namespace tetrakis::tools
