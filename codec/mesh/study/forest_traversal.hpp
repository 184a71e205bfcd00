// SPDX-License-Identifier: Apache-2.0
// ForestTraversal goes from node to node of a forest of quadtrees whose patches are glued in any
// way (thesis 4.6): within a patch by one addition to a code, as location_code.hpp has it, and over
// a side by a rotation of the interleaved coordinates.
//
// A node is the number of its patch and a code in the quadtree of that patch. All codes of a forest
// are one range, that of QuadtreeShape for patches in a row; only what lies beyond a side differs:
//
//   side t that is entered   column   row     k' = k, the node along the side that is left, or
//   0 north                  k'       0       n - 1 - k, where both sides run clockwise or both do
//   1 east                   n - 1    k'      not; n = 2^level. What is ahead turns by t - s + 2
//   2 south                  k'       n - 1   quarters, s the side that is left: the thesis writes
//   3 west                   0        k'      (E, N) for s = east and t = north.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/forest.hpp"
#include "codec/mesh/quadtree/location_code.hpp"

namespace tetrakis::inline study {

/// A side of a node, as Forest numbers those of a patch; also the way out over it.
enum class Heading : uint8_t { kNorth, kEast, kSouth, kWest };

/// quarters: clockwise.
constexpr Heading turned(Heading heading, uint32_t quarters) {
  return static_cast<Heading>((static_cast<uint32_t>(heading) + quarters) % Forest::kSides);
}

/// A node by its place: the columns and rows of `square` are those of the patch.
struct ForestNode {
  uint32_t patch = 0;
  Square square;
  bool operator==(const ForestNode&) const = default;
};

/// What lies behind the sides of patches, and the codes of nodes.
class ForestAdjacency {
 public:
  /// Behind a side: a side of another patch, or of the same.
  struct Crossing {
    uint32_t patch = Forest::kBorder;  ///< kBorder: none
    Heading side = Heading::kNorth;
    uint8_t quarters = 0;   ///< that headings turn by
    bool reversed = false;  ///< the sides run in opposite directions
    bool keeps = true;      ///< the patch that is left stores the vertices of the side
  };

  /// A forest of so few and so shallow patches that codes stay below 2^32.
  explicit ForestAdjacency(const Forest& forest);

  const QuadtreeShape& codes() const { return codes_; }
  const IndexDifferences& differences() const { return differences_; }
  uint32_t depth() const { return codes_.depth; }
  uint32_t patches() const { return codes_.columns; }
  const Crossing& crossing(uint32_t patch, Heading side) const {
    return crossings_[size_t{patch} * Forest::kSides + static_cast<uint32_t>(side)];
  }

  uint32_t codeOf(const ForestNode& node) const {
    const auto [level, column, row] = node.square;
    return codes_.codeOf({level, (node.patch << level) + column, row});
  }
  ForestNode nodeOf(uint32_t code) const {
    const auto [level, column, row] = codes_.squareOf(code);
    return {column >> level, {level, column & ((1u << level) - 1), row}};
  }

 private:
  QuadtreeShape codes_;           ///< of patches in a row
  IndexDifferences differences_;  ///< of one patch
  std::vector<Crossing> crossings_;
};

/// A node that moves through a forest by steps. `adjacency` must outlive it.
class ForestTraversal {
 public:
  ForestTraversal(const ForestAdjacency& adjacency, const ForestNode& start)
      : adjacency_(&adjacency),
        at_(start),
        local_(adjacency.differences().shape().nodeOf(start.square)) {}

  const ForestNode& node() const { return at_; }
  /// The number of the node within its level and its patch: what steps add to.
  uint32_t local() const { return local_; }
  uint32_t code() const {
    const uint32_t level = at_.square.level;
    return adjacency_->codes().firstOf(level) + (at_.patch << 2 * level) + local_;
  }
  /// The side of the patch that a heading of the first patch leads to by now.
  Heading ahead(Heading heading) const { return turned(heading, quarters_); }

  /// To the neighbour of the same size over a side, which the first patch names so: paths are
  /// straight wherever they lead. At a border the answer is false, and the node stays.
  bool step(Heading heading);

  /// One level down. `child`: 0 … 3 along the z-curve of the patch.
  ForestTraversal& toChild(uint32_t child) {
    Square& square = at_.square;
    local_ = 4 * local_ + child;
    square = {square.level + 1, 2 * square.column + child % 2, 2 * square.row + child / 2};
    return *this;
  }

 private:
  bool cross(Heading side);

  const ForestAdjacency* adjacency_;
  ForestNode at_;
  uint32_t local_;
  uint32_t quarters_ = 0;  ///< of the patch's headings, clockwise from those of the first patch
};

inline bool ForestTraversal::step(Heading heading) {
  const IndexDifferences& differences = adjacency_->differences();
  auto& [level, column, row] = at_.square;
  const uint32_t last = (1u << level) - 1;
  const Heading side = ahead(heading);
  switch (side) {
    case Heading::kNorth:
      if (row == 0) return cross(side);
      local_ -= differences.vertical(level, row--);
      return true;
    case Heading::kEast:
      if (column == last) return cross(side);
      local_ += differences.horizontal(level, ++column);
      return true;
    case Heading::kSouth:
      if (row == last) return cross(side);
      local_ += differences.vertical(level, ++row);
      return true;
    case Heading::kWest:
      if (column == 0) return cross(side);
      local_ -= differences.horizontal(level, column--);
      return true;
  }
  return false;
}

inline bool ForestTraversal::cross(Heading side) {
  const ForestAdjacency::Crossing& over = adjacency_->crossing(at_.patch, side);
  if (over.patch == Forest::kBorder) return false;
  auto& [level, column, row] = at_.square;
  const uint32_t last = (1u << level) - 1;
  const bool is_row = side == Heading::kNorth || side == Heading::kSouth;
  const uint32_t before = is_row ? column : row;
  const uint32_t along = over.reversed ? last - before : before;
  column = row = along;
  if (over.side == Heading::kNorth) row = 0;
  if (over.side == Heading::kEast) column = last;
  if (over.side == Heading::kSouth) row = last;
  if (over.side == Heading::kWest) column = 0;
  at_.patch = over.patch;
  local_ = dilate(column) + 2 * dilate(row);
  quarters_ += over.quarters;
  return true;
}

}  // namespace tetrakis::inline study
