// SPDX-License-Identifier: Apache-2.0
// Traversal moves from node to node of a forest by one addition a step, so that no location code is
// decoded on the way (thesis 4.4.4).
//
// A traversal is a scaling to another level (4.23) followed by unit steps; a traversal path visits
// the nodes on the way. The coordinates of the first node are decoded once, then kept. Steps are
// toroidal over the whole forest: east of the last column is the first.
#pragma once

#include <cstdint>

#include "codec/mesh/quadtree/index_differences.hpp"

namespace tetrakis::inline quadtree {

/// A node that moves through a forest by steps. `differences` must outlive it.
class Traversal {
 public:
  Traversal(const IndexDifferences& differences, Square start)
      : differences_(&differences), square_(start), node_(differences.shape().nodeOf(start)) {}

  const Square& square() const { return square_; }
  uint32_t code() const { return shape().firstOf(square_.level) + node_; }
  /// Number within the level (QuadtreeShape::nodeOf): what the steps below add to.
  uint32_t node() const { return node_; }

  bool atEastBorder() const { return square_.column + 1 == shape().columnsOf(square_.level); }
  bool atSouthBorder() const { return square_.row + 1 == shape().rowsOf(square_.level); }

  Traversal& east() {  // (4.16)
    node_ += differences_->horizontal(square_.level, square_.column + 1);
    square_.column = atEastBorder() ? 0 : square_.column + 1;
    return *this;
  }
  Traversal& west() {  // (4.15)
    node_ -= differences_->horizontal(square_.level, square_.column);
    square_.column = (square_.column == 0 ? shape().columnsOf(square_.level) : square_.column) - 1;
    return *this;
  }
  Traversal& south() {  // (4.18)
    node_ += differences_->vertical(square_.level, square_.row + 1);
    square_.row = atSouthBorder() ? 0 : square_.row + 1;
    return *this;
  }
  Traversal& north() {  // (4.17)
    node_ -= differences_->vertical(square_.level, square_.row);
    square_.row = (square_.row == 0 ? shape().rowsOf(square_.level) : square_.row) - 1;
    return *this;
  }

  /// One level down: the scaling function (4.23). `child`: 0 ... 3 along the z-curve.
  Traversal& toChild(uint32_t child) {
    node_ = 4 * node_ + child;
    square_ = {square_.level + 1, 2 * square_.column + child % 2, 2 * square_.row + child / 2};
    return *this;
  }

 private:
  const QuadtreeShape& shape() const { return differences_->shape(); }

  const IndexDifferences* differences_;
  Square square_;
  uint32_t node_;
};

}  // namespace tetrakis::inline quadtree
