// SPDX-License-Identifier: Apache-2.0
// When the bands of a dataset are, as drivers of GDAL say it: netCDF, GRIB, and this one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include "apps/doors/gdal/sequence_groups.hpp"

namespace tetrakis::gdal {

struct BandTimes {
  SequenceClock clock;
  std::vector<int64_t> ticks;  ///< of each band, rising
};

/// Where they are not known, or do not rise, which a warning tells: numbers of bands, from 0 on.
BandTimes timesOf(const std::string& name, GDALDataset& dataset);

}  // namespace tetrakis::gdal
