// SPDX-License-Identifier: Apache-2.0
// knownToBrowsers() reads the name of a coordinate reference system as streams and files state it:
// "EPSG:2056", WKT, or a name.
#pragma once

#include <string>

namespace tetrakis::inline base {

/// Whether web pages turn a reference system into degrees by themselves (apps/web/src/place.js):
/// degrees, web Mercator, UTM. Streams in others take fitted longitudes and latitudes along.
bool knownToBrowsers(const std::string& crs);

}  // namespace tetrakis::inline base
