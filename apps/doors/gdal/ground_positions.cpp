// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/ground_positions.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include <cpl_string.h>
#include <gdal_alg.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::gdal {
namespace {

template <class Raster>
PlacedRaster placed(const Raster& raster) {
  return {raster.width, raster.height, raster.has_geotransform ? raster.geotransform : nullptr};
}

/// Fits them; `finer` parts of a sample count as one. Whether the place is known and nothing fits.
template <class Copy, class Raster>
bool fails(Copy& copy, Raster& raster, double finer, uint64_t most_bytes) {
  constexpr double kTolerance = 0.1;
  tks_ground wanted{};
  wanted.size = sizeof wanted;
  wanted.width = raster.width;
  wanted.height = raster.height;
  wanted.locate = WebGround::locate;
  wanted.user = copy.ground.get();
  wanted.tolerance = kTolerance / finer;
  tks_buffer fitted{};
  const bool fits = tks_fit_positions(&wanted, &fitted) == TKS_OK;
  if (fits && fitted.size <= most_bytes) {
    copy.positions.assign(fitted.data, fitted.data + fitted.size);
    raster.positions = copy.positions.data();
    raster.positions_size = copy.positions.size();
  }
  tks_free_buffer(&fitted);
  return !fits;
}

}  // namespace

void WebGround::Destroy::operator()(void* transformer) const {
  GDALDestroyGenImgProjTransformer(transformer);
}

std::unique_ptr<WebGround> WebGround::of(GDALDataset& dataset, const std::string& crs) {
  double transform[6];
  if (crs.empty() || knownToBrowsers(crs) || dataset.GetGeoTransform(transform) != CE_None)
    return nullptr;
  const CPLErrorStateBackuper errors;  // nobody asked for degrees: a failure stays silent
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  CPLStringList options;
  options.SetNameValue("SRC_METHOD", "GEOTRANSFORM");
  options.SetNameValue("DST_SRS", "EPSG:4326");
  options.SetNameValue("STRIP_VERT_CS", "YES");
  auto ground = std::make_unique<WebGround>();
  ground->transformer_.reset(GDALCreateGenImgProjTransformer2(&dataset, nullptr, options.List()));
  return ground->transformer_ ? std::move(ground) : nullptr;
}

int WebGround::locate(void* user, double column, double row, double* longitude, double* latitude) {
  double x = column, y = row, z = 0;
  int found = FALSE;
  GDALGenImgProjTransform(static_cast<WebGround*>(user)->transformer_.get(), FALSE, 1, &x, &y, &z,
                          &found);
  *longitude = x;
  *latitude = y;
  return found && std::isfinite(x) && std::isfinite(y) ? 0 : 1;
}

void addPositions(const std::string& name, CopiedHeights* heights, CopiedTexture* texture,
                  uint64_t most_bytes) {
  const CPLErrorStateBackuper errors;
  bool failed = false;
  {
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const bool heights_need = heights != nullptr && heights->ground;
    if (heights_need) {
      const PlacedRaster ground = placed(heights->heights);
      const double finer = texture != nullptr ? fineness(ground, placed(texture->image)) : 1;
      failed = fails(*heights, heights->heights, finer, most_bytes);
    }
    if (texture != nullptr && texture->ground) {
      const bool shares = heights_need && heights->crs.crs == texture->crs.crs &&
                          heights->crs.geo_keys == texture->crs.geo_keys &&
                          liesOn(placed(heights->heights), placed(texture->image));
      if (!shares) failed |= fails(*texture, texture->image, 1, most_bytes);
    }
  }
  if (failed)
    CPLError(
        CE_Warning, CPLE_AppDefined,
        "%s: Its longitudes and latitudes do not fit into %d bytes within a tenth of a sample, "
        "so none are kept: web pages that do not know its CRS take them from `project`.",
        name.c_str(), TKS_MOST_POSITION_BYTES);
}

uint64_t positionBytes(const tks_heights* heights, const tks_image* texture,
                       const tks_encode_options& options) {
  constexpr uint64_t kShare = 64;
  const uint64_t samples = (heights ? uint64_t{heights->width} * heights->height : 0) +
                           (texture ? uint64_t{texture->width} * texture->height : 0);
  return (options.bytes > 0 ? options.bytes : samples) / kShare;
}

}  // namespace tetrakis::gdal
