// SPDX-License-Identifier: Apache-2.0
// Surfaces of square patches: what their sides are glued to, and how many samples they have.
#pragma once

#include <string>
#include <vector>

#include "base/forest.hpp"

namespace tetrakis::test {

struct ForestShape {
  std::string name;
  std::vector<uint32_t> sides;
  int euler;            ///< the Euler characteristic
  uint32_t border = 0;  ///< half of the sides that are not glued

  uint32_t patches() const { return static_cast<uint32_t>(sides.size()) / Forest::kSides; }
  size_t samples(int depth) const {
    return (size_t{patches()} << 2 * depth) + (size_t{border} << depth) +
           static_cast<size_t>(euler);
  }
};

/// Rows and columns of patches that hang together.
inline ForestShape planeShape(uint32_t rows, uint32_t columns) {
  ForestShape shape{std::to_string(rows) + "x" + std::to_string(columns), {}, 1, rows + columns};
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t first = Forest::kSides * (row * columns + column);
      const uint32_t below = Forest::kSides * columns;
      shape.sides.push_back(row > 0 ? first - below + 2 : Forest::kBorder);
      shape.sides.push_back(column + 1 < columns ? first + 7 : Forest::kBorder);
      shape.sides.push_back(row + 1 < rows ? first + below : Forest::kBorder);
      shape.sides.push_back(column > 0 ? first - 3 : Forest::kBorder);
    }
  }
  return shape;
}

inline ForestShape torusShape() {
  return {"torus", {2, 3, 0, 1}, 0};
}

/// Two patches with a pole in the middle of each (the thesis of L. Balmelli, section 4.6).
inline ForestShape octahedronShape() {
  return {"octahedron", {5, 4, 7, 6, 1, 0, 3, 2}, 2};
}

inline ForestShape cylinderShape() {
  return {"cylinder", {Forest::kBorder, 3, Forest::kBorder, 1}, 0, 1};
}

/// Two sides of one corner that are glued, so that one patch meets itself.
inline ForestShape coneShape() {
  return {"cone", {3, Forest::kBorder, Forest::kBorder, 0}, 1, 1};
}

inline ForestShape cubeShape() {
  return {"cube",
          {18, 7, 20, 13, 17, 11, 21, 1, 16, 15, 22, 5, 19, 3, 23, 9, 8, 4, 0, 12, 2, 6, 10, 14},
          2};
}

inline std::vector<ForestShape> forestShapes() {
  return {planeShape(1, 1), planeShape(2, 2),  planeShape(2, 3), torusShape(),
          cylinderShape(),  octahedronShape(), coneShape(),      cubeShape()};
}

}  // namespace tetrakis::test
