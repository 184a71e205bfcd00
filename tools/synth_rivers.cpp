// SPDX-License-Identifier: Apache-2.0
// The drainage tree, smoothed along its branches and drawn segment by segment.
#include "tools/synth_rivers.hpp"

#include <limits>

namespace tetrakis::tools::synth {
namespace {

constexpr double kTexel = kSpacing / 2;  // metres
constexpr double kMeander = 1.4;         // samples
constexpr double kSpring = 2.5e6;        // square metres of catchment where a stream shows

double catchment(const Relief& relief, uint32_t cell) {
  return relief.drainage.area[cell] * kSpacing * kSpacing;
}

/// Hydraulic geometry: width grows with the square root of the catchment; 3 m at one square
/// kilometre.
double riverWidth(double square_metres) {
  return 0.003 * std::sqrt(square_metres);
}

/// Cells of rivers, upstream after downstream, with the largest of the cells that flow into each.
struct Network {
  std::vector<uint32_t> cells;
  Raster<uint32_t> donor;
  Raster<Point> place;  // in samples
};

constexpr uint32_t kNoCell = std::numeric_limits<uint32_t>::max();

Network findRivers(const Relief& relief) {
  const uint32_t side = relief.height.side();
  Network rivers{{}, Raster<uint32_t>(side, kNoCell), Raster<Point>(side)};
  for (const uint32_t cell : relief.drainage.order) {
    if (catchment(relief, cell) < kSpring) continue;
    rivers.cells.push_back(cell);
    const int64_t x = cell % side, y = cell / side;
    rivers.place[cell] = {static_cast<double>(x) + kMeander * (unitHash(1, x, y) - 0.5),
                          static_cast<double>(y) + kMeander * (unitHash(2, x, y) - 0.5)};
    const uint32_t to = relief.drainage.receiver[cell];
    if (to == cell) continue;
    uint32_t& donor = rivers.donor[to];
    if (donor == kNoCell || relief.drainage.area[cell] > relief.drainage.area[donor]) donor = cell;
  }
  return rivers;
}

/// Steps to eight neighbours make zigzags: each cell moves to (1, 2, 1) / 4 of donor, itself,
/// receiver.
void smooth(Network& rivers, const Relief& relief, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    const Raster<Point> before = rivers.place;
    for (const uint32_t cell : rivers.cells) {
      const uint32_t from = rivers.donor[cell], to = relief.drainage.receiver[cell];
      if (from == kNoCell || to == cell) continue;
      const Point a = before[from], b = before[cell], c = before[to];
      rivers.place[cell] = {(a.x + 2 * b.x + c.x) / 4, (a.y + 2 * b.y + c.y) / 4};
    }
  }
}

double distanceToSegment(Point p, Point a, Point b) {
  const double x = b.x - a.x, y = b.y - a.y, squared = x * x + y * y;
  const double along = squared > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / squared : 0;
  const double t = clamp01(along), dx = p.x - a.x - t * x, dy = p.y - a.y - t * y;
  return std::sqrt(dx * dx + dy * dy);
}

/// Keeps the nearest bank. a and b in texels.
void drawSegment(Grid& distance, Point a, Point b, double half_width) {
  const double reach = (half_width + kRiverReach) / kTexel;
  const auto texel = [&](double v) {
    return static_cast<uint32_t>(std::clamp(v, 0.0, static_cast<double>(distance.side())));
  };
  const uint32_t x1 = texel(std::max(a.x, b.x) + reach), y1 = texel(std::max(a.y, b.y) + reach);
  for (uint32_t y = texel(std::min(a.y, b.y) - reach); y < y1; ++y) {
    for (uint32_t x = texel(std::min(a.x, b.x) - reach); x < x1; ++x) {
      const double metres = kTexel * distanceToSegment({x + 0.5, y + 0.5}, a, b) - half_width;
      distance.at(x, y) = std::min(distance.at(x, y), metres);
    }
  }
}

}  // namespace

Grid riverDistance(const Relief& relief, uint32_t texels) {
  Network rivers = findRivers(relief);
  smooth(rivers, relief, 5);
  const auto toTexels = [&](Point p) {
    return Point{2 * (p.x - relief.margin), 2 * (p.y - relief.margin)};
  };
  Grid distance(texels, kRiverReach);
  for (const uint32_t cell : rivers.cells) {
    const uint32_t to = relief.drainage.receiver[cell];
    if (to == cell || relief.cover[cell] != Cover::kLand) continue;
    drawSegment(distance, toTexels(rivers.place[cell]), toTexels(rivers.place[to]),
                riverWidth(catchment(relief, cell)) / 2);
  }
  return distance;
}

}  // namespace tetrakis::tools::synth
