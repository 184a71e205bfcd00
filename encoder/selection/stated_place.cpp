// SPDX-License-Identifier: Apache-2.0
#include "encoder/selection/stated_place.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::inline selection {

namespace {

std::string textOf(const char* text) {
  return text != nullptr ? text : "";
}

template <class T>
Placement placementOf(const T& raster) {
  Placement placement;
  placement.has_transform = raster.has_geotransform != 0;
  if (placement.has_transform)
    std::copy_n(raster.geotransform, placement.transform.size(), placement.transform.begin());
  placement.registration = static_cast<uint8_t>(raster.registration);
  placement.geo_keys = textOf(raster.geo_keys);
  return placement;
}

}  // namespace

Georeference georeferenceOf(const tks_heights* heights, const tks_image* image) {
  Georeference out;
  if (heights != nullptr) {
    out.heights = placementOf(*heights);
    out.description = textOf(heights->description);
    out.nan_nodata = heights->has_nodata && std::isnan(heights->nodata);
  }
  if (image == nullptr) return out;
  out.texture = placementOf(*image);
  out.texture_crs = textOf(image->crs);
  const bool shared = heights != nullptr && out.texture.has_transform &&
                      out.texture_crs == textOf(heights->crs) &&
                      out.texture.geo_keys == out.heights.geo_keys;
  if (shared) {
    out.texture_crs.clear();
    out.texture.geo_keys.clear();
  }
  return out;
}

}  // namespace tetrakis::inline selection
