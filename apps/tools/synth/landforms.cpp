// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/synth/landforms.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "apps/tools/synth/parcels.hpp"

namespace tetrakis::tools::synth {

namespace {

constexpr double kLowland = 1200;  // metres to the summits that a plain does not have

Raster<uint8_t> coverIs(const Relief& relief, Cover kind) {
  return rasterOf<uint8_t>(relief.cover.side(), [&](uint32_t x, uint32_t y) {
    return uint8_t{relief.cover.at(x, y) == kind};
  });
}

/// Adds noise of `metres` with features of `wave` samples.
void addHills(const KindTask& task, double metres, double wave, int octaves) {
  Grid& height = task.relief.height;
  height = rasterOf<double>(height.side(), [&](uint32_t x, uint32_t y) {
    const Point p = task.samples(x, y);
    return height.at(x, y) + metres * fractal(task.seed, {p.x / wave, p.y / wave}, octaves);
  });
}

/// The parcel of a sample, at the scale of a town: houses of ten metres and more.
Parcel lotAt(const KindTask& task, uint32_t x, uint32_t y) {
  const Point p = task.samples(x, y);
  return parcelAt(task.seed, {12 * p.x, 12 * p.y});
}

/// Storeys of three metres; some parcels are parks, some houses are towers.
double roofHeight(uint64_t parcel) {
  const double lot = unitHash(parcel, 5, 0), storeys = unitHash(parcel, 5, 1);
  if (lot < 0.15) return 0;
  return 3 * std::floor(lot > 0.95 ? 8 + 10 * storeys : 1 + 5 * storeys);
}

}  // namespace

Storage drown(const KindTask& task) {
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

Storage fillHollows(const KindTask& task) {
  const Raster<uint8_t> sea = coverIs(task.relief, Cover::kSea);
  const double summit = task.summit();
  addHills(task, 0.12 * summit, std::min(40.0, 0.15 * task.size), 3);
  for (size_t cell = 0; cell < task.relief.height.size(); ++cell)
    task.relief.height[cell] = std::max(kHeightStep, task.relief.height[cell]);
  settle(task.relief, sea, 0.004 * summit);
  return {};
}

Storage flatten(const KindTask& task) {
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

Storage build(const KindTask& task) {
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

}  // namespace tetrakis::tools::synth
