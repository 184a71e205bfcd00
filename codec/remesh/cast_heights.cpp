// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/cast_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tetrakis::inline remesh {

namespace {

/// How far from where the map takes a sample a line may meet the mesh, in parts of the diagonal:
/// beyond that it has met another sheet.
constexpr double kReach = 0.03;

/// How far a height may lie from the median of those around it, in parts of the diagonal, before
/// the map's own place is taken in its stead.
constexpr double kOutlier = 0.004;

Point pointOf(const BaseMesh& base, const BasePoint& at) {
  return placeOf(base, at, 0);
}

Point normalOf(const BasePoint& at) {
  constexpr double kUnit = 1.0 / (1 << BentBase::kNormalBits);
  return {static_cast<double>(at.normal[0]) * kUnit, static_cast<double>(at.normal[1]) * kUnit,
          static_cast<double>(at.normal[2]) * kUnit};
}

struct Cast {
  double height = 0;
  SurfacePoint place;
};

class Caster {
 public:
  Caster(const TriangleTree& mesh, double reach) : mesh_(mesh), reach_(reach) {}

  /// The place that the line meets nearest to the mapped one, on a side that faces the normal.
  Cast cast(const Point& origin, const Point& normal, const SurfacePoint& mapped) const {
    const Cast fallen = fall(origin, normal, mapped);
    if (dot(normal, normal) == 0) return fallen;
    const Point target = at(mesh_.mesh(), mapped);
    Cast best = fallen;
    double nearest = reach_;
    const double middle = dot(target - origin, normal);
    mesh_.crossings({origin, normal, middle - reach_, middle + reach_}, [&](const Crossing& met) {
      const double distance = length(at(mesh_.mesh(), met.place) - target);
      if (!met.outward || distance > nearest) return;
      if (distance == nearest && met.t >= best.height) return;  // whatever the order of visits
      nearest = distance;
      best = {met.t, met.place};
    });
    return best;
  }

  /// What the mapped place says itself: its height over the plane of the base there.
  Cast fall(const Point& origin, const Point& normal, const SurfacePoint& mapped) const {
    return {dot(at(mesh_.mesh(), mapped) - origin, normal), mapped};
  }

 private:
  const TriangleTree& mesh_;
  double reach_;
};

double median(std::array<double, 8>& values, size_t count) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// Of the neighbours of a sample in its patch.
double medianAround(const std::vector<Cast>& casts, int side, int x, int y) {
  std::array<double, 8> values;
  size_t count = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int column = x + dx, row = y + dy;
      if ((dx == 0 && dy == 0) || column < 0 || row < 0 || column >= side || row >= side) continue;
      values[count++] = casts[static_cast<size_t>(row * side + column)].height;
    }
  }
  return median(values, count);
}

/// The samples of one patch, those aside that lie far from all around them.
std::vector<Cast> castPatch(const BaseMesh& base, const std::vector<BasePoint>& points,
                            const Caster& caster, double outlier,
                            const std::function<SurfacePoint(double x, double y)>& place_of) {
  const auto side = static_cast<int>(base.forest->side());
  const double n = side - 1;
  std::vector<Cast> casts;
  casts.reserve(points.size());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const BasePoint& at = points[casts.size()];
      casts.push_back(caster.cast(pointOf(base, at), normalOf(at), place_of(x / n, y / n)));
    }
  }
  const std::vector<Cast> first = casts;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const auto i = static_cast<size_t>(y * side + x);
      const double usual = medianAround(first, side, x, y);
      if (std::abs(first[i].height - usual) <= outlier) continue;
      const Cast fallen =
          caster.fall(pointOf(base, points[i]), normalOf(points[i]), place_of(x / n, y / n));
      if (std::abs(fallen.height - usual) < std::abs(first[i].height - usual)) casts[i] = fallen;
    }
  }
  return casts;
}

}  // namespace

CastSurface castHeights(
    const BaseMesh& base, const TriangleTree& mesh,
    const std::function<SurfacePoint(uint32_t patch, double x, double y)>& place_of) {
  const double size = diagonal(mesh.mesh());
  const Caster caster(mesh, kReach * size);
  const BentBase bent(base);
  CastSurface surface;
  for (uint32_t patch = 0; patch < base.forest->patches(); ++patch) {
    const auto place = [&](double x, double y) { return place_of(patch, x, y); };
    for (const Cast& cast : castPatch(base, bent.patch(patch), caster, kOutlier * size, place)) {
      surface.heights.push_back(static_cast<float>(cast.height));
      surface.places.push_back(cast.place);
    }
  }
  const uint32_t n = base.forest->side() - 1;
  shareOwned(*base.forest, std::span(surface.heights), n);
  shareOwned(*base.forest, std::span(surface.places), n);
  return surface;
}

TriangleMesh meshOfSamples(const BaseMesh& base, const std::vector<float>& heights) {
  const BentBase bent(base);
  const uint32_t side = base.forest->side();
  TriangleMesh mesh;
  for (uint32_t patch = 0; patch < base.forest->patches(); ++patch) {
    const auto first = static_cast<uint32_t>(mesh.points.size());
    for (const BasePoint& at : bent.patch(patch))
      mesh.points.push_back(placeOf(base, at, double{heights[mesh.points.size()]}));
    for (uint32_t y = 0; y + 1 < side; ++y) {
      for (uint32_t x = 0; x + 1 < side; ++x) {
        const uint32_t nw = first + y * side + x, ne = nw + 1, sw = nw + side, se = sw + 1;
        mesh.triangles.push_back({nw, sw, se});
        mesh.triangles.push_back({nw, se, ne});
      }
    }
  }
  return mesh;
}

}  // namespace tetrakis::inline remesh
