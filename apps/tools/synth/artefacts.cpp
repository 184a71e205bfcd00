// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/synth/artefacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetrakis::tools::synth {

namespace {

/// Means of `reach` samples to either side along rows or columns.
Grid meansOf(const Grid& grid, int64_t reach, bool along_rows) {
  return rasterOf<double>(grid.side(), [&](uint32_t x, uint32_t y) {
    double sum = 0;
    for (int64_t k = -reach; k <= reach; ++k)
      sum += along_rows ? grid.clamped(x + k, y) : grid.clamped(x, y + k);
    return sum / static_cast<double>(2 * reach + 1);
  });
}

}  // namespace

Storage quantise(const KindTask& task) {
  constexpr double kTenFeet = 3.048;
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    return kTenFeet * std::floor(height.at(x, y) / kTenFeet + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

Storage layer(const KindTask& task) {
  constexpr double kLayer = 100;
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    return kLayer * std::floor(height.at(x, y) / kLayer);
  });
  return {};
}

Storage raise(const KindTask& task) {
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = task.samples(x, y);
    const double geoid = 47.3 + 0.0021 * p.x - 0.0013 * p.y + 1.7e-6 * p.x * p.y;
    return geoid + std::floor(height.at(x, y) + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

Storage join(const KindTask& task) {
  const double extent = task.size - 1;
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = task.samples(x, y);
    const double patch = fractal(task.seed + 20, {4 * p.x / extent, 4 * p.y / extent}, 3);
    return patch > 0 ? height.at(x, y) : std::floor(height.at(x, y) + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

Storage rescale(const KindTask& task) {
  constexpr double kGrey = 255, kMillimetre = 1e-3;
  const double range = std::max(task.summit(), 1.0);
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const bool edited = unitHash(task.seed + 2, x, y) < 0.004;
    const double grey = kGrey * height.at(x, y) / range;
    const double metres = (edited ? grey : std::floor(grey + 0.5)) * range / kGrey;
    return kMillimetre * std::floor(metres / kMillimetre + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

Storage pierce(const KindTask& task) {
  const double extent = task.size - 1, margin = 0.03;
  const Relief& relief = task.relief;
  Raster<uint8_t> voids = rasterOf<uint8_t>(relief.height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = task.samples(x, y), q{p.x / extent - 0.5, p.y / extent - 0.5};
    const double fray = 0.02 * fractal(task.seed, {40 * q.x, 40 * q.y}, 4);
    const double east = std::abs(0.96 * q.x - 0.28 * q.y),
                 south = std::abs(0.28 * q.x + 0.96 * q.y);
    const bool outside = std::max(east, south) + fray > 0.5 - margin;
    const bool cloud = fractal(task.seed + 10, {7 * q.x, 7 * q.y}, 5) > 0.33;
    const int64_t ix = x, iy = y;
    const double fall =
        (relief.height.clamped(ix, iy) - relief.height.clamped(ix + 1, iy)) / kSpacing;
    return uint8_t{outside || cloud || fall > 0.62};
  });
  const uint32_t middle = task.size / 2 + relief.margin;
  voids.at(middle, middle) = 0;
  return {.sample = TKS_F32, .step = 1, .voids = std::move(voids)};
}

Storage turn(const KindTask& task) {
  constexpr double kCosine = 12. / 13, kSine = 5. / 13, kCoarse = 1.6;  // of its own samples
  const Grid before = task.relief.height;
  const double middle = before.side() / 2.;
  task.relief.height = rasterOf<double>(before.side(), [&](uint32_t x, uint32_t y) {
    const double dx = x - middle, dy = y - middle;
    const double u = std::floor((kCosine * dx + kSine * dy) / kCoarse);
    const double v = std::floor((kCosine * dy - kSine * dx) / kCoarse);
    return before.clamped(
        static_cast<int64_t>(std::floor(middle + kCoarse * (kCosine * u - kSine * v))),
        static_cast<int64_t>(std::floor(middle + kCoarse * (kSine * u + kCosine * v))));
  });
  return {.sample = TKS_U16, .step = 1, .voids = {}};
}

Storage triangulate(const KindTask& task) {
  constexpr double kApart = 11.3;  // points
  const Grid before = task.relief.height;
  task.relief.height = rasterOf<double>(before.side(), [&](uint32_t x, uint32_t y) {
    const double u = x / kApart, v = y / kApart;
    const double column = std::floor(u), row = std::floor(v), a = u - column, b = v - row;
    const auto point = [&](double right, double down) {
      return before.clamped(static_cast<int64_t>((column + right) * kApart),
                            static_cast<int64_t>((row + down) * kApart));
    };
    const double first = point(0, 0), last = point(1, 1);
    const double corner = a > b ? point(1, 0) : point(0, 1);
    return a > b ? first + a * (corner - first) + b * (last - corner)
                 : first + b * (corner - first) + a * (last - corner);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

Storage smoothen(const KindTask& task) {
  constexpr int64_t kReach = 8;
  constexpr double kCentimetre = 1e-2;
  Grid& height = task.relief.height;
  for (int pass = 0; pass < 3; ++pass)
    height = meansOf(meansOf(height, kReach, true), kReach, false);
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    return kCentimetre * std::floor(height.at(x, y) / kCentimetre + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

}  // namespace tetrakis::tools::synth
