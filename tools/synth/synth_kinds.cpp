// SPDX-License-Identifier: Apache-2.0
// Each kind is a small change of the mountains that brings out one trait of real terrain models.
#include "tools/synth/synth_kinds.hpp"

#include <unordered_map>

#include "tools/synth/synth_parcels.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr double kLowland = 1200;  // metres to the summits that a plain does not have

/// What all kinds are made from.
struct Task {
  Relief& relief;
  uint32_t size;
  uint64_t seed;

  /// A place in samples, from the terrain's north-western corner.
  Point samples(uint32_t x, uint32_t y) const {
    return {static_cast<double>(x) - relief.margin, static_cast<double>(y) - relief.margin};
  }
  double summit() const { return *std::max_element(relief.height.begin(), relief.height.end()); }
};

Raster<uint8_t> coverIs(const Relief& relief, Cover kind) {
  return rasterOf<uint8_t>(relief.cover.side(), [&](uint32_t x, uint32_t y) {
    return uint8_t{relief.cover.at(x, y) == kind};
  });
}

/// Adds noise of `metres` with features of `wave` samples.
void addHills(const Task& task, double metres, double wave, int octaves) {
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = task.samples(x, y);
    return height.at(x, y) + metres * fractal(task.seed, {p.x / wave, p.y / wave}, octaves);
  });
}

/// The sea rises until it covers half: valleys become bays, hills islands.
Storage drown(const Task& task) {
  Grid& height = task.relief.height;
  const double summit = task.summit();
  addHills(task, 0.25 * summit, 0.12 * task.size, 6);
  std::vector<double> inside;
  inside.reserve(size_t{task.size} * task.size);
  for (uint32_t y = 0; y < task.size; ++y)
    for (uint32_t x = 0; x < task.size; ++x)
      inside.push_back(height.at(x + task.relief.margin, y + task.relief.margin));
  const auto middle = inside.begin() + static_cast<ptrdiff_t>(inside.size() / 2);
  std::nth_element(inside.begin(), middle, inside.end());
  const double level = *middle;
  height = rasterOf<double>(height.side(),
                            [&](uint32_t x, uint32_t y) { return height.at(x, y) - level; });
  const Raster<uint8_t> sea = rasterOf<uint8_t>(
      height.side(), [&](uint32_t x, uint32_t y) { return uint8_t{height.at(x, y) < 0}; });
  settle(task.relief, sea, 0.02 * summit);
  return {};
}

/// Hollows as ice leaves them, each full of water.
Storage fillHollows(const Task& task) {
  const Raster<uint8_t> sea = coverIs(task.relief, Cover::kSea);
  const double summit = task.summit();
  addHills(task, 0.12 * summit, std::min(40.0, 0.15 * task.size), 3);
  for (size_t cell = 0; cell < task.relief.height.size(); ++cell)
    task.relief.height[cell] = std::max(kHeightStep, task.relief.height[cell]);
  settle(task.relief, sea, 0.004 * summit);
  return {};
}

/// Whole tens of feet, in metres.
Storage quantise(const Task& task) {
  constexpr double kTenFeet = 3.048;
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    return kTenFeet * std::floor(height.at(x, y) / kTenFeet + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

/// Layers of equal height, as maps tint them.
Storage layer(const Task& task) {
  constexpr double kLayer = 100;
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    return kLayer * std::floor(height.at(x, y) / kLayer);
  });
  return {};
}

/// Whole metres above the sea, which someone has moved to heights above the ellipsoid.
Storage raise(const Task& task) {
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = task.samples(x, y);
    const double geoid = 47.3 + 0.0021 * p.x - 0.0013 * p.y + 1.7e-6 * p.x * p.y;
    return geoid + std::floor(height.at(x, y) + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

/// Patches of two surveys: one in whole metres, one that knows more.
Storage join(const Task& task) {
  const double extent = task.size - 1;
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = task.samples(x, y);
    const double patch = fractal(task.seed + 20, {4 * p.x / extent, 4 * p.y / extent}, 3);
    return patch > 0 ? height.at(x, y) : std::floor(height.at(x, y) + 0.5);
  });
  return {.sample = TKS_F32, .step = 1, .voids = {}};
}

/// What is left of a map of 8 bits, stretched to its range and then to metres with three decimals;
/// the samples that an editor has interpolated lie between its values.
Storage rescale(const Task& task) {
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

/// A scene that a satellite took at an angle, with clouds and with shadows of the radar on slopes.
Storage pierce(const Task& task) {
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

/// Nearest neighbours of a coarser grid that lies at an angle: what warping a map without
/// interpolation leaves.
Storage turn(const Task& task) {
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

/// Triangles between the points of a coarse grid that does not meet the samples.
Storage triangulate(const Task& task) {
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

/// Means of `reach` samples to either side along rows or columns.
Grid meansOf(const Grid& grid, int64_t reach, bool along_rows) {
  return rasterOf<double>(grid.side(), [&](uint32_t x, uint32_t y) {
    double sum = 0;
    for (int64_t k = -reach; k <= reach; ++k)
      sum += along_rows ? grid.clamped(x + k, y) : grid.clamped(x, y + k);
    return sum / static_cast<double>(2 * reach + 1);
  });
}

/// What a wide filter leaves of the mountains, in centimetres: means of means of means.
Storage smoothen(const Task& task) {
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

/// Some metres of relief in all, under the noise of a scanner.
Storage flatten(const Task& task) {
  Relief& relief = task.relief;
  relief.height = rasterOf<double>(relief.height.side(), [&](uint32_t x, uint32_t y) {
    const double noise = unitHash(task.seed, x, y) + unitHash(task.seed + 1, x, y) - 1;
    return 20 + 0.002 * relief.height.at(x, y) + 0.05 * noise;
  });
  relief.summit = kLowland;
  relief.cover = Raster<Cover>(relief.height.side(), Cover::kLand);
  relief.drainage = drain(relief.height, Raster<uint8_t>(relief.height.side()));
  return {.sample = TKS_U16, .step = 0.01, .voids = {}};
}

/// The parcel of a sample, at the scale of a town: houses of ten metres and more.
Parcel lotAt(const Task& task, uint32_t x, uint32_t y) {
  const Point p = task.samples(x, y);
  return parcelAt(task.seed, {12 * p.x, 12 * p.y});
}

/// Storeys of three metres; some parcels are parks, some houses are towers.
double roofHeight(uint64_t parcel) {
  const double lot = unitHash(parcel, 5, 0), storeys = unitHash(parcel, 5, 1);
  if (lot < 0.15) return 0;
  return 3 * std::floor(lot > 0.95 ? 8 + 10 * storeys : 1 + 5 * storeys);
}

/// What a laser sees first, a metre apart: roofs, flat above the highest ground below them.
Storage build(const Task& task) {
  constexpr double kYard = 24;  // of the parcel's metres, twelve a sample
  Relief& relief = task.relief;
  relief.spacing = 1;
  relief.summit = kLowland;
  Grid ground = rasterOf<double>(relief.height.side(), [&](uint32_t x, uint32_t y) {
    return kHeightStep * std::floor(5 + 0.008 * relief.height.at(x, y) / kHeightStep);
  });
  const uint32_t side = ground.side();
  Raster<uint64_t> house = rasterOf<uint64_t>(side, [&](uint32_t x, uint32_t y) {
    const Parcel lot = lotAt(task, x, y);
    return lot.edge > kYard && roofHeight(lot.id) > 0 ? lot.id | 1 : 0;
  });
  std::unordered_map<uint64_t, double> highest;
  for (size_t cell = 0; cell < house.size(); ++cell) {
    if (!house[cell]) continue;
    double& most = highest[house[cell]];
    most = std::max(most, ground[cell]);
  }
  relief.cover = Raster<Cover>(side, Cover::kLand);
  for (size_t cell = 0; cell < house.size(); ++cell) {
    if (!house[cell]) continue;
    relief.cover[cell] = Cover::kRoof;
    ground[cell] = highest[house[cell]] + roofHeight(house[cell]);
  }
  relief.height = std::move(ground);
  relief.drainage = {Raster<uint32_t>(side), {}, Raster<uint32_t>(side, 1)};  // no rivers
  return {};
}

}  // namespace

Storage reshape(Relief& relief, SynthKind kind, uint32_t size, uint64_t seed) {
  const Task task{relief, size, hash(seed, 6, 0)};
  switch (kind) {
    case SynthKind::kMountains:
      return {};
    case SynthKind::kCoast:
      return drown(task);
    case SynthKind::kLakes:
      return fillHollows(task);
    case SynthKind::kSteps:
      return quantise(task);
    case SynthKind::kVoids:
      return pierce(task);
    case SynthKind::kPlain:
      return flatten(task);
    case SynthKind::kCity:
      return build(task);
    case SynthKind::kRescaled:
      return rescale(task);
    case SynthKind::kBands:
      return layer(task);
    case SynthKind::kGeoid:
      return raise(task);
    case SynthKind::kMosaic:
      return join(task);
    case SynthKind::kTurned:
      return turn(task);
    case SynthKind::kFacets:
      return triangulate(task);
    case SynthKind::kSmooth:
      return smoothen(task);
  }
  return {};
}

}  // namespace tetrakis::tools::synth
