// SPDX-License-Identifier: Apache-2.0
// Longitude and latitude of a pixel, from the positions that a stream holds.
#include <cmath>

#include "api/decoder.hpp"
#include "bitstream/stream/georeference.hpp"

namespace tetrakis::inline api {
namespace {

struct Pixel {
  double column, row;
};

/// In pixels of level 0: sample (x, y) of level k lies on sample (x 2^k, y 2^k).
Pixel atFinest(const Pixel& pixel, int level) {
  return {std::ldexp(pixel.column - 0.5, level) + 0.5, std::ldexp(pixel.row - 0.5, level) + 0.5};
}

/// A pixel of the texture as one of the heights, by the geotransforms of both.
Pixel onHeights(const Pixel& pixel, const GeoTransform& texture, const GeoTransform& heights) {
  const double x = texture[0] + pixel.column * texture[1] + pixel.row * texture[2] - heights[0];
  const double y = texture[3] + pixel.column * texture[4] + pixel.row * texture[5] - heights[3];
  const double area = heights[1] * heights[5] - heights[2] * heights[4];
  return {(heights[5] * x - heights[2] * y) / area, (heights[1] * y - heights[4] * x) / area};
}

Result<LongitudeLatitude> placeOf(const std::string& bytes, const Pixel& pixel,
                                  const Extent& extent) {
  const auto positions = groundPositionsIn(bytes);
  if (!positions) return Status(TKS_UNSUPPORTED, "The stream holds no positions for this part.");
  const TangentPlane plane(
      {static_cast<double>(positions->longitude), static_cast<double>(positions->latitude)});
  return plane.unproject(
      positions->at(2 * pixel.column / extent.width - 1, 2 * pixel.row / extent.height - 1));
}

Result<LongitudeLatitude> locate(const tks_decoder& decoder, const tks_pixel& asked) {
  const StreamHeader& header = decoder.parsed.header;
  const Georeference& place = header.georeference;
  const bool is_texture = asked.part == TKS_PART_TEXTURE;
  if (!is_texture && asked.part != TKS_PART_HEIGHTS)
    return Status(TKS_USAGE, "Only pixels of heights and of textures have places.");
  if (is_texture ? !header.texture : !header.geometry)
    return Status(TKS_USAGE, "The stream does not hold this part.");
  const int level = is_texture ? decoder.texture_level : decoder.heights_level;
  const Pixel pixel = atFinest({asked.column, asked.row}, level);
  const std::string& own = is_texture ? header.texture_positions : header.height_positions;
  if (!own.empty() || !is_texture)
    return placeOf(own, pixel, is_texture ? header.texture->shown() : header.geometry->shown());
  const bool shares = header.geometry && place.heights.has_transform &&
                      place.texture.has_transform && !place.hasTextureCrs();
  if (!shares) return placeOf({}, pixel, header.texture->shown());
  return placeOf(header.height_positions,
                 onHeights(pixel, place.texture.transform, place.heights.transform),
                 header.geometry->shown());
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_locate(tks_decoder* decoder, const tks_pixel* pixel, double* longitude,
                      double* latitude) {
  if (decoder == nullptr || pixel == nullptr || longitude == nullptr || latitude == nullptr)
    return TKS_USAGE;
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    const auto place = tetrakis::locate(*decoder, *pixel);
    if (!place.ok()) return place.status();
    *longitude = place->longitude;
    *latitude = place->latitude;
    return {};
  });
}
