// SPDX-License-Identifier: Apache-2.0
// Reference systems: the texts of a stream (tetrakis.h: "EPSG:code", WKT or a name) and GDAL's.
#pragma once

#include <memory>
#include <string>

#include <ogr_spatialref.h>

namespace tetrakis::gdal {

struct CrsTexts {
  std::string crs, vertical_datum, geo_keys;  ///< "" when unknown
};

/// As streams have texts: what is no UTF-8 is taken for ISO 8859-1.
std::string asUtf8(const char* text);

/// Codes where they say all, else WKT2.
CrsTexts crsTexts(const OGRSpatialReference& system);

/// In the unit of a geographic system; 0: it has no angles, or is unknown (null).
double degreesOf(const OGRSpatialReference* system);

/// The name of the unit of heights, of a CRS that has some; else "".
std::string heightUnitOf(const OGRSpatialReference& system);

struct SpatialReferenceDeleter {
  void operator()(OGRSpatialReference* system) const { system->Release(); }
};
using SpatialReference = std::unique_ptr<OGRSpatialReference, SpatialReferenceDeleter>;

/// Null where the texts are empty; null after a warning where nothing can be made of them. A
/// vertical datum that has neither code nor WKT takes no part.
SpatialReference readCrs(const CrsTexts& texts, const std::string& file_name);

/// What the keys of a GeoTIFF (docs/FORMAT.md, section 2, `geo_keys`) mean: GDAL's reader of
/// GeoTIFF decides. Null if it makes nothing of them.
SpatialReference readGeoKeys(const std::string& keys);

}  // namespace tetrakis::gdal
