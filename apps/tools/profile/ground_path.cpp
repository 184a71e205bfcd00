// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/profile/ground_path.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "apps/tools/files/place/ground_spacing.hpp"

namespace tetrakis::tools {
namespace {

std::optional<LinePoint> parsePoint(const std::string& word) {
  LinePoint point;
  const char *at = word.data(), *const end = at + word.size();
  const auto x = std::from_chars(at, end, point.x);
  if (x.ec != std::errc() || x.ptr == end || *x.ptr != ',') return std::nullopt;
  const auto y = std::from_chars(x.ptr + 1, end, point.y);
  if (y.ec != std::errc() || y.ptr != end) return std::nullopt;
  constexpr double kFarthest = 1e15;  // beyond, columns have no fractions
  if (!(std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest)) return std::nullopt;
  return point;
}

}  // namespace

Result<std::vector<LinePoint>> parseLine(const std::string& text) {
  std::vector<LinePoint> points;
  std::istringstream words(text);
  bool differ = false;
  for (std::string word; words >> word;) {
    const std::optional<LinePoint> point = parsePoint(word);
    if (!point)
      return Status(TKS_USAGE, "--line takes points \"X,Y X,Y …\", and '" + word + "' is none");
    differ = differ ||
             (!points.empty() && (point->x != points.front().x || point->y != points.front().y));
    points.push_back(*point);
  }
  if (!differ) return Status(TKS_USAGE, "--line must have at least two points that differ");
  return points;
}

Result<GroundPath> pathOver(const tks_info& info, std::vector<LinePoint> points, bool geographic) {
  if (!info.has_heights)
    return Status(TKS_USAGE, "the stream has no heights, so there is no profile");
  GroundPath path;
  path.points = std::move(points);
  const std::array<double, 2> spacing = spacingOf(info);
  path.metres = spacing[0] > 0 && spacing[1] > 0;
  if (path.metres) path.spacing = spacing;
  if (!geographic) return path;
  if (!info.has_geotransform)
    return Status(TKS_USAGE, "the stream does not say where it lies, as --geo needs");
  std::copy_n(info.geotransform, path.place.size(), path.place.begin());
  GeoTransform& t = path.place;
  t[0] += (t[1] + t[2]) / 2;  // from the corner of the first sample to its middle
  t[3] += (t[4] + t[5]) / 2;
  if (!std::isnormal(t[1] * t[5] - t[2] * t[4]))
    return Status(TKS_USAGE, "the stream's geotransform cannot be inverted, as --geo needs");
  return path;
}

}  // namespace tetrakis::tools
