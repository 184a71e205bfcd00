// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/triangle_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>

namespace tetrakis::inline remesh {
namespace {

constexpr uint32_t kLeaf = 8;        ///< most triangles of a leaf, unless a run has more
constexpr double kLongNeedle = 0.5;  ///< in parts of the diagonal of a node that is turned along it
constexpr double kThin = 0.25;       ///< turned boxes are thinner, in parts of the diagonal
constexpr double kTurnRounding = 1e-9;  ///< they are enlarged by so many of these
constexpr size_t kBins = 8;  ///< equal parts of the longest axis, between which nodes are cut
/// Nodes that lie deeper are cut into halves of equal numbers. 2^32 triangles are halved at most 32
/// times, so that the stack of a search needs no more than kStack entries.
constexpr uint32_t kFreeDepth = 60;
constexpr size_t kStack = kFreeDepth + 36;

/// Half of the surface area of the box.
double surface(const Box& box) {
  const Point d = box.high - box.low;
  return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

}  // namespace

class TriangleTree::Builder {
  struct Needle {
    double square = 0;  // of its length; 0: there is none
    uint32_t triangle = 0;
  };

 public:
  explicit Builder(TriangleTree& tree)
      : tree_(tree),
        boxes_((tree.mesh_->triangles.size() + tree.together_ - 1) / tree.together_),
        leaf_(std::max(1u, kLeaf / tree.together_)) {
    for (size_t t = 0; t < tree.mesh_->triangles.size(); ++t) {
      for (const uint32_t corner : tree.mesh_->triangles[t]) {
        const Point& point = tree.mesh_->points[corner];
        boxes_[t / tree.together_].add({point, point});
      }
    }
    findNeedles();
  }

  void build() {
    const auto count = static_cast<uint32_t>(boxes_.size());
    if (count == 0) return;
    tree_.order_.resize(count);
    std::iota(tree_.order_.begin(), tree_.order_.end(), 0U);
    tree_.nodes_.reserve(count);
    tree_.nodes_.push_back({{}, kNone, 0, count});
    std::vector<std::pair<uint32_t, uint32_t>> open{{0, 0}};  // nodes to cut, and their depths
    while (!open.empty()) {
      const auto [node, depth] = open.back();
      open.pop_back();
      if (!split(node, depth)) continue;
      const uint32_t child = tree_.nodes_[node].first;
      open.emplace_back(child + 1, depth + 1);
      open.emplace_back(child, depth + 1);
    }
    tree_.nodes_.shrink_to_fit();
  }

 private:
  void findNeedles() {
    const TriangleMesh& mesh = *tree_.mesh_;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const double square = needleSquare(mesh, mesh.triangles[t]);
      if (square == 0) continue;
      if (needles_.empty()) needles_.resize(boxes_.size());
      Needle& longest = needles_[t / tree_.together_];
      if (square > longest.square) longest = {square, t};
      longest_ = std::max(longest_, square);
    }
  }

  /// Gives a node a box along its longest needle, if that helps.
  void addTurnedBox(Node& node) {
    const double diagonal = length(node.box.high - node.box.low);
    const double least = kLongNeedle * kLongNeedle * diagonal * diagonal;
    if (!(longest_ > least)) return;
    Needle longest;
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Needle& needle = needles_[tree_.order_[i]];
      if (needle.square > longest.square) longest = needle;
    }
    if (!(longest.square > least)) return;
    const TriangleMesh& mesh = *tree_.mesh_;
    std::optional<TurnedBox> turned = boxAlong(mesh, mesh.triangles[longest.triangle]);
    if (!turned) return;
    tree_.forEachOf(node, [&](uint32_t triangle) {
      for (const uint32_t corner : mesh.triangles[triangle]) turned->add(mesh.points[corner]);
    });
    Box& box = turned->box;
    if (!(box.high[1] - box.low[1] < kThin * diagonal)) return;
    for (size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] -= kTurnRounding * diagonal;
      box.high[axis] += kTurnRounding * diagonal;
    }
    node.turned = static_cast<uint32_t>(tree_.turned_.size());
    tree_.turned_.push_back(*turned);
  }

  /// The centre of a run's box.
  Point middle(uint32_t run) const { return 0.5 * boxes_[run].low + 0.5 * boxes_[run].high; }

  /// Sets the box of a node and cuts it, unless it has few triangles: then it stays a leaf, and
  /// the result is false.
  bool split(uint32_t number, uint32_t depth) {
    const uint32_t begin = tree_.nodes_[number].first, count = tree_.nodes_[number].count;
    Box all, middles;
    for (uint32_t i = begin; i < begin + count; ++i) {
      const Point center = middle(tree_.order_[i]);
      all.add(boxes_[tree_.order_[i]]);
      middles.add({center, center});
    }
    tree_.nodes_[number].box = all;
    addTurnedBox(tree_.nodes_[number]);
    if (count <= leaf_) return false;
    const uint32_t half = depth < kFreeDepth ? part(begin, count, middles) : count / 2;
    const auto child = static_cast<uint32_t>(tree_.nodes_.size());
    tree_.nodes_[number].first = child;
    tree_.nodes_[number].count = 0;
    tree_.nodes_.push_back({{}, kNone, begin, half});
    tree_.nodes_.push_back({{}, kNone, begin + half, count - half});
    return true;
  }

  /// Sorts the runs of a node into two parts. Returns the size of the first part, which is
  /// above 0 and below `count`.
  uint32_t part(uint32_t begin, uint32_t count, const Box& middles) {
    const Point sides = middles.high - middles.low;
    const auto axis =
        static_cast<size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    const double low = middles.low[axis], scale = kBins / sides[axis];
    const auto binOf = [&](uint32_t run) {
      const double bin = (middle(run)[axis] - low) * scale;
      return bin < kBins ? static_cast<size_t>(bin) : kBins - 1;  // also where it is not a number
    };
    const size_t cut = bestCut(begin, count, binOf);
    uint32_t end = begin;
    for (uint32_t i = begin; i < begin + count; ++i) {
      if (binOf(tree_.order_[i]) < cut) std::swap(tree_.order_[i], tree_.order_[end++]);
    }
    const uint32_t size = end - begin;
    return size > 0 && size < count ? size : count / 2;
  }

  /// The cheapest cut, as the number of the first bin behind it.
  template <class BinOf>
  size_t bestCut(uint32_t begin, uint32_t count, const BinOf& binOf) const {
    std::array<Box, kBins> boxes;
    std::array<uint32_t, kBins> counts{};
    for (uint32_t i = begin; i < begin + count; ++i) {
      const size_t bin = binOf(tree_.order_[i]);
      boxes[bin].add(boxes_[tree_.order_[i]]);
      ++counts[bin];
    }
    const std::array<double, kBins> below = costs(boxes, counts);
    std::reverse(boxes.begin(), boxes.end());
    std::reverse(counts.begin(), counts.end());
    const std::array<double, kBins> above = costs(boxes, counts);
    size_t best = 1;
    for (size_t cut = 2; cut < kBins; ++cut) {
      const auto cost = [&](size_t at) { return below[at - 1] + above[kBins - 1 - at]; };
      if (cost(cut) < cost(best)) best = cut;
    }
    return best;
  }

  /// For each bin the cost of all bins up to it as one node: the number of their runs times
  /// the surface area of their box.
  static std::array<double, kBins> costs(const std::array<Box, kBins>& boxes,
                                         const std::array<uint32_t, kBins>& counts) {
    std::array<double, kBins> result{};
    Box box;
    uint32_t count = 0;
    for (size_t bin = 0; bin < kBins; ++bin) {
      box.add(boxes[bin]);
      count += counts[bin];
      result[bin] = count > 0 ? count * surface(box) : 0;
    }
    return result;
  }

  TriangleTree& tree_;
  std::vector<Box> boxes_;       ///< one for each run
  uint32_t leaf_;                ///< most runs of a leaf
  std::vector<Needle> needles_;  ///< of each run the longest; empty: there is none
  double longest_ = 0;           ///< the square of the longest one of all
};

TriangleTree::TriangleTree(const TriangleMesh& mesh, uint32_t together)
    : mesh_(&mesh), together_(together) {
  Builder(*this).build();
}

template <class Visit>
void TriangleTree::forEachOf(const Node& leaf, const Visit& visit) const {
  const auto all = static_cast<uint32_t>(mesh_->triangles.size());
  for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const uint32_t first = order_[i] * together_;
    for (uint32_t t = first; t < std::min(first + together_, all); ++t) visit(t);
  }
}

std::optional<NearPlace> TriangleTree::closest(const Point& point, double bound) const {
  struct Task {
    uint32_t node;
    double square;
  };
  std::optional<NearPlace> best;
  std::array<Task, kStack> stack;
  size_t open = 0;
  const auto squareOf = [&](uint32_t node) {
    const double square = squaredDistance(nodes_[node].box, point);
    const TurnedBox* const turned = turnedOf(nodes_[node]);
    return turned == nullptr ? square
                             : std::max(square, squaredDistance(turned->box, turned->place(point)));
  };
  if (!nodes_.empty()) stack[open++] = {0, squareOf(0)};
  while (open > 0) {
    const Task task = stack[--open];
    if (!(task.square <= bound * bound)) continue;
    const Node& node = nodes_[task.node];
    forEachOf(node, [&](uint32_t triangle) {
      const NearPlace found = nearestInTriangle(*mesh_, triangle, point);
      if (!(found.distance <= bound)) return;
      const bool same = best && found.distance == best->distance;
      if (same && found.place.triangle > best->place.triangle) return;
      best = found;
      bound = found.distance;
    });
    if (node.count > 0) continue;
    Task near{node.first, squareOf(node.first)};
    Task far{node.first + 1, squareOf(node.first + 1)};
    if (far.square < near.square) std::swap(near, far);
    stack[open++] = far;
    stack[open++] = near;
  }
  return best;
}

void TriangleTree::crossings(const Line& line,
                             const std::function<void(const Crossing&)>& visit) const {
  const LineSight sight(line);
  const BoxSight boxes(line);
  std::array<uint32_t, kStack> stack;
  size_t open = 0;
  if (!nodes_.empty()) stack[open++] = 0;
  while (open > 0) {
    const Node& node = nodes_[stack[--open]];
    const TurnedBox* const turned = turnedOf(node);
    if (!boxes.meets(node.box) || (turned != nullptr && !boxes.meets(*turned))) continue;
    forEachOf(node, [&](uint32_t triangle) {
      if (const auto crossing = sight.crossing(*mesh_, triangle)) visit(*crossing);
    });
    if (node.count > 0) continue;
    stack[open++] = node.first + 1;
    stack[open++] = node.first;
  }
}

}  // namespace tetrakis::inline remesh
