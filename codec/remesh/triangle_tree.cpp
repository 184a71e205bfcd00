// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/triangle_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace tetrakis::inline remesh {
namespace {

constexpr uint32_t kLeaf = 8;  ///< most triangles of a leaf, unless a run has more
constexpr size_t kBins = 8;    ///< equal parts of the longest axis, between which nodes are cut
/// Nodes that lie deeper are cut into halves of equal numbers. 2^32 triangles are halved at most 32
/// times, so that the stack of a search needs no more than kStack entries.
constexpr uint32_t kFreeDepth = 60;
constexpr size_t kStack = kFreeDepth + 36;

/// Half of the surface area of the box.
double surface(const Box& box) {
  const Point d = box.high - box.low;
  return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

double squaredDistance(const Box& box, const Point& point) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double outside =
        std::max({box.low[axis] - point[axis], point[axis] - box.high[axis], 0.0});
    sum += outside * outside;
  }
  return sum;
}

/// Tells whether a line meets boxes. Where rounding leaves a doubt the answer is true.
class BoxSight {
 public:
  explicit BoxSight(const Line& line) : line_(line) {
    for (size_t axis = 0; axis < 3; ++axis) inverse_[axis] = 1 / line.direction[axis];
  }

  bool meets(const Box& box) const {
    constexpr double kRounding = 1e-15;
    double first = line_.first, last = line_.last;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double low = box.low[axis] - line_.origin[axis];
      const double high = box.high[axis] - line_.origin[axis];
      if (!std::isfinite(inverse_[axis])) {  // the line hardly moves along this axis
        if (line_.direction[axis] == 0 && (low > 0 || high < 0)) return false;
        continue;
      }
      const double a = low * inverse_[axis], b = high * inverse_[axis];
      const double in = std::min(a, b), out = std::max(a, b);
      first = std::max(first, in - kRounding * std::abs(in));
      last = std::min(last, out + kRounding * std::abs(out));
    }
    return first <= last;
  }

 private:
  const Line& line_;
  Point inverse_;
};

}  // namespace

class TriangleTree::Builder {
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
  }

  void build() {
    const auto count = static_cast<uint32_t>(boxes_.size());
    if (count == 0) return;
    tree_.order_.resize(count);
    std::iota(tree_.order_.begin(), tree_.order_.end(), 0U);
    tree_.nodes_.reserve(count);
    tree_.nodes_.push_back({{}, 0, count});
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
    if (count <= leaf_) return false;
    const uint32_t half = depth < kFreeDepth ? part(begin, count, middles) : count / 2;
    const auto child = static_cast<uint32_t>(tree_.nodes_.size());
    tree_.nodes_[number].first = child;
    tree_.nodes_[number].count = 0;
    tree_.nodes_.push_back({{}, begin, half});
    tree_.nodes_.push_back({{}, begin + half, count - half});
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
  std::vector<Box> boxes_;  ///< one for each run
  uint32_t leaf_;           ///< most runs of a leaf
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
  if (!nodes_.empty()) stack[open++] = {0, squaredDistance(nodes_[0].box, point)};
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
    Task near{node.first, squaredDistance(nodes_[node.first].box, point)};
    Task far{node.first + 1, squaredDistance(nodes_[node.first + 1].box, point)};
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
    if (!boxes.meets(node.box)) continue;
    forEachOf(node, [&](uint32_t triangle) {
      if (const auto crossing = sight.crossing(*mesh_, triangle)) visit(*crossing);
    });
    if (node.count > 0) continue;
    stack[open++] = node.first + 1;
    stack[open++] = node.first;
  }
}

}  // namespace tetrakis::inline remesh
