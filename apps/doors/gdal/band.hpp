// SPDX-License-Identifier: Apache-2.0
// A band of a dataset, or of one of its overviews: samples by blocks, and what it says of them.
#pragma once

#include <optional>
#include <string>

#include "apps/doors/gdal/dataset.hpp"

namespace tetrakis::gdal {

/// From pixels to what they stand for: pixel * scale + offset.
struct Scaling {
  double scale = 1, offset = 0;

  bool isAny() const { return scale != 1 || offset != 0; }
};

/// What the stream says of a band beside its samples. What is kept beside the stream precedes.
struct BandFacts {
  std::optional<double> nodata;
  Scaling scaling;
  std::string unit;
  GDALColorInterp colour = GCI_GrayIndex;
};

/// GDAL owns it.
GDALRasterBand* makeBand(Dataset& dataset, int number, BandFacts facts);

}  // namespace tetrakis::gdal
