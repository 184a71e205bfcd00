// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/pair_graph.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tetrakis::inline remesh {
namespace {

constexpr double kFlatness = 0.5;  ///< weight of the bend at the diagonal
constexpr double kLengths = 0.25;  ///< weight of the difference of opposite sides

constexpr double kImmense = 1000;  ///< badness of quads whose areas are too large for doubles

struct CornerAngle {
  double cosine = 1, sine = 0;
};

/// Between two directions; 0 if one has no length.
CornerAngle angleBetween(const Point& a, const Point& b) {
  const double lengths = length(a) * length(b);
  if (!(lengths > 0)) return {};
  return {dot(a, b) / lengths, length(cross(a, b)) / lengths};
}

CornerAngle sum(const CornerAngle& a, const CornerAngle& b) {
  return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

/// 0 for 90 degrees, 1 for 0 and 180, and more beyond.
double cornerBadness(const CornerAngle& angle) {
  const double cosine = angle.sine < 0 ? -2 - angle.cosine : angle.cosine;
  const double cube = cosine * cosine * cosine;
  return cube * cube;
}

/// From 0 to 1.
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

/// A side by its ends, the lower one first, and who has it.
struct TriangleSide {
  uint32_t low, high, triangle, number;
  bool rising;  ///< leads from the lower to the higher end
};

std::vector<TriangleSide> sortedSides(const TriangleMesh& mesh) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, k, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.low, a.high, a.triangle, a.number) <
           std::tie(b.low, b.high, b.triangle, b.number);
  });
  return sides;
}

uint32_t cornerAcross(const TriangleMesh& mesh, const TriangleSide& side) {
  return mesh.triangles[side.triangle][(side.number + 2) % 3];
}

/// Of the quad that `side` halves, with `other` as the corner beyond it.
double pairBadness(const TriangleMesh& mesh, const TriangleSide& side, uint32_t other) {
  const Triangle& t = mesh.triangles[side.triangle];
  return quadBadness({mesh.points[t[(side.number + 1) % 3]], mesh.points[cornerAcross(mesh, side)],
                      mesh.points[t[side.number]], mesh.points[other]});
}

/// Of a triangle whose `side` is halved.
double aloneBadness(const TriangleMesh& mesh, const TriangleSide& side) {
  const Point &low = mesh.points[side.low], &high = mesh.points[side.high];
  const Point& across = mesh.points[cornerAcross(mesh, side)];
  return quadBadness({0.5 * (low + high), high, across, low});
}

/// The best side without a neighbour. Of equal ones that across the first point, so that the two
/// triangles of a closed pillow choose the same side.
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
  const std::vector<TriangleSide> sides = sortedSides(mesh);
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const TriangleSide &a = sides[begin], &b = sides[std::min(begin + 1, sides.size() - 1)];
    while (end < sides.size() && sides[end].low == a.low && sides[end].high == a.high) ++end;
    const bool two = end - begin == 2 && a.rising != b.rising;
    if (two && cornerAcross(mesh, a) != cornerAcross(mesh, b)) {
      graph.neighbours[a.triangle][a.number] = b.triangle;
      graph.neighbours[b.triangle][b.number] = a.triangle;
      graph.badness[a.triangle][a.number] = graph.badness[b.triangle][b.number] =
          pairBadness(mesh, a, cornerAcross(mesh, b));
      continue;
    }
    for (size_t i = begin; i < end; ++i) {
      graph.badness[sides[i].triangle][sides[i].number] = aloneBadness(mesh, sides[i]);
      graph.at_border[a.low] = graph.at_border[a.high] = true;
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

double totalBadness(const PairGraph& graph, const Matching& matching) {
  double sum = 0;
  for (uint32_t t = 0; t < matching.size(); ++t) {
    if (matching[t] == kNoMate || matching[t] < t) continue;
    sum += graph.badness[t][sideTowards(graph, t, matching[t])];
  }
  return sum;
}

}  // namespace tetrakis::inline remesh
