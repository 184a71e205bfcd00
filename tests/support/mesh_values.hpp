// SPDX-License-Identifier: Apache-2.0
// How the names and the failures of tests show the values of meshes and of the quadtree.
#pragma once

#include <ostream>

#include "codec/mesh/closure/closure.hpp"

#include "codec/mesh/decimation/worth.hpp"
#include "codec/mesh/quadtree/semilinear_quadtree.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis {

inline std::ostream& operator<<(std::ostream& out, const Site& v) {
  return out << "level " << v.level << ", column " << v.column << ", row " << v.row;
}

inline std::ostream& operator<<(std::ostream& out, const Worth& worth) {
  return out << "distortion " << worth.distortion << ", cost " << worth.cost;
}

inline std::ostream& operator<<(std::ostream& out, const Square& square) {
  return out << "level " << square.level << ", column " << square.column << ", row " << square.row;
}

inline std::ostream& operator<<(std::ostream& out, const QuadtreeShape& shape) {
  return out << shape.columns << " x " << shape.rows << " patches of depth " << shape.depth;
}

inline std::ostream& operator<<(std::ostream& out, const QuadtreePlace& place) {
  constexpr const char* kTrees[] = {"node", "row of the eastern border",
                                    "column of the southern border"};
  constexpr const char* kVertices[] = {"centre", "north", "west"};
  return out << kVertices[place.vertex] << " of " << kTrees[place.tree] << " " << place.node
             << " on level " << int{place.level};
}

inline std::ostream& operator<<(std::ostream& out, LevelForm form) {
  constexpr const char* kNames[] = {"sparse", "dense", "array"};
  return out << kNames[static_cast<size_t>(form)];
}

}  // namespace tetrakis
