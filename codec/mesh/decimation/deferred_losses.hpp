// SPDX-License-Identifier: Apache-2.0
// DeferredLosses notes what removed vertices take from the domains of coarse vertices, and sums a
// loss up only when it is asked for. Coarse vertices are few but the ancestors of all others, so
// updating each of them at every removal would take long.
//
// Vertices with the same ancestors on one level of squares share all ancestors above it. So the
// amount that they take from the domains above that level is stored once for each such set of
// squares. A set lies within 3 x 3 cells and has one of some thirty shapes for each parity of its
// place. The loss of a coarse vertex is the sum over the sets that meet its octagon.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/mesh/decimation/worth.hpp"
#include "codec/mesh/topology/ancestors.hpp"

namespace tetrakis::inline decimation {

class DeferredLosses {
 public:
  /// level: a level of squares. The lattice must outlive this object.
  DeferredLosses(const Lattice& lattice, uint32_t level);

  uint32_t level() const { return level_; }
  /// All ancestors of these squares of level() lose `worth`, each once.
  void add(const AncestorWindow& squares, const Worth& worth) { slot(squares) += worth; }
  void takeBack(const AncestorWindow& squares, const Worth& worth) { slot(squares) -= worth; }
  /// The sum of all losses so far of v, a vertex above level().
  Worth of(Site v) const;

 private:
  /// losses: of all places of one kind, row by row.
  struct Shape {
    uint32_t cells;
    std::vector<Worth> losses;
  };
  /// Places with columns and rows of one parity each.
  struct Kind {
    std::array<uint8_t, 512> index;  ///< of the shape of some cells
    std::vector<Shape> shapes;
  };
  static constexpr uint8_t kNoShape = 0xff;

  Worth& slot(const AncestorWindow& squares);
  uint8_t addShape(Kind& kind, uint32_t cells) const;
  Worth sumOfRow(size_t x, size_t y, const std::vector<uint32_t>& wanted) const;

  const Lattice* lattice_;
  uint32_t level_;
  size_t columns_ = 0, rows_ = 0;  ///< of places of one kind; the first place is square (-1, -1)
  std::array<Kind, 4> kinds_;
};

}  // namespace tetrakis::inline decimation
