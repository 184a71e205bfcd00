// SPDX-License-Identifier: Apache-2.0
// Coordinates on the ground are read in one way everywhere: canonicalUnit() and metresPerUnit()
// take the name of a length and return ours and its metres, knownToBrowsers() takes the name of a
// reference system, and liesOn() compares the places of two rasters.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tetrakis::inline base {

// knownToBrowsers() reads the name of a coordinate reference system as streams and files state it:
// "EPSG:2056", WKT, or a name.

/// Whether web pages turn a reference system into degrees by themselves (apps/web/src/place.js):
/// degrees, web Mercator, UTM. Streams in others take fitted longitudes and latitudes along.
bool knownToBrowsers(const std::string& crs);

// canonicalUnit(), metresPerUnit() and lengthName() translate between names of lengths and metres,
// because files say "US survey foot" and streams "us-ft". The feet are defined by the international
// yard and pound agreement of 1959.

/// Metres between samples where nothing says how many: those of the global one-arc-second models.
/// Encoders price height errors, and cameras stand, as if they were this far apart.
inline constexpr double kUnknownSpacing = 30;

/// Our name of a length ("m", "cm", "mm", "km", "ft", "us-ft") for another one of it ("metres",
/// "US survey foot", "ftUS"), in upper or lower case; every other text as it is.
std::string canonicalUnit(std::string_view unit);

/// Metres in one `unit`, by any of its names. An unknown unit ("") is taken for metres; nothing if
/// the unit is no length.
std::optional<double> metresPerUnit(std::string_view unit);

/// Our name of the unit that is so many metres long; "" if it has none.
std::string lengthName(double metres);

// liesOn() and fineness() compare two rasters on one ground: whether one lies on the other, and how
// much finer it is. columnsRound() and edgeLatitudes() look at one alone.

/// A raster and its geotransform, as GDAL has it: six numbers, from columns and rows to x and y.
struct PlacedRaster {
  uint32_t width, height;
  const double* geotransform;  ///< null: it covers what it is laid over
};

/// Whether all corners of a raster lie on the ground of another one, or beside it by less than a
/// sample of that. Both have geotransforms of one reference system.
bool liesOn(const PlacedRaster& ground, const PlacedRaster& raster);

/// Whether the columns of a grid go round the Earth, so that the last one lies beside the first.
enum class ColumnsRound : uint8_t {
  kNo,
  kOnce,      ///< through 360 degrees
  kRepeating  ///< through 360 degrees and one column more, which is the first one again
};

/// degrees: in the unit of the raster's x and y; 0 where x and y are no angles. Grids without a
/// geotransform, with a gap, or that overlap by other than a column do not go round.
ColumnsRound columnsRound(const PlacedRaster& raster, double degrees);

/// The latitudes of the outer edges of the first row and of the last one, in degrees, as tks_heights
/// takes them; degrees: as above. Both 0 where x and y are no angles, rows are no parallels, or y is
/// no latitude.
std::array<double, 2> edgeLatitudes(const PlacedRaster& raster, double degrees);

/// How many samples of a raster lie along one of the ground that is under it, at least 1.
double fineness(const PlacedRaster& ground, const PlacedRaster& raster);

}  // namespace tetrakis::inline base
