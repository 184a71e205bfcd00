// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/profile/path_legs.hpp"

#include <algorithm>
#include <cstdint>

namespace tetrakis::tools {
namespace {

/// Points that leave the ground by no more are on its border: coordinates that are typed, or come
/// through a geotransform, are off by their rounding.
constexpr double kOnBorder = 1e-6;

double onBorder(double value, double last) {
  if (value < 0 && value >= -kOnBorder) return 0;
  return value > last && value <= last + kOnBorder ? last : value;
}

/// Narrows the part of a leg to that between 0 and last (Liang and Barsky).
void clip(Leg& leg, double from, double to, double last) {
  const double step = to - from;
  if (step == 0) {
    if (from < 0 || from > last) leg.exits = -1;
    return;
  }
  const double at_first = -from / step, at_last = (last - from) / step;
  leg.enters = std::max(leg.enters, std::min(at_first, at_last));
  leg.exits = std::min(leg.exits, std::max(at_first, at_last));
}

GridPoint gridPoint(const GroundPath& path, const LinePoint& at, const tks_info& info) {
  const GeoTransform& t = path.place;
  const double x = at.x - t[0], y = at.y - t[3], area = t[1] * t[5] - t[2] * t[4];
  return {onBorder((x * t[5] - y * t[2]) / area, info.width - 1.0),
          onBorder((y * t[1] - x * t[4]) / area, info.height - 1.0)};
}

}  // namespace

std::vector<Leg> legsOf(const GroundPath& path, const tks_info& info) {
  std::vector<Leg> legs;
  double distance = 0;
  for (size_t i = 1; i < path.points.size(); ++i) {
    Leg leg;
    leg.at_from = path.points[i - 1];
    leg.at_to = path.points[i];
    leg.from = gridPoint(path, leg.at_from, info);
    leg.to = gridPoint(path, leg.at_to, info);
    if (leg.samples() == 0) continue;
    leg.start = distance;
    distance += std::hypot((leg.to.column - leg.from.column) * path.spacing[0],
                           (leg.to.row - leg.from.row) * path.spacing[1]);
    leg.end = distance;
    leg.exits = 1;
    clip(leg, leg.from.column, leg.to.column, info.width - 1.0);
    clip(leg, leg.from.row, leg.to.row, info.height - 1.0);
    legs.push_back(leg);
  }
  return legs;
}

tks_window windowAround(const std::vector<Leg>& legs, const tks_info& info) {
  const double last_column = info.width - 1.0, last_row = info.height - 1.0;
  double left = last_column, top = last_row, right = 0, bottom = 0;
  for (const Leg& leg : legs) {
    if (!leg.meetsGround()) continue;
    for (const double part : {leg.enters, leg.exits}) {
      const GridPoint at = leg.pointAt(part);  // on the ground, but for the rounding of far points
      const double column = std::clamp(at.column, 0.0, last_column),
                   row = std::clamp(at.row, 0.0, last_row);
      left = std::min(left, std::floor(column));
      top = std::min(top, std::floor(row));
      right = std::max(right, std::ceil(column));
      bottom = std::max(bottom, std::ceil(row));
    }
  }
  const auto x = static_cast<uint32_t>(left), y = static_cast<uint32_t>(top);
  return {x, y, static_cast<uint32_t>(right) - x + 1, static_cast<uint32_t>(bottom) - y + 1};
}

}  // namespace tetrakis::tools
