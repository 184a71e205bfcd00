// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/pair_graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "codec/remesh/half_edges.hpp"

namespace tetrakis::inline remesh {
namespace {

constexpr double kFlatness = 0.5;  ///< weight of the bend at the diagonal
constexpr double kLengths = 0.25;  ///< weight of the difference of opposite sides
constexpr double kImmense = 1000;  ///< badness of quads whose areas are too large for doubles

/// An angle by its cosine and sine.
struct CornerAngle {
  double cosine = 1, sine = 0;
};

/// The angle between two directions, which is 0 if one of them has no length.
CornerAngle angleBetween(const Point& a, const Point& b) {
  const double lengths = length(a) * length(b);
  if (!(lengths > 0)) return {};
  return {dot(a, b) / lengths, length(cross(a, b)) / lengths};
}

CornerAngle sum(const CornerAngle& a, const CornerAngle& b) {
  return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

/// The badness of a corner: 0 for 90 degrees, 1 for 0 and 180 degrees, and more beyond 180.
double cornerBadness(const CornerAngle& angle) {
  const double cosine = angle.sine < 0 ? -2 - angle.cosine : angle.cosine;
  const double cube = cosine * cosine * cosine;
  return cube * cube;
}

/// How much the lengths of opposite sides differ, from 0 to 1.
double lengthBadness(const std::array<Point, 4>& sides) {
  std::array<double, 4> lengths{};
  double squares = 0;
  for (size_t k = 0; k < 4; ++k) {
    lengths[k] = length(sides[k]);
    squares += lengths[k] * lengths[k];
  }
  const double across = lengths[0] - lengths[2], along = lengths[1] - lengths[3];
  return squares > 0 ? (across * across + along * along) / squares : 0;
}

uint32_t cornerAcross(const TriangleMesh& mesh, uint32_t side) {
  return startOf(mesh.triangles, previousSide(side));
}

/// The other half-edge if its triangle may be a mate, or kNone. Both triangles have to face one
/// side and must not have the same corners.
uint32_t pairSide(const TriangleMesh& mesh, const GluedSides& glued, uint32_t side) {
  const uint32_t other = glued.opposite[side];
  if (other == kNone || cornerAcross(mesh, side) == cornerAcross(mesh, other) ||
      startOf(mesh.triangles, side) == startOf(mesh.triangles, other))
    return kNone;
  return other;
}

/// The badness of the quad that `side` halves and whose corner beyond this side is `beyond`.
double pairBadness(const TriangleMesh& mesh, uint32_t side, uint32_t beyond) {
  const auto point = [&](uint32_t corner) { return mesh.points[startOf(mesh.triangles, corner)]; };
  return quadBadness(
      {point(nextSide(side)), point(previousSide(side)), point(side), mesh.points[beyond]});
}

/// The badness of the quad that a triangle alone becomes if `side` is halved.
double aloneBadness(const TriangleMesh& mesh, uint32_t side) {
  const auto [first, last] =
      std::minmax({startOf(mesh.triangles, side), startOf(mesh.triangles, nextSide(side))});
  const Point &low = mesh.points[first], &high = mesh.points[last];
  return quadBadness({0.5 * (low + high), high, mesh.points[cornerAcross(mesh, side)], low});
}

/// The side without a neighbour that is best halved, or 3 if there is none. If several are equally
/// good, it is the one opposite the lowest point. So the two triangles of a closed pillow halve the
/// same side.
uint8_t bestHalved(const TriangleMesh& mesh, const PairGraph& graph, uint32_t t) {
  const auto rank = [&](uint8_t k) {
    return std::pair(graph.badness[t][k], mesh.triangles[t][(k + 2) % 3]);
  };
  uint8_t best = 3;
  for (uint8_t k = 0; k < 3; ++k) {
    if (graph.neighbours[t][k] != kNoMate) continue;
    if (best == 3 || rank(k) < rank(best)) best = k;
  }
  return best;
}

}  // namespace

double quadBadness(const std::array<Point, 4>& corners) {
  std::array<Point, 4> sides;
  for (size_t k = 0; k < 4; ++k) sides[k] = corners[(k + 1) % 4] - corners[k];
  const Point diagonal = corners[2] - corners[0], back = -1.0 * diagonal;
  const std::array angles{
      sum(angleBetween(sides[0], diagonal), angleBetween(diagonal, -1.0 * sides[3])),
      angleBetween(sides[1], -1.0 * sides[0]),
      sum(angleBetween(sides[2], back), angleBetween(back, -1.0 * sides[1])),
      angleBetween(sides[3], -1.0 * sides[2])};
  double corner_badness = 0;
  for (const CornerAngle& angle : angles) corner_badness += cornerBadness(angle) / 4;
  const CornerAngle bend = angleBetween(cross(sides[0], sides[1]), cross(sides[2], sides[3]));
  const double badness =
      corner_badness + kFlatness * (1 - bend.cosine) + kLengths * lengthBadness(sides);
  return std::isfinite(badness) ? badness : kImmense;
}

PairGraph pairGraph(const TriangleMesh& mesh) {
  PairGraph graph;
  graph.neighbours.resize(mesh.triangles.size(), {kNoMate, kNoMate, kNoMate});
  graph.badness.resize(mesh.triangles.size());
  graph.at_border.resize(mesh.points.size());
  const GluedSides glued = gluedSides(mesh.triangles);
  for (uint32_t side = 0; side < glued.opposite.size(); ++side) {
    const uint32_t other = pairSide(mesh, glued, side);
    double& badness = graph.badness[side / 3][side % 3];
    if (other == kNone) {
      badness = aloneBadness(mesh, side);
      graph.at_border[startOf(mesh.triangles, side)] = true;
      graph.at_border[startOf(mesh.triangles, nextSide(side))] = true;
    } else {
      graph.neighbours[side / 3][side % 3] = other / 3;
      // Both sides get the same bits: those that are computed from the lower one.
      badness = side < other ? pairBadness(mesh, side, cornerAcross(mesh, other))
                             : graph.badness[other / 3][other % 3];
    }
  }
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    graph.halved.push_back(bestHalved(mesh, graph, t));
  }
  return graph;
}

size_t sideTowards(const PairGraph& graph, uint32_t triangle, uint32_t mate) {
  if (mate == triangle) return graph.halved[triangle];
  const auto& sides = graph.neighbours[triangle];
  return static_cast<size_t>(std::find(sides.begin(), sides.end(), mate) - sides.begin());
}

}  // namespace tetrakis::inline remesh
