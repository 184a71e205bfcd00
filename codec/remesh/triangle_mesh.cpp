// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/triangle_mesh.hpp"

#include <algorithm>

namespace tetrakis::inline remesh {

double diagonal(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return 0;
  Point low = mesh.points.front(), high = low;
  for (const Point& point : mesh.points) {
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  return length(high - low);
}

}  // namespace tetrakis::inline remesh
