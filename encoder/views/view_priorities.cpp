// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/view_inputs.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/pictures/picture_errors.hpp"

namespace tetrakis::inline views {

namespace {

/// Pixels of all pictures: some hundreds for each tile. Half of them cost baviaanskloof 0.04 dB;
/// more of them take time.
constexpr size_t kMapPixels = 1 << 16;
/// A typical error of heights, as a share of their range: that of streams of 16 to 64 kB. A larger
/// error suits the priorities to shorter streams.
constexpr double kTypicalError = 0.005;
/// The share of the computed priorities that heights get. A pixel is off as its texels are,
/// whatever the size of their errors. Errors of heights cost in proportion to their squares only as
/// long as they move the texture by less than the width of its details: the cost of one size of
/// errors promises twice the gain that there is (docs/EXPERIMENTS.md).
constexpr double kFullOfHeights = 0.5;
/// Tiles along a side, of a power of two samples. Smaller tiles fit the view better, but take
/// bytes, and coefficients are coded worse where neighbours have another priority.
constexpr uint32_t kMostTiles = 24;

PriorityMap tilesOf(Extent plane) {
  PriorityMap map{plane, PriorityHeader::kLeastTileLog2, {}};
  while (std::max(map.columns(), map.rows()) > kMostTiles) ++map.tile_log2;
  return map;
}

/// The costs of errors in each tile, from their costs at points of the ground.
class TileWorths {
 public:
  /// grid: the grid in which the points are given.
  TileWorths(Extent grid, Extent plane) : grid_(grid), map_(tilesOf(plane)) {
    worths_.resize(size_t{map_.columns()} * map_.rows());
  }

  void add(double column, double row, double worth) {
    const size_t x = tileAt(column, grid_.width, map_.plane.width);
    const size_t y = tileAt(row, grid_.height, map_.plane.height);
    worths_[y * map_.columns() + x] += worth;
  }

  /// A bit-plane takes three quarters off squared errors: a tile where a squared error costs four
  /// times as much has `full` = 1 more, if the costs hold for errors of all sizes.
  PriorityMap map(double full) && {
    const std::vector<double> densities = perSample();
    const double most = *std::max_element(densities.begin(), densities.end());
    if (!(most > 0)) return {};
    constexpr double kTop = kPriorities - 1;
    for (const double density : densities) {
      const double wanted = density > 0 ? kTop + full * portable::log2(density / most) / 2 : 0;
      map_.priorities.push_back(static_cast<uint8_t>(std::clamp(std::round(wanted), 0.0, kTop)));
    }
    const auto ends = std::minmax_element(map_.priorities.begin(), map_.priorities.end());
    const uint8_t least = *ends.first;
    if (least == *ends.second) return {};
    for (uint8_t& p : map_.priorities) p = static_cast<uint8_t>(p - least);
    return std::move(map_);
  }

 private:
  size_t tileAt(double place, uint32_t grid, uint32_t side) const {
    const double sample = std::clamp(place / (grid - 1.0) * side, 0.0, side - 1.0);
    return static_cast<uint32_t>(sample) >> map_.tile_log2;
  }

  /// Few points fall on a tile that the border cuts: it counts as a quarter tile at least.
  std::vector<double> perSample() const {
    const double edge = std::ldexp(1, map_.tile_log2);
    std::vector<double> densities;
    for (uint32_t y = 0; y < map_.rows(); ++y) {
      for (uint32_t x = 0; x < map_.columns(); ++x) {
        const double width = std::min(edge, map_.plane.width - edge * x);
        const double height = std::min(edge, map_.plane.height - edge * y);
        const double samples = std::max(width * height, edge * edge / 4);
        densities.push_back(worths_[densities.size()] / samples);
      }
    }
    return densities;
  }

  Extent grid_;
  PriorityMap map_;
  std::vector<double> worths_;
};

}  // namespace

Priorities viewPriorities(const EncodeInputs& inputs) {
  assert(inputs.heights != nullptr && inputs.image != nullptr);
  const tks_encode_options& options = inputs.options;
  if (options.camera_count == 0 || inputs.heights->domain == TKS_DOMAIN_FOREST) return {};
  const Result<std::vector<uint8_t>> valid = findVoids(*inputs.heights);
  if (!valid.ok()) return {};
  const tks_heights& heights = *inputs.heights;
  const GroundRays ground(reliefOf(heights, heights.data, *valid));
  const std::shared_ptr<const TextureSource> source = quantiseTexture(*inputs.image);
  const Extent texels = source->texels.extent();
  const double range = ground.bounds().high[1] - ground.bounds().low[1];
  const ScreenTexture texture(source->texels, texels);
  const Extent grid{heights.width, heights.height};
  TileWorths of_heights(grid, grid), of_texture(grid, texels);
  const ScreenPoints points(givenCameras(options), kMapPixels);
  for (const auto& worth : points.worthsOf({ground, texture, kTypicalError * range}, texels)) {
    of_heights.add(worth.column, worth.row, worth.heights);
    of_texture.add(worth.column, worth.row, worth.texture);
  }
  return {std::move(of_heights).map(kFullOfHeights), std::move(of_texture).map(1)};
}

}  // namespace tetrakis::inline views
