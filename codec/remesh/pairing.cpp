// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/pairing.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include "codec/remesh/cubic_matching.hpp"
#include "codec/remesh/pair_exchange.hpp"
#include "codec/remesh/pair_graph.hpp"

namespace tetrakis::inline remesh {
namespace {

/// Pairs two triangles without mates, those of the best quad first, until no such two are
/// neighbours.
Matching greedyPairs(const PairGraph& graph) {
  std::vector<std::tuple<double, uint32_t, uint32_t>> pairs;
  for (uint32_t t = 0; t < graph.neighbours.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t mate = graph.neighbours[t][k];
      if (mate != kNoMate && t < mate) pairs.emplace_back(graph.badness[t][k], t, mate);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  Matching matching(graph.neighbours.size(), kNoMate);
  for (const auto& [badness, a, b] : pairs) {
    if (matching[a] != kNoMate || matching[b] != kNoMate) continue;
    matching[a] = b;
    matching[b] = a;
  }
  return matching;
}

Matching bestPairs(const TriangleMesh& mesh, const PairGraph& graph) {
  Matching matching = greedyPairs(graph);
  std::vector<bool> may_be_alone;
  for (const uint8_t side : graph.halved) may_be_alone.push_back(side < 3);
  completeMatching(graph.neighbours, may_be_alone, matching);
  exchangePairs(mesh, graph, matching);
  return matching;
}

/// A corner of a quad: a point of the new mesh, and its weights in the triangle of the base.
struct QuadCorner {
  uint32_t point;
  std::array<double, 3> weights;
};

class QuadBuilder {
 public:
  explicit QuadBuilder(const TriangleMesh& base) : base_(base) {
    result_.mesh.points = base.points;
  }

  /// Adds the quad of the triangles `t` and `mate`. Side `k` of the first is side `j` of the
  /// second.
  void addPair(uint32_t t, size_t k, uint32_t mate, size_t j) {
    addQuad({t, {corner(t, k + 1), corner(t, k + 2), corner(t, k)}},
            {mate, {corner(mate, j), corner(mate, j + 1), corner(mate, j + 2)}});
  }

  /// Adds the quad of a triangle alone whose side `k` is halved.
  void addAlone(uint32_t t, size_t k) {
    const QuadCorner start = corner(t, k), end = corner(t, k + 1), across = corner(t, k + 2);
    QuadCorner middle = start;
    middle.weights[(k + 1) % 3] = middle.weights[k] = 0.5;
    middle.point = middleOf(start.point, end.point);
    addQuad({t, {middle, end, across}}, {t, {middle, across, start}});
  }

  PairedMesh take() { return std::move(result_); }

 private:
  /// One of the two triangles of a quad.
  struct Half {
    uint32_t triangle;  ///< the triangle of the base in which it lies
    std::array<QuadCorner, 3> corners;
  };

  QuadCorner corner(uint32_t t, size_t k) const {
    QuadCorner result{base_.triangles[t][k % 3], {0, 0, 0}};
    result.weights[k % 3] = 1;
    return result;
  }

  uint32_t middleOf(uint32_t a, uint32_t b) {
    const auto next = static_cast<uint32_t>(result_.mesh.points.size());
    const auto [found, is_new] = middles_.try_emplace(std::minmax(a, b), next);
    if (is_new) result_.mesh.points.push_back(0.5 * base_.points[a] + 0.5 * base_.points[b]);
    return found->second;
  }

  void addQuad(const Half& first, const Half& second) {
    const auto next = static_cast<uint32_t>(result_.mesh.triangles.size());
    const std::array<QuadCorner, 3>& c = first.corners;
    result_.quads.push_back(
        {{c[0].point, c[1].point, c[2].point, second.corners[2].point}, {next, next + 1}});
    for (const Half& half : {first, second}) {
      Triangle triangle;
      TrianglePart part{half.triangle, {}};
      for (size_t k = 0; k < 3; ++k) {
        triangle[k] = half.corners[k].point;
        part.corners[k] = half.corners[k].weights;
      }
      result_.mesh.triangles.push_back(triangle);
      result_.parts.push_back(part);
    }
  }

  const TriangleMesh& base_;
  PairedMesh result_;
  /// For the two ends of each halved side, the lower one first, the point in its middle.
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

}  // namespace

PairedMesh paired(const TriangleMesh& base) {
  const PairGraph graph = pairGraph(base);
  const Matching matching = bestPairs(base, graph);
  QuadBuilder builder(base);
  for (uint32_t t = 0; t < base.triangles.size(); ++t) {
    const uint32_t mate = matching[t];
    if (mate == t) builder.addAlone(t, graph.halved[t]);
    // Only a triangle with two equal corners may be without a mate.
    if (mate == kNoMate) builder.addAlone(t, 0);
    if (mate == kNoMate || mate <= t) continue;
    builder.addPair(t, sideTowards(graph, t, mate), mate, sideTowards(graph, mate, t));
  }
  return builder.take();
}

SurfacePoint onBase(const PairedMesh& paired, const SurfacePoint& place) {
  const TrianglePart& part = paired.parts[place.triangle];
  SurfacePoint result{part.triangle, {0, 0, 0}};
  for (size_t corner = 0; corner < 3; ++corner) {
    for (size_t k = 0; k < 3; ++k) {
      result.weights[k] += place.weights[corner] * part.corners[corner][k];
    }
  }
  return result;
}

}  // namespace tetrakis::inline remesh
