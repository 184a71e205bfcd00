// SPDX-License-Identifier: Apache-2.0
// Times of frames in the words of RFC 3339 and of the CF conventions, which GDAL's netCDF driver
// uses.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>

#include "apps/doors/gdal/sequence_groups.hpp"

namespace tetrakis::gdal {

/// "2019-03-01T12:30:00Z"; "" where nobody knows when tick 0 is, or the calendar is not that of
/// everyday life.
std::string rfc3339(const SequenceClock& clock, int64_t ticks);

/// Numbers of CF: the longest of its units of which a tick is a multiple, else seconds.
struct CfUnit {
  std::string name;     ///< "hours since 1900-01-01 00:00:00", or "hours" without an epoch
  double per_tick = 1;  ///< numbers of it
};
/// Nothing where nobody knows what a tick is.
std::optional<CfUnit> cfUnit(const SequenceClock& clock);

/// What "hours since 1900-01-01" means; nothing if it means nothing of a fixed length.
std::optional<SequenceClock> clockOfCf(const std::string& units, const std::string& calendar);

/// Seconds from 1970 to a time of RFC 3339 or CF, in the calendar of everyday life.
struct Moment {
  int64_t seconds = 0;
  int64_t nanoseconds = 0;
};
std::optional<Moment> momentOf(const std::string& text);

/// When the bands of a dataset are, as drivers of GDAL say it: netCDF, GRIB, and this one.
struct BandTimes {
  SequenceClock clock;
  std::vector<int64_t> ticks;  ///< of each band, rising
};
/// Where they are not known, or do not rise, which a warning tells: numbers of bands, from 0 on.
BandTimes timesOf(const std::string& name, GDALDataset& dataset);

}  // namespace tetrakis::gdal
