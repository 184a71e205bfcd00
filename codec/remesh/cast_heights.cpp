// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/cast_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

namespace tetrakis::inline remesh {

namespace {

/// How far the place where a line meets the mesh may lie from the place to which the map takes the
/// sample, in parts of the diagonal. A place farther away lies on another sheet of the surface.
constexpr double kReach = 0.03;

/// Number of rounds in which each sample compares itself with its neighbours and chooses again.
constexpr int kRounds = 4;

/// The weight of a distance from the mapped place; that of a distance from the heights around is 1.
constexpr double kMapWeight = 0.25;

Point pointOf(const BaseMesh& base, const BasePoint& at) {
  return placeOf(base, at, 0);
}

Point normalOf(const BasePoint& at) {
  constexpr double kUnit = 1.0 / (1 << BentBase::kNormalBits);
  return {static_cast<double>(at.normal[0]) * kUnit, static_cast<double>(at.normal[1]) * kUnit,
          static_cast<double>(at.normal[2]) * kUnit};
}

/// A place of the mesh that a sample may take.
struct Cast {
  double height = 0;  ///< along the normal of the base
  SurfacePoint place;
  double off = 0;  ///< distance from the mapped place, plus a penalty if the line misses `place`
};

class Caster {
 public:
  Caster(const TriangleTree& mesh, double reach) : mesh_(mesh), reach_(reach) {}

  /// The places near the mapped one where the line leaves the inside of the mesh. If none of them
  /// is very near, also the place where line and mesh come nearest to each other. They are sorted
  /// by height, and there is at least one.
  void find(const Point& origin, const Point& normal, const SurfacePoint& mapped,
            std::vector<Cast>& found) const {
    found.clear();
    if (dot(normal, normal) == 0) return found.assign(1, {0, mapped, 0});
    const Point target = at(mesh_.mesh(), mapped);
    const double middle = dot(target - origin, normal);
    mesh_.crossings({origin, normal, middle - reach_, middle + reach_}, [&](const Crossing& met) {
      const double off = length(at(mesh_.mesh(), met.place) - target);
      if (met.outward && off <= reach_) found.push_back({met.t, met.place, off});
    });
    const auto near = [&](const Cast& cast) { return cast.off <= kNear * reach_; };
    if (std::none_of(found.begin(), found.end(), near))
      found.push_back(nearest(origin, normal, mapped));
    std::sort(found.begin(), found.end(), [](const Cast& a, const Cast& b) {
      return std::tuple(a.height, a.place.triangle) < std::tuple(b.height, b.place.triangle);
    });
  }

 private:
  /// The place where the line and the mesh come nearest to each other. It is found by going from
  /// the line to the nearest place of the mesh, and back, several times.
  Cast nearest(const Point& origin, const Point& normal, const SurfacePoint& mapped) const {
    constexpr int kSteps = 4;
    const Point target = at(mesh_.mesh(), mapped);
    Cast cast{dot(target - origin, normal), mapped, 0};
    for (int step = 0; step < kSteps; ++step) {
      const auto near = mesh_.closest(origin + cast.height * normal, reach_);
      if (!near) break;
      const double before = cast.height;
      cast = {dot(at(mesh_.mesh(), near->place) - origin, normal), near->place, 0};
      if (cast.height == before) break;  // further steps would find the same
    }
    const Point place = at(mesh_.mesh(), cast.place);
    cast.off = length(place - target) + kOffLine * length(origin + cast.height * normal - place);
    return cast;
  }
  /// If the line meets the mesh so near to the mapped place, in parts of the reach, it has
  /// certainly met the right sheet.
  static constexpr double kNear = 0.1;
  /// Penalty for each unit of distance between the line and the place: a sample that lies beside
  /// the mesh is worse than one that lies on another part of it.
  static constexpr double kOffLine = 4;

  const TriangleTree& mesh_;
  double reach_;
};

double median(std::array<double, 8>& values, size_t count) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// The median height of a sample's neighbours in its patch.
double medianAround(const std::vector<double>& heights, int side, int x, int y) {
  std::array<double, 8> values;
  size_t count = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int column = x + dx, row = y + dy;
      if ((dx == 0 && dy == 0) || column < 0 || row < 0 || column >= side || row >= side) continue;
      values[count++] = heights[static_cast<size_t>(row * side + column)];
    }
  }
  return median(values, count);
}

/// The samples of one patch, row by row. At first each takes the place nearest to the mapped one.
/// Then, in some rounds, it takes the place that fits the heights of its neighbours best.
std::vector<Cast> castPatch(const BaseMesh& base, const std::vector<BasePoint>& points,
                            const Caster& caster,
                            const std::function<SurfacePoint(double x, double y)>& place_of) {
  const auto side = static_cast<int>(base.forest->side());
  const double n = side - 1;
  std::vector<Cast> taken, found, all;
  std::vector<size_t> first{0};  // of the choices of each sample in `all`, and the end
  const auto take = [](std::span<const Cast> from, const auto& cost) {
    return *std::min_element(from.begin(), from.end(),
                             [&](const Cast& a, const Cast& b) { return cost(a) < cost(b); });
  };
  const auto choices = [&](size_t i) {
    return std::span<const Cast>(all).subspan(first[i], first[i + 1] - first[i]);
  };
  for (const BasePoint& at : points) {
    const auto x = static_cast<double>(taken.size() % static_cast<size_t>(side));
    const auto y = static_cast<double>(taken.size() / static_cast<size_t>(side));
    caster.find(pointOf(base, at), normalOf(at), place_of(x / n, y / n), found);
    all.insert(all.end(), found.begin(), found.end());
    first.push_back(all.size());
    taken.push_back(take(found, [](const Cast& cast) { return cast.off; }));
  }
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> heights;
    for (const Cast& cast : taken) heights.push_back(cast.height);
    for (size_t i = 0; i < taken.size(); ++i) {
      if (choices(i).size() == 1) continue;
      const int x = static_cast<int>(i) % side, y = static_cast<int>(i) / side;
      const double usual = medianAround(heights, side, x, y);
      taken[i] = take(choices(i), [&](const Cast& cast) {
        return std::abs(cast.height - usual) + kMapWeight * cast.off;
      });
    }
  }
  return taken;
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
    for (const Cast& cast : castPatch(base, bent.patch(patch), caster, place)) {
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
