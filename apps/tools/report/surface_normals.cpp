// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/surface_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/tools/report/scene.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint64_t kMaxNormalSamples = uint64_t{1} << 24;

/// Heights in units of the stream, NaN where void.
class Slopes {
 public:
  Slopes(std::vector<float> heights, const PlacedFrame& frame)
      : heights_(std::move(heights)), frame_(frame) {}

  const GroundAxes& axes() const { return frame_.axes; }

  /// East, up, south.
  std::array<double, 3> normalAt(uint32_t column, uint32_t row) const {
    const size_t at = size_t{row} * frame_.width + column;
    const auto [x, z] =
        frame_.axes.placedSlope(slope(at, column, frame_.width, 1) / frame_.spacing_x,
                                slope(at, row, frame_.height, frame_.width) / frame_.spacing_y);
    const double length = std::hypot(x, 1, z);
    if (!std::isfinite(length)) return {0, 1, 0};
    return {-x / length, 1 / length, -z / length};
  }

 private:
  /// Metres a sample, between the neighbours that are no voids.
  double slope(size_t at, uint32_t place, uint32_t count, size_t stride) const {
    if (std::isnan(heights_[at])) return 0;
    const bool before = place > 0 && !std::isnan(heights_[at - stride]);
    const bool behind = place + 1 < count && !std::isnan(heights_[at + stride]);
    if (!before && !behind) return 0;
    const double rise =
        double{heights_[behind ? at + stride : at]} - heights_[before ? at - stride : at];
    return rise * frame_.metres_per_unit / (before && behind ? 2 : 1);
  }

  std::vector<float> heights_;
  PlacedFrame frame_;
};

Result<Slopes> slopesOf(Decoder& decoder, uint64_t copies) {
  const tks_info& info = decoder.info();
  if (!info.has_heights)
    return Status(TKS_USAGE, "the stream has no heights, so there are no normals");
  const uint64_t bytes = uint64_t{info.width} * info.height * sizeof(float);
  const auto fits = decoder.checkMemory(TKS_PART_HEIGHTS, nullptr, 0, bytes + copies);
  if (!fits) return fits.status();
  Result<std::vector<float>> heights = decoder.surface();
  if (!heights) return heights.status();
  return Slopes(std::move(*heights), frameOf(info));
}

std::byte asByte(double component) {
  return static_cast<std::byte>(std::lround((component + 1) / 2 * 255));
}

}  // namespace

uint32_t normalLevel(const tks_info& whole) {
  uint32_t level = 0;
  const auto samples = [&whole](uint32_t k) {
    const uint64_t last = (uint64_t{1} << k) - 1;
    return ((whole.width + last) >> k) * ((whole.height + last) >> k);
  };
  // Samples are found by their places on the raster.
  const uint32_t coarsest = whole.domain == TKS_DOMAIN_FOREST ? 0 : whole.coarsest_level;
  while (level < coarsest && samples(level) > kMaxNormalSamples) ++level;
  return level;
}

Result<std::vector<float>> surfaceNormals(Decoder& decoder, std::span<const uint32_t> samples) {
  const uint32_t width = decoder.info().width, level = normalLevel(decoder.info());
  if (const Status set = decoder.setLevels(level, 0); !set.ok()) return set;
  const uint32_t columns = decoder.info().width, rows = decoder.info().height;
  const Result<Slopes> slopes = slopesOf(decoder, 3 * sizeof(float) * samples.size());
  if (const Status set = decoder.setLevels(0, 0); !set.ok()) return set;
  if (!slopes.ok()) return slopes.status();
  std::vector<float> normals;
  normals.reserve(3 * samples.size());
  for (const uint32_t sample : samples) {
    const uint32_t column = std::min((sample % width) >> level, columns - 1);
    const uint32_t row = std::min((sample / width) >> level, rows - 1);
    for (const double component : slopes->normalAt(column, row))
      normals.push_back(static_cast<float>(component));
  }
  return normals;
}

Result<ImageFile> normalMap(Decoder& decoder, uint64_t copies) {
  const tks_info& info = decoder.info();
  const uint64_t texels = uint64_t{info.width} * info.height;
  const Result<Slopes> slopes = slopesOf(decoder, 3 * texels + copies);
  if (!slopes.ok()) return slopes.status();
  ImageFile map{info.width, info.height, 3, TKS_U8, {}};
  map.data.reserve(3 * texels);
  // Renderers take up to be perpendicular to right, on the side where rows are smaller.
  const std::array<double, 2>& right = slopes->axes().along;
  const double side = slopes->axes().mirrored() ? -1 : 1;
  const std::array<double, 2> up{right[1] * side, -right[0] * side};
  for (uint32_t row = 0; row < info.height; ++row) {
    for (uint32_t column = 0; column < info.width; ++column) {
      const auto [east, height, south] = slopes->normalAt(column, row);
      map.data.insert(map.data.end(), {asByte(east * right[0] + south * right[1]),
                                       asByte(east * up[0] + south * up[1]), asByte(height)});
    }
  }
  return map;
}

}  // namespace tetrakis::tools
