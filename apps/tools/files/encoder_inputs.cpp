// SPDX-License-Identifier: Apache-2.0
// What files hold, as the encoder takes it.
#include <algorithm>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/files.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

namespace {

const char* textOrUnknown(const std::string& text) {
  return text.empty() ? nullptr : text.c_str();
}

/// Into the fields that heights and images have alike; `place` outlives them.
template <class T>
void setPlace(const Georeference& place, T& raster) {
  raster.has_geotransform = place.geotransform.has_value();
  if (place.geotransform)
    std::copy(place.geotransform->begin(), place.geotransform->end(), raster.geotransform);
  raster.registration = place.registration;
  raster.crs = textOrUnknown(place.crs);
  raster.geo_keys = textOrUnknown(place.geo_keys);
  raster.positions = place.positions.empty() ? nullptr : place.positions.data();
  raster.positions_size = place.positions.size();
  raster.domain = place.domain;
}

}  // namespace

tks_heights asHeights(const HeightFile& file) {
  tks_heights heights = makeHeights();
  heights.width = file.width;
  heights.height = file.height;
  heights.sample = file.sample;
  heights.data = file.data.data();
  heights.scale = file.scale;
  heights.offset = file.offset;
  heights.spacing_x = file.spacing_x;
  heights.spacing_y = file.spacing_y;
  heights.unit = textOrUnknown(file.unit);
  heights.vertical_datum = textOrUnknown(file.vertical_datum);
  heights.description = textOrUnknown(file.description);
  setPlace(file, heights);
  heights.has_nodata = file.nodata.has_value();
  heights.nodata = file.nodata.value_or(0);
  if (file.cube_depth > 0) {
    heights.domain = TKS_DOMAIN_FOREST;
    heights.forest = {file.cube_depth, kCubePatches, tks_cube_sides()};
    heights.grid_width = file.grid_width;
    heights.grid_height = file.grid_height;
  }
  return heights;
}

tks_image asImage(const ImageFile& file) {
  tks_image image = makeImage();
  image.width = file.width;
  image.height = file.height;
  image.channels = file.channels;
  image.sample = file.sample;
  image.data = file.data.data();
  image.opaque = file.opaque;
  image.white_level = file.white_level;
  setPlace(file.place, image);
  return image;
}

}  // namespace tetrakis::tools
