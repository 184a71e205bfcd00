// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/cubic_matching.hpp"

#include <cstddef>
#include <functional>
#include <utility>

namespace tetrakis::inline remesh {
namespace {

/// Looks for an alternating path from a node without a mate: its first side is no pair, the second
/// is one, the third is none, and so on. The path may end at another node without a mate, or at a
/// node that may be alone. Then it is exchanged: its pairs are given up, and its other sides become
/// pairs. A node is an outer one if an alternating path of even length leads to it from the start,
/// and an inner one if only paths of odd length do. A side between two outer nodes closes an odd
/// cycle, a blossom. All nodes of a blossom are outer ones, and it counts as one node, its base.
class PathSearch {
 public:
  PathSearch(const CubicGraph& graph, const std::vector<bool>& may_be_alone, Matching& matching)
      : graph_(graph),
        may_be_alone_(may_be_alone),
        mate_(matching),
        places_(graph.size()),
        before_(graph.size(), kNoMate),
        base_(graph.size()),
        mark_(graph.size(), 0) {
    for (uint32_t node = 0; node < base_.size(); ++node) base_[node] = node;
  }

  /// Matches `root` if that is possible. If it is not, no path will ever lead through the nodes
  /// that were reached, whatever is matched later, so that later searches leave them out.
  void matchFrom(uint32_t root) {
    reached_.clear();
    outer_.clear();
    addOuter(root);
    bool found = false;
    for (size_t next = 0; next < outer_.size() && !found; ++next) {
      const uint32_t node = outer_[next];
      found = may_be_alone_[node];
      if (found) exchange(node, node);
      for (size_t k = 0; k < 3 && !found; ++k) {
        const uint32_t neighbour = graph_[node][k];
        if (neighbour != kNoMate) found = visit(node, neighbour);
      }
    }
    if (found) forget();
  }

 private:
  enum class Place : uint8_t { unseen, outer, inner };

  void addOuter(uint32_t node) {
    if (places_[node] == Place::unseen) reached_.push_back(node);
    places_[node] = Place::outer;
    outer_.push_back(node);
  }

  /// Goes from an outer node to a neighbour. True if a path ended there and has been exchanged.
  bool visit(uint32_t node, uint32_t neighbour) {
    if (places_[neighbour] == Place::inner || mate_[neighbour] == neighbour) return false;
    if (places_[neighbour] == Place::outer) {
      if (baseOf(node) == baseOf(neighbour)) return false;
      const uint32_t base = commonBase(node, neighbour);
      shrink(node, neighbour, base);
      shrink(neighbour, node, base);
      return false;
    }
    if (mate_[neighbour] == kNoMate) {
      exchange(neighbour, node);
      return true;
    }
    places_[neighbour] = Place::inner;
    before_[neighbour] = node;
    reached_.push_back(neighbour);
    addOuter(mate_[neighbour]);
    return false;
  }

  /// Exchanges the path from the root to the outer node `node` and on to `end`. If the two are the
  /// same, this node becomes alone.
  void exchange(uint32_t end, uint32_t node) {
    while (true) {
      const uint32_t next = mate_[node];
      mate_[end] = node;
      mate_[node] = end;
      if (next == kNoMate) return;
      end = next;
      node = before_[end];
    }
  }

  uint32_t baseOf(uint32_t node) {
    while (base_[node] != node) node = base_[node] = base_[base_[node]];
    return node;
  }

  /// The last base that the paths from the root to two outer nodes have in common.
  uint32_t commonBase(uint32_t a, uint32_t b) {
    ++time_;
    a = baseOf(a);
    b = baseOf(b);
    while (mark_[a] != time_) {
      mark_[a] = time_;
      a = mate_[a] == kNoMate ? kNoMate : baseOf(before_[mate_[a]]);
      if (b != kNoMate) std::swap(a, b);  // otherwise the path of b has come to the root
    }
    return a;
  }

  /// Makes the nodes from `node` back to `base` a part of a blossom. `other` is the node after
  /// `node` in the cycle of the blossom.
  void shrink(uint32_t node, uint32_t other, uint32_t base) {
    while (baseOf(node) != base) {
      before_[node] = other;
      other = mate_[node];
      if (places_[other] == Place::inner) addOuter(other);
      if (base_[node] == node) base_[node] = base;
      if (base_[other] == other) base_[other] = base;
      node = before_[other];
    }
  }

  void forget() {
    for (const uint32_t node : reached_) {
      places_[node] = Place::unseen;
      base_[node] = node;
    }
  }

  const CubicGraph& graph_;
  const std::vector<bool>& may_be_alone_;
  Matching& mate_;
  std::vector<Place> places_;
  /// For an inner node the outer node before it. Nodes of a blossom: the next node on the other way
  /// round its cycle.
  std::vector<uint32_t> before_;
  std::vector<uint32_t> base_;  ///< a step towards the base of a node's blossom
  std::vector<uint32_t> mark_;  ///< the time when commonBase() last came to a node
  uint32_t time_ = 0;
  std::vector<uint32_t> reached_, outer_;
};

}  // namespace

void completeMatching(const CubicGraph& graph, const std::vector<bool>& may_be_alone,
                      Matching& matching) {
  const std::vector<bool> none(graph.size());
  for (const std::vector<bool>& alone : {std::cref(none), std::cref(may_be_alone)}) {
    PathSearch search(graph, alone, matching);
    for (uint32_t node = 0; node < graph.size(); ++node) {
      if (matching[node] == kNoMate) search.matchFrom(node);
    }
  }
}

}  // namespace tetrakis::inline remesh
