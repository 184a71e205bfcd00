// SPDX-License-Identifier: Apache-2.0
// A band of a dataset, or of one of its overviews: samples by blocks, and what it says of them.
#pragma once

#include <optional>
#include <string>

#include "doors/gdal/dataset.hpp"

namespace tetrakis::gdal {

/// What a band says beside its samples.
struct BandFacts {
  std::optional<double> nodata;
  double scale = 1, offset = 0;
  std::string unit;
  GDALColorInterp colour = GCI_GrayIndex;
};

/// GDAL owns it.
GDALRasterBand* makeBand(Dataset& dataset, int number, BandFacts facts);

}  // namespace tetrakis::gdal
