// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/pair_exchange.hpp"

#include <algorithm>
#include <cstddef>

namespace tetrakis::inline remesh {
namespace {

constexpr size_t kExchangedPairs = 12;  ///< most pairs of one exchange
constexpr int kExchangeRounds = 20;     ///< most rounds over all triangles; 4 to 8 are usual
constexpr double kLeastGain = 1e-9;     ///< an exchange lowers the badness by more than that

/// Triangles of which each is a neighbour of the next one. Before the exchange the second and third
/// are a pair, the fourth and fifth, and so on. The first one is alone, or its mate is the last
/// one. After the exchange the first and second are a pair, the third and fourth, and so on. If
/// their number is odd, the last one is alone then.
struct ExchangePath {
  std::array<uint32_t, 2 * kExchangedPairs + 1> triangles{};
  size_t length = 0;

  uint32_t back() const { return triangles[length - 1]; }
  void add(uint32_t triangle) { triangles[length++] = triangle; }
  bool holds(uint32_t triangle) const {
    const auto end = triangles.begin() + static_cast<ptrdiff_t>(length);
    return std::find(triangles.begin(), end, triangle) != end;
  }
};

class Exchange {
 public:
  Exchange(const TriangleMesh& mesh, const PairGraph& graph, Matching& matching)
      : mesh_(mesh), graph_(graph), mate_(matching), quads_(mesh.points.size(), 0) {
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t neighbour = graph.neighbours[t][k];
        if (neighbour != kNoMate && neighbour > t && neighbour != mate_[t]) addSide(t, k, 1);
      }
    }
  }

  /// Looks for an exchange from each triangle. True if it has made at least one.
  bool round() {
    bool better = false;
    for (uint32_t t = 0; t < mate_.size(); ++t) {
      if (mate_[t] == kNoMate || mate_[t] < t) continue;
      best_ = {};
      gain_ = kLeastGain;
      ExchangePath path;
      path.add(t);
      search(path, badness(t, mate_[t]));
      if (best_.length == 0) continue;
      apply(best_);
      better = true;
    }
    return better;
  }

 private:
  double badness(uint32_t triangle, uint32_t mate) const {
    return graph_.badness[triangle][sideTowards(graph_, triangle, mate)];
  }

  /// Continues a path of odd length from its last triangle in all ways that gain. `gain` is the
  /// badness of the pairs that the path takes apart less the badness of those that it makes. The
  /// recursion is at most as deep as a path is long.
  void search(const ExchangePath& path, double gain) {
    const uint32_t last = path.back(), end = mate_[path.triangles[0]];
    for (const uint32_t next : graph_.neighbours[last]) {
      if (next == kNoMate || path.holds(next) || next == mate_[last]) continue;
      if (mate_[next] == kNoMate || mate_[next] == next) continue;
      const double paired = gain - badness(last, next);
      if (paired <= 0) continue;
      ExchangePath longer = path;
      longer.add(next);
      if (next == end) {
        offer(longer, paired);
      } else {
        longer.add(mate_[next]);
        goOn(longer, paired + badness(next, mate_[next]));
      }
    }
  }

  /// A path that ends with both triangles of a pair: it may end there, or continue.
  void goOn(const ExchangePath& path, double gain) {
    const uint32_t last = path.back(), start = path.triangles[0];
    const bool alone = mate_[start] == start;
    if (alone && graph_.halved[last] < 3) offer(path, gain - badness(last, last));
    if (path.length < path.triangles.size()) search(path, gain);
  }

  /// Keeps the path if its exchange gains more than the best one so far, points included.
  void offer(const ExchangePath& path, double gain) {
    const double total = gain - changePoints(path, 1);
    changePoints(path, -1);
    if (total <= gain_) return;
    gain_ = total;
    best_ = path;
  }

  void apply(const ExchangePath& path) {
    changePoints(path, 1);
    for (size_t i = 0; i < path.length; i += 2) {
      const uint32_t triangle = path.triangles[i];
      const uint32_t mate = i + 1 < path.length ? path.triangles[i + 1] : triangle;
      mate_[triangle] = mate;
      mate_[mate] = triangle;
    }
  }

  /// Changes the counts of quads at points to those after the exchange (`sign` 1), or back to those
  /// before it (-1). Returns by how much the badness of the points grows.
  double changePoints(const ExchangePath& path, int sign) {
    double worse = 0;
    for (size_t i = 0; i + 1 < path.length; ++i) {
      const uint32_t triangle = path.triangles[i];
      const size_t side = sideTowards(graph_, triangle, path.triangles[i + 1]);
      worse += addSide(triangle, side, i % 2 == 0 ? -sign : sign);
    }
    if (path.length % 2 != 0) return worse;
    return worse + addSide(path.back(), sideTowards(graph_, path.back(), path.triangles[0]), sign);
  }

  /// Adds `count` sides to both ends of a side. Returns by how much the badness of the ends grows.
  double addSide(uint32_t triangle, size_t side, int count) {
    double worse = 0;
    for (const size_t corner : {side, (side + 1) % 3}) {
      const uint32_t point = mesh_.triangles[triangle][corner];
      if (graph_.at_border[point]) continue;
      worse += pointBadness(quads_[point] + count) - pointBadness(quads_[point]);
      quads_[point] += count;
    }
    return worse;
  }

  const TriangleMesh& mesh_;
  const PairGraph& graph_;
  Matching& mate_;
  std::vector<int> quads_;  ///< how many meet in each point; 0 at the border
  ExchangePath best_;       ///< the best path that was offered; empty if there is none
  double gain_ = 0;         ///< what best_ gains
};

}  // namespace

double pointBadness(int quads) {
  return quads == 2 ? 1 : 0.05 * (quads - 4) * (quads - 4);
}

void exchangePairs(const TriangleMesh& mesh, const PairGraph& graph, Matching& matching) {
  Exchange exchange(mesh, graph, matching);
  for (int round = 0; round < kExchangeRounds && exchange.round(); ++round) continue;
}

}  // namespace tetrakis::inline remesh
