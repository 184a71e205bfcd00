// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/mesh_colours.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::inline remesh {

std::array<double, 2> MeshColours::coordinates(const SurfacePoint& place) const {
  const TriangleSource& source = mesh_.sources[place.triangle];
  std::array<double, 2> sum{};
  for (size_t corner = 0; corner < 3; ++corner) {
    const float* const at = &texcoords_[2 * (3 * size_t{source.triangle} + source.corners[corner])];
    for (size_t axis = 0; axis < 2; ++axis) sum[axis] += place.weights[corner] * double{at[axis]};
  }
  return sum;
}

double MeshColours::shown() const {
  double doubled = 0;
  for (uint32_t t = 0; t < mesh_.sources.size(); ++t) {
    const auto a = coordinates({t, {1, 0, 0}}), b = coordinates({t, {0, 1, 0}}),
               c = coordinates({t, {0, 0, 1}});
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (std::isfinite(area)) doubled += std::abs(area);
  }
  return doubled / 2 * image_.width * image_.height;
}

double MeshColours::value(int64_t x, int64_t y, uint32_t channel) const {
  const auto wrapped = [](int64_t at, uint32_t size) {
    const int64_t rest = at % int64_t{size};
    return static_cast<size_t>(rest < 0 ? rest + size : rest);
  };
  const size_t texel = wrapped(y, image_.height) * image_.width + wrapped(x, image_.width);
  const size_t place = texel * image_.channels + channel;
  return image_.bytes.empty() ? image_.shorts[place] : image_.bytes[place];
}

void MeshColours::sample(const std::array<double, 2>& at, uint16_t* out) const {
  constexpr double kFarthest = 1e6;  // repeats of the image, beyond which doubles are too coarse
  const auto turned = [](double place) {
    return std::abs(place) <= kFarthest ? place : 0.0;  // 0 also if it is not a number
  };
  const double x = turned(at[0]) * image_.width - 0.5, y = turned(at[1]) * image_.height - 0.5;
  const double left = std::floor(x), top = std::floor(y), right = x - left, down = y - top;
  const auto column = static_cast<int64_t>(left), row = static_cast<int64_t>(top);
  for (uint32_t channel = 0; channel < image_.channels; ++channel) {
    const auto along = [&](int64_t y_at) {
      return (1 - right) * value(column, y_at, channel) + right * value(column + 1, y_at, channel);
    };
    out[channel] =
        static_cast<uint16_t>(std::floor((1 - down) * along(row) + down * along(row + 1) + 0.5));
  }
}

std::vector<uint16_t> MeshColours::at(std::span<const SurfacePoint> places) const {
  std::vector<uint16_t> texels(places.size() * image_.channels);
  for (size_t i = 0; i < places.size(); ++i)
    sample(coordinates(places[i]), &texels[i * image_.channels]);
  return texels;
}

}  // namespace tetrakis::inline remesh
