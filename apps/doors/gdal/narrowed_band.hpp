// SPDX-License-Identifier: Apache-2.0
// A band of doubles as floats, window by window.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <gdal_priv.h>
#include "base/nodata.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// Voids are told as doubles: -DBL_MAX, a common one, is beyond the floats. What stands for them:
/// base/nodata.hpp. It depends on all samples, so that all have to be read before any are marked.
class NarrowedBand {
 public:
  explicit NarrowedBand(GDALRasterBand& band);

  /// Reads samples, row by row; voids are NaN. False after an error of GDAL.
  bool read(const tks_window& window, std::span<float> out);
  /// Gives voids what stands for them.
  void mark(std::span<float> samples) const;

  /// The largest of any sample that is not void.
  double rounding() const { return rounding_; }
  /// What stands for voids, if any value does.
  std::optional<double> nodata() const;

 private:
  static constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

  float narrowed(double value, bool valid);

  GDALRasterBand& band_;
  std::optional<double> nodata_;
  float mark_;
  bool masked_;
  bool merged_ = false;  ///< a sample that is not void has become what meets the mark
  double rounding_ = 0;
  std::vector<double> row_;
  std::vector<GByte> mask_;
};

}  // namespace tetrakis::gdal
