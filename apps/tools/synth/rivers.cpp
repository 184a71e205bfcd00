// SPDX-License-Identifier: Apache-2.0
// The drainage tree, smoothed along its branches and drawn segment by segment.
#include "apps/tools/synth/rivers.hpp"

#include <limits>
#include <thread>
#include <tuple>

#include "base/parallel.hpp"

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

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

/// A cell of a river, and where its neighbours along the river stand in the network.
struct Reach {
  uint32_t cell, to = kNone;  // none: it ends here
  uint32_t from = kNone;      // the largest of those that flow into it; none: a spring
  Point place;                // in samples
};

/// Of tributaries as large as one another the lowest is the river.
bool greater(const Drainage& drainage, uint32_t a, uint32_t b) {
  const auto rank = [&](uint32_t cell) {
    return std::make_tuple(drainage.level[cell], latticeHash(0, cell, 0) >> 32, cell);
  };
  return drainage.area[a] != drainage.area[b] ? drainage.area[a] > drainage.area[b]
                                              : rank(a) < rank(b);
}

std::vector<Reach> findRivers(const Relief& relief) {
  const Drainage& drainage = relief.drainage;
  const uint32_t side = relief.height.side();
  std::vector<Reach> rivers;
  for (uint32_t cell = 0; cell < drainage.area.size(); ++cell) {
    if (catchment(relief, cell) < kSpring) continue;
    const int64_t x = cell % side, y = cell / side;
    rivers.push_back({.cell = cell,
                      .place = {static_cast<double>(x) + kMeander * (unitHash(1, x, y) - 0.5),
                                static_cast<double>(y) + kMeander * (unitHash(2, x, y) - 0.5)}});
  }
  for (uint32_t i = 0; i < rivers.size(); ++i) {
    Reach& reach = rivers[i];
    const uint32_t to = drainage.receiver[reach.cell];
    if (to == reach.cell) continue;
    const auto at = std::lower_bound(rivers.begin(), rivers.end(), to,
                                     [](const Reach& r, uint32_t cell) { return r.cell < cell; });
    reach.to = static_cast<uint32_t>(at - rivers.begin());
    if (at->from == kNone || greater(drainage, reach.cell, rivers[at->from].cell)) at->from = i;
  }
  return rivers;
}

/// Steps to eight neighbours make zigzags: each cell moves to (1, 2, 1) / 4 of donor, itself,
/// receiver.
void smooth(std::vector<Reach>& rivers, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Reach> before = rivers;
    for (Reach& reach : rivers) {
      if (reach.from == kNone || reach.to == kNone) continue;
      const Point a = before[reach.from].place, b = reach.place, c = before[reach.to].place;
      reach.place = {(a.x + 2 * b.x + c.x) / 4, (a.y + 2 * b.y + c.y) / 4};
    }
  }
}

double distanceToSegment(Point p, Point a, Point b) {
  const double x = b.x - a.x, y = b.y - a.y, squared = x * x + y * y;
  const double along = squared > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / squared : 0;
  const double t = clamp01(along), dx = p.x - a.x - t * x, dy = p.y - a.y - t * y;
  return std::sqrt(dx * dx + dy * dy);
}

/// Rounded down into [0, end].
uint32_t within(double v, uint32_t end) {
  return static_cast<uint32_t>(std::clamp(v, 0.0, static_cast<double>(end)));
}

}  // namespace

double Rivers::Segment::reach() const {
  return (half_width + kRiverReach) / kTexel;
}

Rivers::Rivers(const Relief& relief, uint32_t texels)
    : texels_(texels), strips_((texels + kStrip - 1) / kStrip) {
  std::vector<Reach> rivers = findRivers(relief);
  smooth(rivers, 5);
  const auto toTexels = [&](Point p) {
    return Point{2 * (p.x - relief.margin), 2 * (p.y - relief.margin)};
  };
  for (const Reach& reach : rivers) {
    if (reach.to == kNone || relief.cover[reach.cell] != Cover::kLand) continue;
    add({toTexels(reach.place), toTexels(rivers[reach.to].place),
         riverWidth(catchment(relief, reach.cell)) / 2});
  }
}

void Rivers::add(const Segment& segment) {
  const double reach = segment.reach() + 1;  // strips see a row more
  const uint32_t top = within(std::min(segment.a.y, segment.b.y) - reach, texels_);
  const uint32_t bottom = within(std::max(segment.a.y, segment.b.y) + reach, texels_);
  for (uint32_t y = top / kStrip; y * kStrip < bottom; ++y)
    strips_[y].push_back(static_cast<uint32_t>(segments_.size()));
  segments_.push_back(segment);
}

RiverStrip Rivers::strip(uint32_t index) const {
  const uint32_t first = index * kStrip, end = std::min(first + kStrip, texels_);
  const uint32_t top = std::max(first, 1u) - 1, bottom = std::min(end + 1, texels_);
  RiverStrip strip{first, end, texels_, top,
                   std::vector<double>(size_t{bottom - top} * texels_, kRiverReach)};
  for (const uint32_t i : strips_[index]) {
    const auto& [a, b, half_width] = segments_[i];
    const double reach = segments_[i].reach();
    const uint32_t x0 = within(std::min(a.x, b.x) - reach, texels_);
    const uint32_t x1 = within(std::max(a.x, b.x) + reach, texels_);
    const uint32_t y0 = std::max(top, within(std::min(a.y, b.y) - reach, texels_));
    const uint32_t y1 = std::min(bottom, within(std::max(a.y, b.y) + reach, texels_));
    for (uint32_t y = y0; y < y1; ++y) {
      double* row = &strip.metres[size_t{y - top} * texels_];
      for (uint32_t x = x0; x < x1; ++x) {
        const double metres = kTexel * distanceToSegment({x + 0.5, y + 0.5}, a, b) - half_width;
        row[x] = std::min(row[x], metres);
      }
    }
  }
  return strip;
}

void Rivers::forStrips(const std::function<void(const RiverStrip&)>& work) const {
  parallelFor(std::thread::hardware_concurrency(), strips_.size(),
              [&](size_t i) { work(strip(static_cast<uint32_t>(i))); });
}

}  // namespace tetrakis::tools::synth
