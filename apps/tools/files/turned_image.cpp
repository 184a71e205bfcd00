// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/turned_image.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::tools {
namespace {

/// Column and row of the stored picture for an edge, or a pixel, of the turned one. last: how far
/// the stored columns and rows reach.
std::pair<double, double> storedPlace(const QuarterTurn& turn, double x, double y,
                                      const std::pair<double, double>& last) {
  const double column = turn.transposed ? y : x, row = turn.transposed ? x : y;
  return {turn.columns_back ? last.first - column : column,
          turn.rows_back ? last.second - row : row};
}

GeoTransform turnedTransform(const GeoTransform& t, const ImageFile& stored,
                             const QuarterTurn& turn) {
  const auto at = [&](double x, double y) {
    const auto [column, row] = storedPlace(turn, x, y, {stored.width, stored.height});
    return std::pair(t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5]);
  };
  const auto corner = at(0, 0), east = at(1, 0), south = at(0, 1);
  return {corner.first,  east.first - corner.first,   south.first - corner.first,
          corner.second, east.second - corner.second, south.second - corner.second};
}

}  // namespace

ImageFile turned(const ImageFile& stored, const QuarterTurn& turn) {
  ImageFile image = stored;
  if (turn.transposed) std::swap(image.width, image.height);
  const size_t pixel_bytes = stored.channels * tks_sample_bytes(stored.sample);
  auto pixel = image.data.begin();
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const auto [column, row] = storedPlace(turn, x, y, {stored.width - 1.0, stored.height - 1.0});
      const auto index = static_cast<size_t>(row) * stored.width + static_cast<size_t>(column);
      pixel = std::copy_n(stored.data.begin() + static_cast<ptrdiff_t>(index * pixel_bytes),
                          pixel_bytes, pixel);
    }
  }
  if (stored.place.geotransform)
    image.place.geotransform = turnedTransform(*stored.place.geotransform, stored, turn);
  return image;
}

}  // namespace tetrakis::tools
