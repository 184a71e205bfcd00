// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/screen/surface_picture.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::inline screen {
namespace {

/// Pictures are drawn with no more pixels than this; larger ones at a half, a quarter ...
/// More pixels weigh details of pictures, and take time and memory.
constexpr uint64_t kMostPixels = uint64_t{1} << 21;
/// The unit of weights, and the least and the greatest weight in this unit. A larger least weight
/// keeps more triangles where no camera looks; beside weights above the greatest one others vanish.
constexpr double kUnit = 0x1p-10, kLeast = 16, kMost = 0x1p24;

ScreenView reduced(ScreenView view) {
  while (uint64_t{view.width} * view.height > kMostPixels) {
    view.width = (view.width + 1) / 2;
    view.height = (view.height + 1) / 2;
  }
  return view;
}

class ViewCosts {
 public:
  ViewCosts(const WeightedSurface& surface, const ScreenView& view, const GroundImage& image)
      : surface_(surface),
        project_(view),
        picture_(surface, view, image),
        has_image_(!image.empty()),
        share_(view.weight / static_cast<double>(std::max<size_t>(picture_.covered(), 1))) {}

  /// What an error of a known sample costs.
  double operator()(uint32_t column, uint32_t row) const {
    const ScreenPoint point = project_(column, row, heightAt(column, row));
    if (!picture_.shows(point)) return 0;
    const ScreenVector lift = project_.along(2, point);
    const double squared = lift.x * lift.x + lift.y * lift.y;
    const double pixels = pixelsOf(point, lift, column, row);
    if (!has_image_) return share_ * squared * std::min(pixels, 1.0);
    if (squared == 0) return 0;
    const double length = std::sqrt(squared), x = lift.x / length, y = lift.y / length;
    const double here = picture_.brightness(point.x, point.y);
    const double ahead = picture_.brightness(point.x + x, point.y + y) - here;
    const double behind = picture_.brightness(point.x - x, point.y - y) - here;
    return share_ * squared * pixels * 0.5 * (ahead * ahead + behind * behind);
  }

 private:
  double heightAt(uint32_t column, uint32_t row) const {
    return surface_.view.heights[size_t{row} * surface_.view.width + column];
  }
  bool isKnown(uint32_t column, uint32_t row) const {
    return surface_.isKnown(size_t{row} * surface_.view.width + column);
  }

  /// Area of the parallelogram of the surface's two axes on the screen.
  double pixelsOf(const ScreenPoint& point, const ScreenVector& lift, uint32_t column,
                  uint32_t row) const {
    const SurfaceView& grid = surface_.view;
    const uint32_t west = column - (column > 0), east = std::min(column + 1, grid.width - 1);
    const uint32_t north = row - (row > 0), south = std::min(row + 1, grid.height - 1);
    const double here = heightAt(column, row);
    const auto known = [&](uint32_t x, uint32_t y) {
      return isKnown(x, y) ? heightAt(x, y) : here;
    };
    const double across = (known(east, row) - known(west, row)) / (east - west);
    const double down = (known(column, south) - known(column, north)) / (south - north);
    const ScreenVector x = project_.along(0, point), y = project_.along(1, point);
    return std::abs((x.x + across * lift.x) * (y.y + down * lift.y) -
                    (x.y + across * lift.y) * (y.x + down * lift.x));
  }

  const WeightedSurface& surface_;
  ScreenProjection project_;
  SurfacePicture picture_;
  bool has_image_;
  double share_;
};

/// The mean cost of the known samples among the nine around one.
double meanAround(const WeightedSurface& surface, const std::vector<double>& costs, uint32_t column,
                  uint32_t row) {
  const SurfaceView& grid = surface.view;
  double sum = 0;
  int count = 0;
  for (uint32_t y = row - (row > 0); y <= std::min(row + 1, grid.height - 1); ++y)
    for (uint32_t x = column - (column > 0); x <= std::min(column + 1, grid.width - 1); ++x) {
      const size_t sample = size_t{y} * grid.width + x;
      if (!surface.isKnown(sample)) continue;
      sum += costs[sample];
      ++count;
    }
  return sum / count;
}

std::vector<float> roundedWeights(const WeightedSurface& surface,
                                  const std::vector<double>& costs) {
  const SurfaceView& grid = surface.view;
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < costs.size(); ++i) {
    if (!surface.isKnown(i)) continue;
    sum += costs[i];
    ++count;
  }
  std::vector<float> weights(costs.size(), 1.0f);
  if (!(sum > 0)) return weights;
  const double scale = static_cast<double>(count) / (sum * kUnit);
  for (uint32_t y = 0; y < grid.height; ++y)
    for (uint32_t x = 0; x < grid.width; ++x) {
      const size_t i = size_t{y} * grid.width + x;
      if (!surface.isKnown(i)) continue;
      const double units = std::floor(meanAround(surface, costs, x, y) * scale + 0.5);
      weights[i] = static_cast<float>(std::clamp(units, kLeast, kMost) * kUnit);
    }
  return weights;
}

}  // namespace

std::vector<float> screenWeights(const WeightedSurface& surface, std::span<const ScreenView> views,
                                 const GroundImage& image) {
  const SurfaceView& grid = surface.view;
  std::vector<double> costs(grid.heights.size());
  for (const ScreenView& given : views) {
    const ScreenView view = reduced(given);
    const ViewCosts cost(surface, view, image);
    for (uint32_t y = 0; y < grid.height; ++y)
      for (uint32_t x = 0; x < grid.width; ++x) {
        const size_t sample = size_t{y} * grid.width + x;
        if (surface.isKnown(sample)) costs[sample] += cost(x, y);
      }
  }
  return roundedWeights(surface, costs);
}

uint64_t screenWeightsBytes(uint64_t samples) {
  constexpr uint64_t kSample = sizeof(double) + sizeof(float);
  constexpr uint64_t kPixel = sizeof(float) + sizeof(uint8_t), kRows = 1 << 20;
  return kSample * samples + kPixel * kMostPixels + kRows;
}

}  // namespace tetrakis::inline screen
