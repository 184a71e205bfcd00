// SPDX-License-Identifier: Apache-2.0
#include "base/placed_raster.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::inline base {

bool liesOn(const PlacedRaster& ground, const PlacedRaster& raster) {
  const double *const g = ground.geotransform, *const t = raster.geotransform;
  const double area = g[1] * g[5] - g[2] * g[4];
  const auto isInside = [&](double column, double row) {
    const double x = t[0] + column * t[1] + row * t[2] - g[0];
    const double y = t[3] + column * t[4] + row * t[5] - g[3];
    const double across = (g[5] * x - g[2] * y) / area, down = (g[1] * y - g[4] * x) / area;
    return across >= -1 && down >= -1 && across <= ground.width + 1.0 &&
           down <= ground.height + 1.0;
  };
  return isInside(0, 0) && isInside(raster.width, 0) && isInside(0, raster.height) &&
         isInside(raster.width, raster.height);
}

double fineness(const PlacedRaster& ground, const PlacedRaster& raster) {
  const double *const g = ground.geotransform, *const t = raster.geotransform;
  if (t == nullptr)
    return std::max(
        {1.0, double(raster.width) / ground.width, double(raster.height) / ground.height});
  return std::max({1.0, std::hypot(g[1], g[4]) / std::hypot(t[1], t[4]),
                   std::hypot(g[2], g[5]) / std::hypot(t[2], t[5])});
}

}  // namespace tetrakis::inline base
