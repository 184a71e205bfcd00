// SPDX-License-Identifier: Apache-2.0
// Names of coordinate reference systems as streams and files have them: "EPSG:2056", WKT, a name.
#pragma once

#include <string>

namespace tetrakis::inline base {

/// Whether web pages turn a reference system into degrees by themselves (web/src/place.js):
/// degrees, web Mercator, UTM. Streams in others take fitted longitudes and latitudes along.
bool knownToBrowsers(const std::string& crs);

}  // namespace tetrakis::inline base
