// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/screen/surface_picture.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace tetrakis::inline screen {
namespace {

constexpr uint8_t kSky = 255;  // pale, as viewers draw it
/// Pixels that all triangles of a picture may cover, for each of its pixels and for each sample: a
/// mountain before others takes two or three. Larger numbers draw finer triangles, and take time.
constexpr double kOfPixels = 32, kOfSamples = 4;
/// The nearness over that of the picture from which on a point is seen. A smaller number sees
/// points behind ridges, a larger one misses points of slopes.
constexpr double kBehind = 1 - 0x1p-11;

/// Sum of a row of a matrix times (column, row, height, 1).
double dotRow(const std::array<double, 16>& m, size_t row, double x, double y, double z) {
  return m[4 * row] * x + m[4 * row + 1] * y + m[4 * row + 2] * z + m[4 * row + 3];
}

/// Between the four values around (x, y), whose integer coordinates are the middles of values.
double bilinear(const std::vector<uint8_t>& values, uint32_t width, uint32_t height, double x,
                double y) {
  x = std::clamp(x, 0.0, width - 1.0);
  y = std::clamp(y, 0.0, height - 1.0);
  const auto left = static_cast<uint32_t>(x), top = static_cast<uint32_t>(y);
  const uint32_t right = std::min(left + 1, width - 1), bottom = std::min(top + 1, height - 1);
  const double u = x - left, v = y - top;
  const auto value = [&](uint32_t column, uint32_t row) {
    return static_cast<double>(values[size_t{row} * width + column]);
  };
  const double above = value(left, top) + u * (value(right, top) - value(left, top));
  const double below = value(left, bottom) + u * (value(right, bottom) - value(left, bottom));
  return above + v * (below - above);
}

/// Every stride-th of the lines of a side, and the last.
std::vector<uint32_t> linesOf(uint32_t side, uint32_t stride) {
  std::vector<uint32_t> lines;
  for (uint64_t line = 0; line + 1 < side; line += stride)
    lines.push_back(static_cast<uint32_t>(line));
  lines.push_back(side - 1);
  return lines;
}

/// Twice the signed area.
double spanned(const ScreenPoint& a, const ScreenPoint& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

ScreenPoint ScreenProjection::operator()(double column, double row, double height) const {
  constexpr double kFar = 0x1p20;  // pixels beside the picture
  const double w = dotRow(view_.clip, 3, column, row, height);
  if (!(w > 0)) return {};
  const ScreenPoint point = {
      (dotRow(view_.clip, 0, column, row, height) / w + 1) * 0.5 * view_.width,
      (1 - dotRow(view_.clip, 1, column, row, height) / w) * 0.5 * view_.height, 1 / w};
  const auto near = [](double v) { return v > -kFar && v < kFar; };
  return near(point.x) && near(point.y) && point.nearness < kFar * kFar ? point : ScreenPoint();
}

ScreenVector ScreenProjection::along(size_t axis, const ScreenPoint& p) const {
  const std::array<double, 16>& m = view_.clip;
  const double x = 2 * p.x / view_.width - 1, y = 1 - 2 * p.y / view_.height;
  return {(m[axis] - x * m[12 + axis]) * p.nearness * 0.5 * view_.width,
          -(m[4 + axis] - y * m[12 + axis]) * p.nearness * 0.5 * view_.height};
}

GroundImage::GroundImage(uint32_t width, uint32_t height, std::vector<uint8_t> texels) {
  assert(texels.size() == size_t{width} * height && !texels.empty());
  levels_.push_back({width, height, std::move(texels)});
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level half{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    half.texels.reserve(size_t{half.width} * half.height);
    for (uint32_t y = 0; y < half.height; ++y)
      for (uint32_t x = 0; x < half.width; ++x) {
        const auto texel = [&](uint32_t column, uint32_t row) -> uint32_t {
          return fine.texels[size_t{std::min(row, fine.height - 1)} * fine.width +
                             std::min(column, fine.width - 1)];
        };
        const uint32_t sum = texel(2 * x, 2 * y) + texel(2 * x + 1, 2 * y) +
                             texel(2 * x, 2 * y + 1) + texel(2 * x + 1, 2 * y + 1);
        half.texels.push_back(static_cast<uint8_t>((sum + 2) / 4));
      }
    levels_.push_back(std::move(half));
  }
}

double GroundImage::at(double x, double y, double texels_a_pixel) const {
  size_t k = 0;
  for (; texels_a_pixel >= 4 && k + 1 < levels_.size(); ++k) texels_a_pixel *= 0.25;
  const Level& level = levels_[k];
  return bilinear(level.texels, level.width, level.height, x * level.width - 0.5,
                  y * level.height - 0.5);
}

SurfacePicture::SurfacePicture(const WeightedSurface& surface, const ScreenView& view,
                               const GroundImage& image)
    : width_(view.width),
      height_(view.height),
      last_column_(surface.view.width - 1.0),
      last_row_(surface.view.height - 1.0),
      nearness_(size_t{width_} * height_),
      brightness_(nearness_.size(), kSky) {
  forEachTriangle(surface, view, strideOf(surface, view),
                  [&](const Corners& corners) { draw(corners, image); });
  covered_ =
      nearness_.size() - static_cast<size_t>(std::count(nearness_.begin(), nearness_.end(), 0.0f));
}

/// The diagonals are those of the full 4-8 mesh.
template <class See>
void SurfacePicture::forEachTriangle(const WeightedSurface& surface, const ScreenView& view,
                                     uint32_t stride, See&& see) const {
  const ScreenProjection project(view);
  const SurfaceView& grid = surface.view;
  const std::vector<uint32_t> columns = linesOf(grid.width, stride);
  const std::vector<uint32_t> rows = linesOf(grid.height, stride);
  const auto see_known = [&](const Corners& corners) {
    const auto known = [](const Corner& corner) { return corner.screen.nearness != 0; };
    if (std::all_of(corners.begin(), corners.end(), known)) see(corners);
  };
  std::vector<Corner> above, below;
  for (size_t y = 0; y < rows.size(); ++y) {
    below.clear();
    for (const uint32_t column : columns) {
      const size_t sample = size_t{rows[y]} * grid.width + column;
      const bool known = surface.isKnown(sample);
      below.push_back({known ? project(column, rows[y], grid.heights[sample]) : ScreenPoint(),
                       static_cast<double>(column), static_cast<double>(rows[y])});
    }
    for (size_t x = 0; y > 0 && x + 1 < columns.size(); ++x) {
      const Corner &nw = above[x], &ne = above[x + 1], &sw = below[x], &se = below[x + 1];
      const bool falls = (y - 1 + x) % 2 == 0;
      see_known({nw, sw, falls ? se : ne});
      see_known({falls ? nw : ne, falls ? se : sw, falls ? ne : se});
    }
    std::swap(above, below);
  }
}

uint32_t SurfacePicture::strideOf(const WeightedSurface& surface, const ScreenView& view) const {
  const double most = kOfPixels * static_cast<double>(nearness_.size()) +
                      kOfSamples * static_cast<double>(surface.view.heights.size());
  const uint32_t longest = std::max(surface.view.width, surface.view.height);
  uint32_t stride = 1;
  for (; stride < longest; stride *= 2) {
    double pixels = 0;
    forEachTriangle(surface, view, stride,
                    [&](const Corners& corners) { pixels += boxOf(corners).pixels(); });
    if (pixels <= most) break;
  }
  return stride;
}

double SurfacePicture::Box::pixels() const {
  return std::max(right - left + 1, 0.0) * std::max(bottom - top + 1, 0.0);
}

SurfacePicture::Box SurfacePicture::boxOf(const Corners& corners) const {
  const ScreenPoint &a = corners[0].screen, &b = corners[1].screen, &c = corners[2].screen;
  const auto first = [](double v) { return std::max(0.0, std::ceil(v - 0.5)); };
  const auto last = [](double v, uint32_t side) {
    return std::min(side - 1.0, std::floor(v - 0.5));
  };
  return {first(std::min({a.x, b.x, c.x})), first(std::min({a.y, b.y, c.y})),
          last(std::max({a.x, b.x, c.x}), width_), last(std::max({a.y, b.y, c.y}), height_)};
}

/// Pixels whose middle lies in the triangle. Columns, rows and nearness times these are linear on
/// the screen.
void SurfacePicture::draw(const Corners& corners, const GroundImage& image) {
  const ScreenPoint &a = corners[0].screen, &b = corners[1].screen, &c = corners[2].screen;
  const double area = spanned(a, b, c.x, c.y);
  if (area == 0) return;
  const auto [left, top, right, bottom] = boxOf(corners);
  const double cells = last_column_ * last_row_;
  const double texels = image.empty() ? 0 : image.texels() / cells / std::abs(area);
  const double scale = 1 / area;
  for (double y = top; y <= bottom; ++y)
    for (double x = left; x <= right; ++x) {
      const double u = spanned(b, c, x + 0.5, y + 0.5) * scale * a.nearness;
      const double v = spanned(c, a, x + 0.5, y + 0.5) * scale * b.nearness;
      const double t = spanned(a, b, x + 0.5, y + 0.5) * scale * c.nearness;
      if (u < 0 || v < 0 || t < 0) continue;
      const double nearness = u + v + t;
      const size_t pixel = static_cast<size_t>(y) * width_ + static_cast<size_t>(x);
      if (!(nearness > nearness_[pixel])) continue;
      nearness_[pixel] = static_cast<float>(nearness);
      if (image.empty()) {
        brightness_[pixel] = 0;
        continue;
      }
      const double column = u * corners[0].column + v * corners[1].column + t * corners[2].column;
      const double row = u * corners[0].row + v * corners[1].row + t * corners[2].row;
      brightness_[pixel] = static_cast<uint8_t>(
          image.at(column / nearness / last_column_, row / nearness / last_row_, texels) + 0.5);
    }
}

bool SurfacePicture::shows(const ScreenPoint& point) const {
  if (point.nearness == 0 || point.x < 0 || point.y < 0 || point.x >= width_ || point.y >= height_)
    return false;
  const auto x = static_cast<uint32_t>(point.x), y = static_cast<uint32_t>(point.y);
  for (uint32_t row = y - (y > 0); row <= std::min(y + 1, height_ - 1); ++row)
    for (uint32_t column = x - (x > 0); column <= std::min(x + 1, width_ - 1); ++column)
      if (point.nearness >= kBehind * nearness_[size_t{row} * width_ + column]) return true;
  return false;
}

double SurfacePicture::brightness(double x, double y) const {
  return bilinear(brightness_, width_, height_, x - 0.5, y - 0.5);
}

}  // namespace tetrakis::inline screen
