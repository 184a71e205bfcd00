// SPDX-License-Identifier: Apache-2.0
#include "bench/reproduction/forest_terrain.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace tetrakis::bench {

namespace {

constexpr int kOctaves = 11;

/// -1 to 1, by a mix of the bits of the place (the finaliser of MurmurHash3).
double valueAt(int64_t x, int64_t y, int64_t z) {
  auto bits = static_cast<uint64_t>(x * 73856093 ^ y * 19349663 ^ z * 83492791);
  bits = (bits ^ bits >> 33) * 0xff51afd7ed558ccdu;
  bits = (bits ^ bits >> 33) * 0xc4ceb9fe1a85ec53u;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

double mixed(double a, double b, double t) {
  return a + t * t * (3 - 2 * t) * (b - a);
}

/// Values of a lattice, and what lies between them.
double smooth(const Point& p) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto x = static_cast<int64_t>(fx), y = static_cast<int64_t>(fy);
  const auto z = static_cast<int64_t>(fz);
  const auto row = [&](int64_t at_y, int64_t at_z) {
    return mixed(valueAt(x, at_y, at_z), valueAt(x + 1, at_y, at_z), p.x - fx);
  };
  const auto layer = [&](int64_t at_z) { return mixed(row(y, at_z), row(y + 1, at_z), p.y - fy); };
  return mixed(layer(z), layer(z + 1), p.z - fz);
}

int32_t heightAt(const Point& p) {
  double sum = 0, amplitude = 0.5, scale = 1.5;
  for (int octave = 0; octave < kOctaves; ++octave, amplitude /= 2, scale *= 2)
    sum += amplitude * smooth({scale * p.x + 31.7, scale * p.y + 17.3, scale * p.z + 5.9});
  const double most = ForestTerrain::kMost;
  return static_cast<int32_t>(std::clamp((sum + 1) / 2, 0.0, 1.0) * most);
}

/// place(patch, x, y): a point in space for 0 to 1 over a patch.
template <class Place>
ForestTerrain filled(const std::string& name, Forest forest, const Place& place) {
  std::vector<int32_t> heights;
  heights.reserve(forest.raster().samples());
  const double last = forest.side() - 1;
  for (uint32_t patch = 0; patch < forest.patches(); ++patch)
    for (uint32_t y = 0; y < forest.side(); ++y)
      for (uint32_t x = 0; x < forest.side(); ++x)
        heights.push_back(heightAt(place(patch, x / last, y / last)));
  shareOwned(forest, std::span(heights), forest.side() - 1);
  return {name, std::move(forest), std::move(heights)};
}

}  // namespace

ForestTerrain terrainOn(const Solid& solid, int depth) {
  return filled(solid.name, Forest(depth, sidesOf(solid)), [&](uint32_t patch, double x, double y) {
    return onSphere(pointOf(solid, patch, x, y));
  });
}

ForestTerrain torusOf(uint32_t columns, int depth) {
  std::vector<uint32_t> sides;
  const auto patchAt = [&](uint32_t column, uint32_t row) {
    return Forest::kSides * (row % columns * columns + column % columns);
  };
  for (uint32_t row = columns; row < 2 * columns; ++row)
    for (uint32_t column = columns; column < 2 * columns; ++column)
      sides.insert(sides.end(), {patchAt(column, row - 1) + 2, patchAt(column + 1, row) + 3,
                                 patchAt(column, row + 1), patchAt(column - 1, row) + 1});
  const std::string name = std::to_string(columns) + "x" + std::to_string(columns);
  return filled(name, Forest(depth, sides), [&](uint32_t patch, double x, double y) {
    return Point{2 * (patch % columns + x) / columns, 2 * (patch / columns + y) / columns, 0};
  });
}

ForestTerrain straightPair(int depth) {
  return filled("straight pair", Forest(depth, {6, 7, 4, 5, 2, 3, 0, 1}),
                [](uint32_t patch, double x, double y) {
                  return Point{patch + x, y, 0};
                });
}

}  // namespace tetrakis::bench
