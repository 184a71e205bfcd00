// SPDX-License-Identifier: Apache-2.0
// Normals across seams.
#include "apps/tools/report/surface_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace tetrakis::tools {
namespace {

/// A grid of side x side vertices, with any heights.
struct Sheet {
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
};

Sheet sheet(std::mt19937& random, uint32_t side) {
  Sheet out;
  for (uint32_t row = 0; row < side; ++row)
    for (uint32_t column = 0; column < side; ++column)
      out.positions.insert(out.positions.end(),
                           {double(column), double(row), double(random() % 1000) / 500});
  for (uint32_t row = 0; row + 1 < side; ++row) {
    for (uint32_t column = 0; column + 1 < side; ++column) {
      const uint32_t a = row * side + column, b = a + 1, c = a + side, d = c + 1;
      out.triangles.insert(out.triangles.end(), {a, b, d, a, d, c});
    }
  }
  return out;
}

TEST(JoinedNormals, DoNotSeeWhereAMeshIsCut) {
  std::mt19937 random(1);
  for (const uint32_t side : {2u, 3u, 8u}) {
    const Sheet whole = sheet(random, side);
    const std::vector<float> expected = joinedNormals(whole.positions, whole.triangles);
    Sheet apart;  // each triangle for itself
    for (const uint32_t corner : whole.triangles) {
      apart.triangles.push_back(static_cast<uint32_t>(apart.triangles.size()));
      for (size_t k = 0; k < 3; ++k)
        apart.positions.push_back(whole.positions[size_t{3} * corner + k]);
    }
    const std::vector<float> normals = joinedNormals(apart.positions, apart.triangles);
    for (size_t i = 0; i < whole.triangles.size(); ++i)
      for (size_t k = 0; k < 3; ++k)
        EXPECT_EQ(normals[3 * i + k], expected[size_t{3} * whole.triangles[i] + k]);
  }
}

TEST(JoinedNormals, HaveLengthOneAndWeighAreas) {
  std::mt19937 random(2);
  const Sheet any = sheet(random, 6);
  const std::vector<float> normals = joinedNormals(any.positions, any.triangles);
  for (size_t i = 0; i < normals.size(); i += 3) {
    EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1, 1e-6);
    EXPECT_GT(normals[i + 2], 0);
  }
  // Two triangles at right angles; one has three times the area of the other.
  const std::vector<double> positions = {0, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 1};
  const std::vector<float> corner =
      joinedNormals(positions, std::vector<uint32_t>{0, 1, 2, 0, 3, 1});
  EXPECT_NEAR(corner[2] / corner[1], 3, 1e-6);
}

TEST(JoinedNormals, PointUpWhereThereIsNoArea) {
  const std::vector<double> positions = {1, 1, 1, 1, 1, 1, 2, 2, 2};
  EXPECT_EQ(joinedNormals(positions, std::vector<uint32_t>{0, 1, 2}),
            (std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0}));
}

}  // namespace
}  // namespace tetrakis::tools
