// SPDX-License-Identifier: Apache-2.0
// What JavaScript calls to encode terrain: tks_encode (apps/web/src/encoder.js).
#include <bit>
#include <cstddef>
#include <cstdint>

#include "apps/web/module/domains.hpp"
#include "apps/web/module/encode_inputs.hpp"
#include "tetrakis/tetrakis.h"

/// The page's: the longitude and latitude of a column and a row; not 0 where it knows none.
extern "C" int web_degrees(double column, double row, double* degrees);

namespace {

using tetrakis::web::Numbers;

/// Of heights or texels whose domain JavaScript calls a cube; tks_encode checks their size.
template <class Raster>
void placeOnCube(Raster& raster) {
  if (raster.domain != kCube) return;
  raster.domain = TKS_DOMAIN_FOREST;
  const auto depth = static_cast<uint32_t>(std::bit_width(raster.width)) - 1;
  raster.forest = {depth, kCubePatches, tks_cube_sides()};
}

/// Of heights or an image, fitted before.
template <class Raster>
void takePositions(Raster& raster, Numbers& numbers, const void* positions) {
  raster.positions = static_cast<const uint8_t*>(positions);
  numbers.take(raster.positions_size);
}

tks_heights heightsOf(Numbers& numbers, const char* const* texts, const void* const* data) {
  tks_heights h{};
  h.size = sizeof h;
  h.data = data[0];
  numbers.take(h.width);
  numbers.take(h.height);
  numbers.take(h.sample);
  numbers.take(h.scale);
  numbers.take(h.offset);
  numbers.take(h.step);
  numbers.take(h.spacing_x);
  numbers.take(h.spacing_y);
  numbers.take(h.has_nodata);
  numbers.take(h.nodata);
  numbers.take(h.has_geotransform);
  numbers.take(h.geotransform);
  numbers.take(h.registration);
  numbers.take(h.domain);
  placeOnCube(h);
  takePositions(h, numbers, data[2]);
  h.unit = texts[0];
  h.vertical_datum = texts[1];
  h.crs = texts[2];
  h.description = texts[3];
  h.geo_keys = texts[4];
  return h;
}

/// has_nodata of heights whose nodata value is to be found.
constexpr int kFound = 2;

/// Declares what files write where they have no height, if the caller asks for that.
void findNodata(tks_heights& heights) {
  if (heights.has_nodata != kFound) return;
  heights.has_nodata = 0;
  tks_outliers found{sizeof found, 0, 0, 0};
  if (tks_find_outliers(&heights, &found) != TKS_OK || found.is_fill == 0) return;
  heights.has_nodata = 1;
  heights.nodata = found.value;
}

tks_image imageOf(Numbers& numbers, const char* const* texts, const void* const* data) {
  tks_image image{};
  image.size = sizeof image;
  image.data = data[1];
  numbers.take(image.width);
  numbers.take(image.height);
  numbers.take(image.channels);
  numbers.take(image.sample);
  numbers.take(image.has_geotransform);
  numbers.take(image.geotransform);
  numbers.take(image.registration);
  numbers.take(image.domain);
  placeOnCube(image);
  takePositions(image, numbers, data[3]);
  numbers.take(image.opaque);
  numbers.take(image.white_level);
  image.crs = texts[5];
  image.geo_keys = texts[6];
  return image;
}

/// For tks_ground: from the page, which knows the CRS.
int locate(void*, double column, double row, double* longitude, double* latitude) {
  double degrees[2];
  const int failed = web_degrees(column, row, degrees);
  *longitude = degrees[0];
  *latitude = degrees[1];
  return failed;
}

}  // namespace

extern "C" {

/// What the numbers of web_encode() are, by the names that JavaScript gives them.
const char* web_encode_names() {
  return "width height sample scale offset step spacingX spacingY hasNodata nodata "
         "hasGeotransform g0 g1 g2 g3 g4 g5 registration domain positions "
         "textureWidth textureHeight textureChannels textureSample "
         "textureHasGeotransform t0 t1 t2 t3 t4 t5 textureRegistration textureDomain "
         "texturePositions textureOpaque textureWhiteLevel "
         "bytes psnr maxError lossless triangles regions index weights";
}

/// Likewise its texts.
const char* web_encode_texts() {
  return "unit verticalDatum crs description geoKeys textureCrs textureGeoKeys";
}

/// data: of the heights and of the image, NULL where there is none; then their positions, likewise.
/// texts: NULL where unknown.
tks_status web_encode(const double* numbers, const char* const* texts, const void* const* data,
                      tks_buffer* out, char* message, size_t message_size) {
  Numbers left(numbers);
  tks_heights heights = heightsOf(left, texts, data);
  const tks_image image = imageOf(left, texts, data);
  tks_encode_options o{};
  o.size = sizeof o;
  left.take(o.bytes);
  left.take(o.psnr);
  left.take(o.max_error);
  left.take(o.lossless);
  left.take(o.triangles);
  left.take(o.regions);
  left.take(o.index);
  left.take(o.weights);
  o.progress = tetrakis::web::tellProgress;
  findNodata(heights);
  return tks_encode(data[0] != nullptr ? &heights : nullptr, data[1] != nullptr ? &image : nullptr,
                    &o, out, message, message_size);
}

/// tks_fit_positions, of a raster of that size.
tks_status web_fit_positions(uint32_t width, uint32_t height, tks_buffer* out) {
  tks_ground ground{};
  ground.size = sizeof ground;
  ground.width = width;
  ground.height = height;
  ground.locate = locate;
  return tks_fit_positions(&ground, out);
}

}  // extern "C"
