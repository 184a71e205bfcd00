// SPDX-License-Identifier: Apache-2.0
// Districts are Voronoi cells of jittered points; parcels are bricks in turned coordinates.
#include "apps/tools/synth/parcels.hpp"

#include <array>

namespace tetrakis::tools::synth {
namespace {

struct District {
  uint64_t id = 0;
  double border = 0;  // metres to the next district
};

/// With s the seed of the cell and t another, the bisector lies (|p - t|^2 - |p - s|^2) / 2 |t - s|
/// away.
District districtAt(uint64_t seed, Point metres) {
  constexpr double kCell = 1500;
  const Point p{metres.x / kCell, metres.y / kCell};
  const int64_t ix = static_cast<int64_t>(std::floor(p.x));
  const int64_t iy = static_cast<int64_t>(std::floor(p.y));
  const auto squared = [](Point a, Point b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
  };
  std::array<Point, 9> seeds;
  size_t nearest = 0;
  District district;
  for (size_t i = 0; i < seeds.size(); ++i) {
    const int64_t x = ix - 1 + static_cast<int64_t>(i % 3),
                  y = iy - 1 + static_cast<int64_t>(i / 3);
    seeds[i] = {static_cast<double>(x) + mix(0.15, 0.85, unitHash(seed, x, y)),
                static_cast<double>(y) + mix(0.15, 0.85, unitHash(seed + 1, x, y))};
    if (i > 0 && squared(p, seeds[i]) >= squared(p, seeds[nearest])) continue;
    nearest = i;
    district.id = hash(seed + 2, x, y);
  }
  district.border = kCell;
  for (size_t i = 0; i < seeds.size(); ++i) {
    if (i == nearest) continue;
    const double excess = squared(p, seeds[i]) - squared(p, seeds[nearest]);
    const double apart = std::sqrt(squared(seeds[i], seeds[nearest]));
    district.border = std::min(district.border, kCell * excess / (2 * apart));
  }
  return district;
}

}  // namespace

Parcel parcelAt(uint64_t seed, Point metres) {
  const Point bent = warp(seed + 10, {metres.x / 400, metres.y / 400}, 0.06, 2);
  const District district = districtAt(seed, {400 * bent.x, 400 * bent.y});
  const double t = 2 * unitHash(district.id, 0, 0) - 1;  // tan of half the turn
  const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  const double u = 400 * (c * bent.x - s * bent.y), v = 400 * (s * bent.x + c * bent.y);
  const double depth = mix(110, 260, unitHash(district.id, 1, 0));
  const double strip = std::floor(v / depth);
  const int64_t row = static_cast<int64_t>(strip);
  const double width = mix(90, 480, unitHash(district.id, 2, row));
  const double shifted = u + width * unitHash(district.id, 3, row),
               brick = std::floor(shifted / width);
  Parcel parcel;
  parcel.id = hash(district.id + 4, static_cast<int64_t>(brick), row);
  parcel.along = shifted - brick * width;
  parcel.across = v - strip * depth;
  const double side = std::min(parcel.along, width - parcel.along);
  const double end = std::min(parcel.across, depth - parcel.across);
  parcel.edge = std::min({side, end, district.border});
  // Every other strip meets its neighbour at a track; so do districts.
  const int64_t boundary = row + (parcel.across > depth / 2 ? 1 : 0);
  parcel.track = district.border <= std::min(side, end) || (end <= side && boundary % 2 == 0);
  return parcel;
}

}  // namespace tetrakis::tools::synth
