// SPDX-License-Identifier: Apache-2.0
// meetsNodata() tells whether a sample has the nodata value, as GDAL compares them
// (ARE_REAL_EQUAL() in gdal_priv.h and GDALNoDataMaskBand, GDAL 3.6). toFloat() turns a nodata
// value into a float.
#pragma once

#include <cmath>
#include <limits>

namespace tetrakis::inline base {

/// T: float or double. A text of few digits must meet the sample, so that the last bits do not
/// count. NaN meets NaN.
template <class T>
bool meetsNodata(T sample, T nodata) {
  constexpr T kRelative = 2 * std::numeric_limits<float>::epsilon();
  return sample == nodata || (std::isnan(sample) && std::isnan(nodata)) ||
         std::abs(sample - nodata) < kRelative * std::abs(sample + nodata);
}

/// The nearest float; an infinity beyond the largest.
inline float toFloat(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  // A conversion that overflows is undefined.
  if (std::abs(value) <= kLargest || !std::isfinite(value)) return static_cast<float>(value);
  return std::copysign(std::numeric_limits<float>::infinity(), value < 0 ? -1.0F : 1.0F);
}

/// What floats are compared with: the nearest float, and the largest one for its own text of few
/// digits, which may lie above it.
inline float floatNodata(double nodata) {
  const double largest = std::copysign(double{std::numeric_limits<float>::max()}, nodata);
  const bool beyond = std::abs(nodata) > std::abs(largest);
  return toFloat(beyond && meetsNodata(nodata, largest) ? largest : nodata);
}

/// What stands for the voids of doubles where these become floats: the nearest float if it meets
/// the nodata value, the largest float for a larger number, else NaN. Where another double becomes
/// a float that meets it, NaN has to stand for the voids too: no height becomes void.
inline float narrowedNodata(double nodata) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  const float nearest = floatNodata(nodata);
  if (std::isinf(nearest) && std::isfinite(nodata)) return std::copysign(kLargest, nearest);
  const bool met = meetsNodata(static_cast<double>(nearest), nodata);
  return met ? nearest : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace tetrakis::inline base
