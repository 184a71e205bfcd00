// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/collapse_map.hpp"

#include <algorithm>
#include <array>

namespace tetrakis::inline remesh {
namespace {

/// A place in one of the triangles around the origin, by the weights of the triangle's corners.
struct FlatPlace {
  size_t triangle = 0;
  /// Of the origin, of point number `triangle` of the ring, and of the point after it.
  std::array<double, 3> weights{1, 0, 0};
};

/// Three weights, the last two of which are given, corrected so that none is negative and their sum
/// is 1.
std::array<double, 3> sound(double first, double second) {
  first = std::max(first, 0.0);
  second = std::max(second, 0.0);
  const double sum = first + second;
  if (sum >= 1) return {0, first / sum, second / sum};
  return {1 - sum, first, second};
}

/// Finds the triangle that holds a flat point. pointOf(i) is point i of the ring, and next(i) the
/// number of the point after it.
template <class PointOf, class Next>
FlatPlace locate(const FlatPoint& flat, size_t triangles, PointOf pointOf, Next next) {
  FlatPlace found;
  double best = -1e300;
  for (size_t i = 0; i < triangles; ++i) {
    const FlatPoint a = pointOf(i), b = pointOf(next(i));
    const double area = cross(a, b), first = cross(flat, b) / area, second = cross(a, flat) / area;
    if (!(std::min(first, second) > best)) continue;
    best = std::min(first, second);
    found = {i, sound(first, second)};
  }
  return found;
}

}  // namespace

void CollapseMap::add(const Ring& ring, uint32_t target, const std::vector<FlatPoint>& flat) {
  const uint32_t number = collapses();
  collapses_.push_back({static_cast<uint32_t>(spokes_.size()), ring.points[target], target});
  for (size_t i = 0; i < ring.points.size(); ++i) {
    Spoke spoke{kNone, kNone, flat.empty() ? FlatPoint{} : flat[i]};
    if (i < ring.sides.size()) {
      spoke.side = ring.sides[i];
      spoke.before = last_[spoke.side / 3];
      last_[spoke.side / 3] = number;
    }
    spokes_.push_back(spoke);
  }
}

std::span<const CollapseMap::Spoke> CollapseMap::spokesOf(uint32_t collapse) const {
  const size_t first = collapses_[collapse].first_spoke;
  const size_t end =
      collapse + 1 < collapses_.size() ? collapses_[collapse + 1].first_spoke : spokes_.size();
  return std::span(spokes_).subspan(first, end - first);
}

uint32_t CollapseMap::replay(uint32_t collapse, std::vector<Triangle>& triangles,
                             std::vector<uint32_t>& last) const {
  const std::span<const Spoke> spokes = spokesOf(collapse);
  const Collapse& record = collapses_[collapse];
  uint32_t vanished = 0;
  for (size_t i = 0; i < spokes.size() && spokes[i].side != kNone; ++i) {
    const uint32_t side = spokes[i].side;
    if (i == record.target || (i + 1) % spokes.size() == record.target) {
      triangles[side / 3] = {kNone, kNone, kNone};
      ++vanished;
    } else {
      triangles[side / 3][side % 3] = record.to;
    }
    last[side / 3] = collapse;
  }
  return vanished;
}

uint32_t CollapseMap::undo(uint32_t collapse, SurfacePoint& place) const {
  const std::span<const Spoke> spokes = spokesOf(collapse);
  const size_t target = collapses_[collapse].target, count = spokes.size();
  const auto next = [&](size_t i) { return i + 1 < count ? i + 1 : 0; };
  const auto exists = [&](size_t i) { return spokes[i].side != kNone; };
  const auto land = [&](const FlatPlace& found) {
    const Spoke& spoke = spokes[found.triangle];
    place.triangle = spoke.side / 3;
    for (uint32_t k = 0; k < 3; ++k) place.weights[(spoke.side + k) % 3] = found.weights[k];
    return spoke.before;
  };
  size_t i = 0;
  while (spokes[i].side / 3 != place.triangle) ++i;
  const uint32_t apex = spokes[i].side % 3;
  const double to = place.weights[apex], first = place.weights[(apex + 1) % 3],
               second = place.weights[(apex + 2) % 3];
  // Places on the rim of the polygon keep their weights.
  if (to == 0) return land({i, {0, first, second}});
  if (second == 0 && i == next(target) && exists(target)) return land({target, {0, to, first}});
  if (first == 0 && next(next(i)) == target && exists(next(i)))
    return land({next(i), {0, second, to}});
  const FlatPoint &a = spokes[target].place, &b = spokes[i].place, &c = spokes[next(i)].place;
  const FlatPoint flat{to * a.x + first * b.x + second * c.x,
                       to * a.y + first * b.y + second * c.y};
  return land(locate(
      flat, exists(count - 1) ? count : count - 1, [&](size_t k) { return spokes[k].place; },
      next));
}

}  // namespace tetrakis::inline remesh
