// SPDX-License-Identifier: Apache-2.0
#include "bench/coding/globe_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace tetrakis::bench {
namespace {

constexpr tks_globe kEarth = {sizeof(tks_globe), 6378137, 6356752.314245, 1, 1};

/// A corner over the raster, (0, 0) the first sample, and its height.
struct Corner {
  double x, y, height;
};

class DrawnRaster {
 public:
  DrawnRaster(uint32_t width, uint32_t height)
      : width_(width), height_(height), surface_(size_t{width} * height) {}

  void draw(const std::array<Corner, 3>& t) {
    const double area = cross(t[0], t[1], t[2]);
    if (area == 0) return;
    const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
    const double last_row = std::min(std::floor(bottom), height_ - 1.0);
    for (double y = std::max(std::ceil(top), 0.0); y <= last_row; ++y) {
      const double last = std::min(std::floor(right), width_ - 1.0);
      for (double x = std::max(std::ceil(left), 0.0); x <= last; ++x) {
        const Corner at{x, y, 0};
        const double a = cross(at, t[1], t[2]) / area, b = cross(t[0], at, t[2]) / area;
        constexpr double kEdge = -1e-9;
        if (a < kEdge || b < kEdge || 1 - a - b < kEdge) continue;
        surface_[static_cast<size_t>(y) * width_ + static_cast<size_t>(x)] =
            static_cast<float>(a * t[0].height + b * t[1].height + (1 - a - b) * t[2].height);
      }
    }
  }
  std::vector<float> take() { return std::move(surface_); }

 private:
  static double cross(const Corner& a, const Corner& b, const Corner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

  uint32_t width_, height_;
  std::vector<float> surface_;
};

}  // namespace

Result<std::vector<float>> surfaceOfGlobe(Decoder& decoder, uint32_t triangles) {
  const Result<GlobeMesh> mesh = decoder.budgetGlobe(kEarth, triangles);
  if (!mesh.ok()) return mesh.status();
  DrawnRaster raster(decoder.info().width, decoder.info().height);
  for (size_t t = 0; t < mesh->triangles().size(); t += 3) {
    std::array<Corner, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      const size_t v = mesh->triangles()[t + k];
      corners[k] = {mesh->pixels()[2 * v] - 0.5, mesh->pixels()[2 * v + 1] - 0.5,
                    mesh->heights()[v]};
    }
    raster.draw(corners);
  }
  return raster.take();
}

}  // namespace tetrakis::bench
