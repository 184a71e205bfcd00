// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/sample_surface.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/samples.hpp"

namespace tetrakis::tools {
namespace {

template <class T>
void appendSamples(std::span<const std::byte> data, std::vector<double>& values) {
  for (size_t i = 0; i + sizeof(T) <= data.size(); i += sizeof(T)) {
    T sample;
    std::memcpy(&sample, data.data() + i, sizeof(T));
    values.push_back(static_cast<double>(sample));
  }
}

struct Corner {
  int64_t x, y;
  double height;
};

/// Twice the signed area of (a, b, (x, y)).
int64_t doubleArea(const Corner& a, const Corner& b, int64_t x, int64_t y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

void rasterizeTriangle(const Corner& a, const Corner& b, const Corner& c, Surface& surface) {
  const int64_t area = doubleArea(a, b, c.x, c.y);
  if (area == 0) return;
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const int64_t sign = area < 0 ? -1 : 1;
  for (int64_t y = top; y <= bottom; ++y)
    for (int64_t x = left; x <= right; ++x) {
      const int64_t wa = sign * doubleArea(b, c, x, y);
      const int64_t wb = sign * doubleArea(c, a, x, y);
      const int64_t wc = sign * doubleArea(a, b, x, y);
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double sum = static_cast<double>(wa) * a.height + static_cast<double>(wb) * b.height +
                         static_cast<double>(wc) * c.height;
      surface.values[static_cast<size_t>(y) * surface.width + static_cast<size_t>(x)] =
          sum / static_cast<double>(sign * area);
    }
}

}  // namespace

Surface samplesOf(uint32_t width, uint32_t height, tks_sample sample,
                  std::span<const std::byte> data) {
  Surface surface{width, height, {}};
  surface.values.reserve(size_t{width} * height);
  withSampleType(sample, [&]<class T>(T) { appendSamples<T>(data, surface.values); });
  return surface;
}

Surface heightsOf(const HeightFile& file) {
  Surface surface = samplesOf(file.width, file.height, file.sample, file.data);
  for (double& value : surface.values) {
    const bool is_void = file.nodata && value == *file.nodata;
    value = is_void ? std::numeric_limits<double>::quiet_NaN() : value * file.scale + file.offset;
  }
  return surface;
}

Surface rasterize(const Mesh& mesh, uint32_t width, uint32_t height) {
  constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();
  Surface surface{width, height, std::vector<double>(size_t{width} * height, kVoid)};
  const auto corner = [&](uint32_t vertex) {
    const uint32_t index = mesh.gridIndices()[vertex];
    return Corner{index % width, index / width, mesh.heights()[vertex]};
  };
  const std::span<const uint32_t> triangles = mesh.triangles();
  for (size_t t = 0; t < triangles.size(); t += 3)
    rasterizeTriangle(corner(triangles[t]), corner(triangles[t + 1]), corner(triangles[t + 2]),
                      surface);
  return surface;
}

}  // namespace tetrakis::tools
