// SPDX-License-Identifier: Apache-2.0
#include "api/same_ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tetrakis::inline api {

namespace {

bool says(const char* text) {
  return text != nullptr && *text != '\0';
}

bool sameText(const char* text, const char* first) {
  return !says(text) || (says(first) && std::strcmp(text, first) == 0);
}

/// Whether all corners of the rasters are at the same places.
template <class Raster>
bool samePlace(const Raster& raster, const Raster& first) {
  constexpr double kMostShift = 0.01;  // of a sample: places that programs rounded
  if (raster.has_geotransform == 0) return true;
  if (first.has_geotransform == 0) return false;
  const double *a = raster.geotransform, *b = first.geotransform;
  const double sample = std::max({std::abs(b[1]), std::abs(b[2]), std::abs(b[4]), std::abs(b[5])});
  const auto shift = [&](int i) {
    return std::abs(a[i] - b[i]) + raster.width * std::abs(a[i + 1] - b[i + 1]) +
           raster.height * std::abs(a[i + 2] - b[i + 2]);
  };
  return shift(0) <= kMostShift * sample && shift(3) <= kMostShift * sample;
}

}  // namespace

bool sameGround(const tks_heights& frame, const tks_heights& first) {
  return samePlace(frame, first) && sameText(frame.crs, first.crs) &&
         sameText(frame.unit, first.unit) && sameText(frame.vertical_datum, first.vertical_datum);
}

bool sameGround(const tks_image& frame, const tks_image& first) {
  return samePlace(frame, first) && sameText(frame.crs, first.crs);
}

}  // namespace tetrakis::inline api
