// SPDX-License-Identifier: Apache-2.0
// unwrap() cuts a shape into charts and lays these flat in a square, and paint() fills the square:
// the atlas that scanners and modelling programs make.
#pragma once

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/surfaces/shape.hpp"

namespace tetrakis::tools::synth {

/// Where triangles lie in the square [0, 1]².
struct Atlas {
  std::vector<std::array<double, 2>> places;  ///< of corners, 3 a triangle
  std::vector<uint32_t> charts;               ///< of triangles
  std::vector<bool> borders;                  ///< triangles with a side that ends their chart
};

/// How charts grow from their first triangle.
struct ChartLimits {
  double least_cosine;  ///< between its normal and that of any other, above 0
  size_t most_triangles;
};

Atlas unwrap(const TriangleMesh& shape, const ChartLimits& limits);

/// RGB8, side x side texels: the colours of a stone, by the place in space, some texels beyond the
/// borders of charts; grey elsewhere.
ImageFile paint(const TriangleMesh& shape, const Atlas& atlas, uint32_t side, uint64_t seed);

}  // namespace tetrakis::tools::synth
