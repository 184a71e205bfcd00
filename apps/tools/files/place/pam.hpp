// SPDX-License-Identifier: Apache-2.0
// takePam() reads FILE.aux.xml, in which GDAL keeps data that the format of FILE has no room for
// (GDAL's Persistent Auxiliary Metadata): the place of a PNG, a JPEG or a baseline TIFF, the nodata
// value of its samples. As in GDAL, this file counts more than FILE itself.
#pragma once

#include <string>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/pictures/band_colours.hpp"

namespace tetrakis::tools {

/// Takes the place that lies beside a picture, as far as there is one. Notes tell of a transform of
/// ArcGIS, of which only the CRS is taken.
void takePam(const std::string& picture, Georeference& place, Notes& notes);

/// Takes what lies beside heights, of the first band: place, unit, scale, offset, description, and
/// the nodata value.
void takePam(const std::string& picture, HeightFile& heights, Notes& notes);

/// Takes what lies beside a picture of the colours of its bands.
void takePam(const std::string& picture, std::vector<BandColour>& colours);

/// Takes the nodata values that lie beside a picture. nodata: a value for each band, or NaN.
void takePam(const std::string& picture, std::vector<double>& nodata);

}  // namespace tetrakis::tools
