// SPDX-License-Identifier: Apache-2.0
// Triangle meshes: their sizes and places on them.
#include "codec/remesh/triangle_mesh.hpp"

#include <gtest/gtest.h>

namespace tetrakis {
namespace {

TEST(TriangleMeshes, HaveADiagonalThatMovingDoesNotChange) {
  TriangleMesh mesh{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 12}}, {{0, 1, 2}, {0, 1, 3}}};
  EXPECT_DOUBLE_EQ(diagonal(mesh), 13);
  for (Point& point : mesh.points) point = point + Point{-7, 5, 2};
  EXPECT_DOUBLE_EQ(diagonal(mesh), 13);
  EXPECT_EQ(diagonal({}), 0);
}

TEST(TriangleMeshes, PlacesAreMeansOfCorners) {
  const TriangleMesh mesh{{{0, 0, 0}, {3, 0, 0}, {0, 6, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(at(mesh, {0, {0.25, 0.25, 0.5}}), (Point{0.75, 3, 0}));
  EXPECT_EQ(areaNormal(mesh, mesh.triangles[0]), (Point{0, 0, 18}));
}

}  // namespace
}  // namespace tetrakis
