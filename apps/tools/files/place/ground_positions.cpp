// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/ground_positions.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "apps/tools/files/place/proj_objects.hpp"
#include "base/coordinates.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {
namespace {

struct RasterSize {
  uint32_t width, height;
};

/// From places of a raster to longitude and latitude by WGS 84, as maps of the web have them.
class WebGround {
 public:
  WebGround(const Georeference& place, const RasterSize& size) : transform_(*place.geotransform) {
    if (!context_) return;
    const ProjObject crs = horizontalPart(context_.get(), findCrs(context_.get(), place.crs));
    const ProjObject degrees(proj_create(context_.get(), "EPSG:4326"));
    if (crs && degrees) to_degrees_ = transformation(context_.get(), crs.get(), degrees.get());
    if (!to_degrees_) return;
    // Other operations suit other parts of a country best, and there would be steps between them.
    double longitude = 0, latitude = 0;
    if (locate(this, size.width / 2.0, size.height / 2.0, &longitude, &latitude) == 0) {
      ProjObject of_middle(proj_trans_get_last_used_operation(to_degrees_.get()));
      if (of_middle) to_degrees_ = std::move(of_middle);
    }
  }
  bool known() const { return to_degrees_ != nullptr; }

  static int locate(void* user, double column, double row, double* longitude, double* latitude) {
    const auto& self = *static_cast<const WebGround*>(user);
    const GeoTransform& t = self.transform_;
    const PJ_COORD at = proj_coord(t[0] + column * t[1] + row * t[2],
                                   t[3] + column * t[4] + row * t[5], 0, HUGE_VAL);
    const PJ_COORD place = proj_trans(self.to_degrees_.get(), PJ_FWD, at);
    *longitude = place.xy.x;
    *latitude = place.xy.y;
    return std::isfinite(place.xy.x) && std::isfinite(place.xy.y) ? 0 : 1;
  }

 private:
  GeoTransform transform_;
  ProjContext context_ = quietContext();
  ProjObject to_degrees_;
};

/// Whether a place is known that a browser would not find.
bool needsPositions(const Georeference& place) {
  return place.geotransform && !place.crs.empty() && !knownToBrowsers(place.crs);
}

bool sameSystem(const Georeference& a, const Georeference& b) {
  return a.crs == b.crs && a.geo_keys == b.geo_keys;
}

PlacedRaster placed(const HeightFile& heights) {
  return {heights.width, heights.height, heights.geotransform->data()};
}
PlacedRaster placed(const ImageFile& image) {
  const auto& transform = image.place.geotransform;
  return {image.width, image.height, transform ? transform->data() : nullptr};
}

/// Fits them; `finer` parts of a sample count as one. Whether the place is known and nothing fits.
bool fails(Georeference& place, const RasterSize& size, double finer, uint64_t most_bytes) {
  WebGround ground(place, size);
  if (!ground.known()) return false;
  constexpr double kTolerance = 0.1;
  tks_ground wanted = makeGround();
  wanted.width = size.width;
  wanted.height = size.height;
  wanted.locate = WebGround::locate;
  wanted.user = &ground;
  wanted.tolerance = kTolerance / finer;
  const Result<Buffer> fitted = fitPositions(wanted);
  if (!fitted) return true;
  const std::span<const uint8_t> bytes = fitted->bytes();
  if (bytes.size() <= most_bytes) place.positions.assign(bytes.begin(), bytes.end());
  return false;
}

}  // namespace

std::string addPositions(HeightFile* heights, ImageFile* image, uint64_t most_bytes) {
  bool failed = false;
  const bool heights_need = heights != nullptr && needsPositions(*heights);
  if (heights_need) {
    const double finer = image != nullptr ? fineness(placed(*heights), placed(*image)) : 1;
    failed = fails(*heights, {heights->width, heights->height}, finer, most_bytes);
  }
  if (image != nullptr && needsPositions(image->place)) {
    const bool shares = heights_need && sameSystem(*heights, image->place) &&
                        liesOn(placed(*heights), placed(*image));
    if (!shares) failed |= fails(image->place, {image->width, image->height}, 1, most_bytes);
  }
  if (!failed) return "";
  return "its longitudes and latitudes do not fit into " + std::to_string(TKS_MOST_POSITION_BYTES) +
         " bytes within a tenth of a sample, so none are kept: web pages that do not know its CRS "
         "take them from `project`";
}

}  // namespace tetrakis::tools
