// SPDX-License-Identifier: Apache-2.0
// The scan: a body with handles and thin limbs, as a scanner sees it: with holes where it did not
// look, and with noise.
#include <algorithm>
#include <map>

#include "apps/tools/synth/surfaces/level_set.hpp"
#include "apps/tools/synth/surfaces/shape.hpp"
#include "apps/tools/synth/surfaces/solid_noise.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr double kBody = 0.6;
constexpr size_t kPlaces = 8, kLimbs = 4, kHoles = 2;

/// Corners of a cube, seen from its middle, in an order of the seed: where things grow on the body.
std::array<Spot, kPlaces> placesOf(uint64_t seed) {
  std::array<std::pair<uint64_t, uint32_t>, kPlaces> order{};
  for (uint32_t i = 0; i < kPlaces; ++i) order[i] = {hash(seed, i, 1), i};
  std::sort(order.begin(), order.end());
  std::array<Spot, kPlaces> places{};
  for (size_t i = 0; i < kPlaces; ++i) {
    const uint32_t bits = order[i].second;
    places[i] = directionOf({bits & 1 ? 1.0 : -1.0, bits & 2 ? 1.0 : -1.0, bits & 4 ? 1.0 : -1.0});
  }
  return places;
}

/// The least of both, rounded where they meet.
double blend(double a, double b) {
  constexpr double kReach = 0.05;
  const double h = std::max(kReach - std::abs(a - b), 0.0) / kReach;
  return std::min(a, b) - h * h * kReach / 4;
}

/// A ring that stands on the body with its lower half inside.
double handle(const Spot& p, const Spot& place) {
  constexpr double kMiddle = 0.72, kRound = 0.27, kThick = 0.1;
  const Spot axis = directionOf(cross(place, {0, 0, 1}));
  const Spot from = p - kMiddle * place;
  const double along = dot(from, axis);
  const double round = length(from - along * axis) - kRound;
  return std::sqrt(along * along + round * round) - kThick;
}

/// Thinner and thinner outwards.
double limb(const Spot& p, const Spot& place) {
  constexpr double kStart = 0.5, kEnd = 1.4, kThick = 0.12, kThin = 0.065;
  const double share = clamp01((dot(p, place) - kStart) / (kEnd - kStart));
  const Spot nearest = mix(kStart, kEnd, share) * place;
  return length(p - nearest) - mix(kThick, kThin, share);
}

class Body {
 public:
  explicit Body(uint64_t seed) : seed_(seed), handles_(seed % 4), places_(placesOf(seed)) {}
  double operator()(const Spot& p) const {
    constexpr double kBumps = 0.16, kGrain = 0.025, kCoarse = 2, kFine = 9, kFar = 0.25;
    const double rough = ungrained(0, p);
    if (std::abs(rough) > kFar) return rough;  // whatever bumps there are
    return ungrained(kBumps * solidFractal(seed_, kCoarse * p, 2), p) -
           kGrain * solidFractal(seed_ + 1, kFine * p, 2);
  }

 private:
  /// All but the grain, with the bumps of the body as they are here.
  double ungrained(double bumps, const Spot& p) const {
    double value = length(p) - kBody - bumps;
    for (size_t i = 0; i < handles_; ++i) value = blend(value, handle(p, places_[i]));
    for (size_t i = handles_; i < handles_ + kLimbs; ++i) value = blend(value, limb(p, places_[i]));
    return value;
  }

  uint64_t seed_;
  size_t handles_;
  std::array<Spot, kPlaces> places_;
};

/// A mesh of about so many triangles. Their number grows with the square of the number of cells.
TriangleMesh meshOf(const Field& field, uint32_t triangles) {
  constexpr double kHalf = 1.55;
  constexpr uint32_t kFewest = 48;  // that limbs and handles survive
  TriangleMesh coarsest = levelSet(field, {kHalf, kFewest});
  const auto found = static_cast<double>(coarsest.triangles.size());
  const auto side = static_cast<uint32_t>(kFewest * std::sqrt(triangles / found));
  return side > kFewest ? levelSet(field, {kHalf, side}) : coarsest;
}

using Edges = std::map<std::pair<uint32_t, uint32_t>, int>;

/// Marks points at which more than one gap begins; whether there are any.
bool markPinched(const TriangleMesh& shape, std::vector<bool>& gone) {
  Edges edges;
  for (const Triangle& t : shape.triangles)
    for (size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<int> border(shape.points.size());
  for (const auto& [edge, count] : edges) {
    border[edge.first] += count == 1;
    border[edge.second] += count == 1;
  }
  bool any = false;
  for (size_t i = 0; i < border.size(); ++i) {
    if (border[i] <= 2) continue;
    gone[i] = any = true;
  }
  return any;
}

void removePoints(const std::vector<bool>& gone, TriangleMesh& shape) {
  std::erase_if(shape.triangles,
                [&gone](const Triangle& t) { return gone[t[0]] || gone[t[1]] || gone[t[2]]; });
}

/// Cuts holes in sides of the cube whose corners bear limbs and handles. Points that have lost
/// their triangles stay.
void pierce(uint64_t seed, TriangleMesh& shape) {
  constexpr double kRadius = 0.15;
  std::vector<bool> gone(shape.points.size());
  for (size_t hole = 0; hole < kHoles; ++hole) {
    Spot middle{};
    const uint64_t side = (hash(seed, 0, 2) + hole) % 6;
    middle[side % 3] = side < 3 ? kBody : -kBody;
    // The body's surface is nearer or farther: a cylinder around the axis, on one side of it.
    for (size_t i = 0; i < gone.size(); ++i) {
      const double height = dot(shape.points[i], directionOf(middle));
      const Spot aside = shape.points[i] - height * directionOf(middle);
      if (height > 0 && length(aside) < kRadius) gone[i] = true;
    }
  }
  removePoints(gone, shape);
  while (markPinched(shape, gone)) removePoints(gone, shape);
}

/// Each point by itself, along its normal, by a share of the length of edges.
void addNoise(uint64_t seed, TriangleMesh& shape) {
  constexpr double kShare = 0.06;
  std::vector<Spot> normals(shape.points.size());
  double area = 0;
  for (const Triangle& t : shape.triangles) {
    const Spot normal = areaNormal(shape, t);
    area += length(normal);
    for (const uint32_t corner : t) normals[corner] = normals[corner] + normal;
  }
  const double edge = std::sqrt(area / static_cast<double>(shape.triangles.size()));
  for (size_t i = 0; i < normals.size(); ++i) {
    const double shift = kShare * edge * (2 * unitHash(seed, static_cast<int64_t>(i), 3) - 1);
    shape.points[i] = shape.points[i] + shift * directionOf(normals[i]);
  }
}

}  // namespace

TriangleMesh scan(uint32_t triangles, uint64_t seed) {
  TriangleMesh shape = meshOf(Body(seed), triangles);
  pierce(seed, shape);
  addNoise(seed, shape);
  return shape;
}

}  // namespace tetrakis::tools::synth
