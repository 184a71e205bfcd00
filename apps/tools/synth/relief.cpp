// SPDX-License-Identifier: Apache-2.0
// From coarse to fine: mountains rise against erosion on a coarse raster until they are dissected;
// each finer raster adds detail and lets the rivers work again.
#include "apps/tools/synth/relief.hpp"

#include <map>

#include "apps/tools/synth/erosion.hpp"
#include "apps/tools/synth/layout.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr uint32_t kCoarsest = 160;  // largest side of the first raster

/// One raster of the pyramid: sample (x, y) stands at ((x, y) * stride - margin) of the terrain's.
struct Frame {
  uint32_t size, margin, stride;

  uint32_t side() const { return (size + 2 * margin - 2) / stride + 2; }
  Point samples(uint32_t x, uint32_t y) const {
    return {static_cast<double>(x) * stride - margin, static_cast<double>(y) * stride - margin};
  }
  Point share(uint32_t x, uint32_t y) const {
    const Point p = samples(x, y);
    return {p.x / (size - 1), p.y / (size - 1)};
  }
};

/// Metres from the sea to the summits: 10 % of a small terrain's extent, less of a large one's, and
/// within 16 bits.
double reliefOf(uint32_t size) {
  constexpr double kReference = 512 * kSpacing, kHigh = 1200, kHighest = 6000;
  const double ratio = (size - 1) * kSpacing / kReference;
  return std::min(kHighest, kHigh * (ratio < 1 ? ratio : std::sqrt(ratio)));
}

Raster<uint8_t> seaOf(const Layout& layout, const Frame& frame) {
  return rasterOf<uint8_t>(frame.side(), [&](uint32_t x, uint32_t y) {
    return uint8_t{layout.isSea(frame.share(x, y))};
  });
}

Grid upliftOf(const Layout& layout, const Frame& frame) {
  return rasterOf<double>(frame.side(),
                          [&](uint32_t x, uint32_t y) { return layout.uplift(frame.share(x, y)); });
}

void scaleAll(Grid& grid, double factor) {
  for (size_t cell = 0; cell < grid.size(); ++cell) grid[cell] *= factor;
}

void levelSea(Grid& height, const Raster<uint8_t>& sea) {
  for (size_t cell = 0; cell < height.size(); ++cell) {
    if (sea[cell]) height[cell] = 0;
  }
}

double highest(const Grid& grid) {
  double most = 0;
  for (size_t cell = 0; cell < grid.size(); ++cell) most = std::max(most, grid[cell]);
  return most;
}

/// Twice as fine, by the four-point rule (-1, 9, 9, -1) / 16 along rows, then columns.
Grid refine(const Grid& coarse, const Frame& fine) {
  const auto between = [](double a, double b, double c, double d) {
    return (9 * (b + c) - (a + d)) / 16;
  };
  const auto alongRow = [&](int64_t x, int64_t y) {
    const int64_t i = x / 2;
    if (x % 2 == 0) return coarse.clamped(i, y);
    return between(coarse.clamped(i - 1, y), coarse.clamped(i, y), coarse.clamped(i + 1, y),
                   coarse.clamped(i + 2, y));
  };
  return rasterOf<double>(fine.side(), [&](uint32_t x, uint32_t y) {
    const int64_t j = y / 2;
    if (y % 2 == 0) return alongRow(x, j);
    return between(alongRow(x, j - 1), alongRow(x, j), alongRow(x, j + 1), alongRow(x, j + 2));
  });
}

/// Noise at the scale of the raster, stronger on steep ground, as rock is rougher than meadow.
void roughen(Grid& height, const Frame& frame, const Layout& layout) {
  const double metres = kSpacing * frame.stride, wave = 3.1 * frame.stride;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const int64_t ix = x, iy = y;
    const double dx = height.clamped(ix + 1, iy) - height.clamped(ix - 1, iy);
    const double dy = height.clamped(ix, iy + 1) - height.clamped(ix, iy - 1);
    const double rise = std::sqrt(dx * dx + dy * dy) / 2;
    const Point p = frame.samples(x, y);
    const double n = fractal(layout.seed() + 50 + frame.stride, {p.x / wave, p.y / wave}, 2);
    return height.at(x, y) + n * (0.003 * metres + 0.55 * rise);
  });
}

Grid raiseMountains(const Layout& layout, const Frame& frame, double relief) {
  const Raster<uint8_t> sea = seaOf(layout, frame);
  const Grid uplift = upliftOf(layout, frame);
  Grid height = rasterOf<double>(frame.side(), [&](uint32_t x, uint32_t y) {
    return 0.02 * layout.inland(frame.share(x, y)) +
           0.01 * fractal(layout.seed() + 60, {0.3 * x, 0.3 * y}, 2);
  });
  levelSea(height, sea);
  erode(height, &uplift, sea, {60, 0.25, 0.08});
  const double most = highest(height);
  if (most > 0) scaleAll(height, relief / most);
  return height;
}

/// On finer rasters the land neither rises nor falls as a whole: uplift only makes up for erosion.
Grid carveDetail(Grid height, const Layout& layout, const Frame& frame) {
  const Raster<uint8_t> sea = seaOf(layout, frame);
  roughen(height, frame, layout);
  levelSea(height, sea);
  erode(height, nullptr, sea, {4, 0.012, 0.06});
  constexpr double kRepose = 0.8;  // tan 39 degrees
  slide(height, sea, kRepose * kSpacing * frame.stride, 12);
  return height;
}

Grid carve(const Layout& layout, uint32_t size, uint32_t margin) {
  uint32_t stride = 1;
  while (Frame{size, margin, stride}.side() > kCoarsest) stride *= 2;
  Grid height = raiseMountains(layout, {size, margin, stride}, reliefOf(size));
  height = carveDetail(std::move(height), layout, {size, margin, stride});
  while (stride > 1) {
    stride /= 2;
    const Frame frame{size, margin, stride};
    height = carveDetail(refine(height, frame), layout, frame);
  }
  return height;
}

/// A bowl is dug; the flood tells how high it fills before it spills over.
void digLake(Grid& height, const Layout& layout, const Frame& frame) {
  constexpr double kBend = 0.7 / 12;  // at most, as noise lies within -1 and 1
  const Point middle = layout.lake();
  const double depth = 0.07 * reliefOf(frame.size);
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = frame.share(x, y);
    if (std::abs(p.x - middle.x) > 0.085 + kBend || std::abs(p.y - middle.y) > 0.06 + kBend)
      return height.at(x, y);
    const Point bent = warp(layout.seed() + 70, {12 * p.x, 12 * p.y}, 0.7, 6);
    const double dx = (bent.x / 12 - middle.x) / 0.085, dy = (bent.y / 12 - middle.y) / 0.06;
    const double inside = 1 - dx * dx - dy * dy;
    return height.at(x, y) - depth * std::max(0.0, inside);
  });
}

/// Deep depressions hold lakes, each at one level; shallow ones have silted up.
void fillDepressions(Relief& relief, const Raster<uint8_t>& sea, double lake_depth) {
  const Grid level = drain(relief.height, sea).level;
  const auto depth = [&](size_t cell) { return level[cell] - relief.height[cell]; };
  std::map<double, double> deepest;  // by water level, which tells depressions apart
  for (size_t cell = 0; cell < level.size(); ++cell) {
    if (depth(cell) <= 0) continue;
    double& most = deepest[level[cell]];
    most = std::max(most, depth(cell));
  }
  for (size_t cell = 0; cell < level.size(); ++cell) {
    if (depth(cell) <= 0) continue;
    if (deepest[level[cell]] >= lake_depth) relief.cover[cell] = Cover::kLake;
    relief.height[cell] = level[cell];
  }
}

}  // namespace

void settle(Relief& relief, const Raster<uint8_t>& sea, double lake_depth) {
  relief.cover = Raster<Cover>(relief.height.side(), Cover::kLand);
  levelSea(relief.height, sea);
  fillDepressions(relief, sea, lake_depth);
  for (size_t cell = 0; cell < sea.size(); ++cell) {
    double steps = std::max(1.0, std::floor(relief.height[cell] / kHeightStep + 0.5));
    if (sea[cell]) {
      relief.cover[cell] = Cover::kSea;
      steps = 0;
    }
    relief.height[cell] = steps * kHeightStep;
  }
  relief.drainage = drain(relief.height, sea);
}

Relief makeRelief(uint32_t size, uint64_t seed) {
  const Layout layout(seed);
  const uint32_t margin = std::max(4u, size / 16);
  const Frame frame{size, margin, 1};
  Relief relief{
      .margin = margin, .height = carve(layout, size, margin), .cover = {}, .drainage = {}};
  digLake(relief.height, layout, frame);
  settle(relief, seaOf(layout, frame), 0.0125 * reliefOf(size));
  return relief;
}

}  // namespace tetrakis::tools::synth
