// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/texture_place.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal_alg.h>

namespace tetrakis::gdal {
namespace {

using Transformer = std::unique_ptr<void, decltype(&GDALDestroyGenImgProjTransformer)>;

bool isPlaced(GDALDataset& dataset) {
  double transform[6];
  return dataset.GetGeoTransform(transform) == CE_None;
}

/// From columns and rows of one to those of the other; null where PROJ does not know.
Transformer between(GDALDataset& from, GDALDataset& to) {
  CPLStringList options;
  options.SetNameValue("SRC_METHOD", "GEOTRANSFORM");
  options.SetNameValue("DST_METHOD", "GEOTRANSFORM");
  options.SetNameValue("STRIP_VERT_CS", "YES");
  return {GDALCreateGenImgProjTransformer2(&from, &to, options.List()),
          GDALDestroyGenImgProjTransformer};
}

/// Places in a raster of this size along its border, which says what lies in it, whatever a
/// projection bends.
struct Border {
  std::vector<double> x, y;

  Border(int width, int height) {
    constexpr int kParts = 16;
    for (int part = 0; part <= kParts; ++part) {
      const double across = part * (width - 1.) / kParts, down = part * (height - 1.) / kParts;
      for (const auto& [column, row] : {std::pair(across, 0.), std::pair(across, height - 1.),
                                        std::pair(0., down), std::pair(width - 1., down)}) {
        x.push_back(column + 0.5);  // a sample is the middle of its pixel
        y.push_back(row + 0.5);
      }
    }
  }
};

/// Of the values that a transform has found, and a side of the raster that it leads to.
bool meets(const std::vector<double>& values, const std::vector<int>& found, int side) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!found[i] || !std::isfinite(values[i])) continue;
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  return low <= side && high >= 0;
}

}  // namespace

bool liesBeside(GDALDataset& texture, GDALDataset& heights) {
  if (!isPlaced(texture) || !isPlaced(heights)) return false;
  if (texture.GetSpatialRef() != nullptr && heights.GetSpatialRef() == nullptr) return false;
  CPLErrorStateBackuper quiet;
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const Transformer transformer = between(heights, texture);
  Border border(heights.GetRasterXSize(), heights.GetRasterYSize());
  std::vector<double> z(border.x.size());
  std::vector<int> found(border.x.size());
  if (transformer)
    GDALGenImgProjTransform(transformer.get(), FALSE, static_cast<int>(z.size()), border.x.data(),
                            border.y.data(), z.data(), found.data());
  CPLPopErrorHandler();
  return transformer && !(meets(border.x, found, texture.GetRasterXSize()) &&
                          meets(border.y, found, texture.GetRasterYSize()));
}

}  // namespace tetrakis::gdal
