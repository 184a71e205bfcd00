// SPDX-License-Identifier: Apache-2.0
// Base meshes: their codewords, and the surfaces that they are bent to.
#include "codec/basemesh/base_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "codec/basemesh/bent_base.hpp"
#include "codec/cube/cube_sphere.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

/// Corners anywhere in the grid.
BaseMesh anyMesh(int depth, std::vector<uint32_t> sides, int bits, uint32_t seed) {
  std::mt19937 random(seed);
  BaseMesh mesh{
      std::make_shared<const Forest>(depth, std::move(sides)), bits, {}, {1, -2, 0.5}, 0.25};
  const std::vector<uint32_t> owners = cornerOwners(*mesh.forest);
  for (size_t corner = 0; corner < owners.size(); ++corner) {
    Cell cell;
    for (int32_t& value : cell) value = static_cast<int32_t>(random() & ((1u << bits) - 1));
    mesh.corners.push_back(owners[corner] == corner ? cell : mesh.corners[owners[corner]]);
  }
  return mesh;
}

/// The corners of a cube in the middle of the grid.
BaseMesh cubeMesh(int depth, int bits) {
  const Forest one(1, {kCubeSides.begin(), kCubeSides.end()});
  BaseMesh mesh{std::make_shared<const Forest>(depth, one.sides()), bits, {}, {}, 1};
  const int32_t low = 1 << (bits - 2), high = 3 << (bits - 2);
  for (uint32_t patch = 0; patch < 6; ++patch) {
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
      const SpherePoint round = pointOf(patch, x, y);
      const std::array<double, 3> at = {round.x, round.y, round.z};
      Cell cell;
      for (size_t axis = 0; axis < 3; ++axis) cell[axis] = at[axis] > 0 ? high : low;
      mesh.corners.push_back(cell);
    }
  }
  return mesh;
}

TEST(BaseMeshes, ComeBack) {
  for (const ForestShape& shape : forestShapes()) {
    for (int bits = 1; bits <= 20; ++bits) {
      const BaseMesh mesh = anyMesh(2, shape.sides, bits, static_cast<uint32_t>(bits));
      const BaseMesh read = decodeBaseMesh(encodeBaseMesh(mesh), mesh.forest);
      EXPECT_EQ(read.corners, mesh.corners) << shape.name << ", " << bits;
      EXPECT_EQ(read.origin, mesh.origin);
      EXPECT_EQ(read.cell, mesh.cell);
    }
  }
}

TEST(BaseMeshes, OfAnyCodewordHaveTheCornersThatTheyShare) {
  std::mt19937 random(7);
  for (const ForestShape& shape : forestShapes()) {
    const BaseMesh mesh = anyMesh(1, shape.sides, 12, 5);
    BaseMeshHeader header = encodeBaseMesh(mesh);
    const std::string whole = header.code;
    const std::vector<uint32_t> owners = cornerOwners(*mesh.forest);
    for (size_t length = 0; length <= whole.size(); ++length) {
      header.code = whole.substr(0, length);
      if (length > 0 && length < whole.size()) header.code.back() = static_cast<char>(random());
      const BaseMesh read = decodeBaseMesh(header, mesh.forest);
      for (size_t corner = 0; corner < owners.size(); ++corner) {
        EXPECT_EQ(read.corners[corner], read.corners[owners[corner]]);
        for (const int32_t value : read.corners[corner]) EXPECT_EQ(value & 4095, value);
      }
    }
  }
}

TEST(BentBases, AgreeWherePatchesShareSamples) {
  for (const ForestShape& shape : forestShapes()) {
    for (int depth = 1; depth <= 4; ++depth) {
      const BaseMesh mesh = anyMesh(depth, shape.sides, 16, 3);
      const BentBase base(mesh);
      std::vector<BasePoint> all;
      for (uint32_t patch = 0; patch < mesh.forest->patches(); ++patch)
        for (const BasePoint& point : base.patch(patch)) all.push_back(point);
      std::vector<BasePoint> shared = all;
      shareOwned(*mesh.forest, std::span(shared), mesh.forest->side() - 1);
      for (size_t i = 0; i < all.size(); ++i) {
        ASSERT_EQ(all[i].place, shared[i].place) << shape.name << ", depth " << depth;
        ASSERT_EQ(all[i].normal, shared[i].normal) << shape.name << ", depth " << depth;
      }
    }
  }
}

TEST(BentBases, HaveNormalsOfOneLength) {
  for (const ForestShape& shape : forestShapes()) {
    const BaseMesh mesh = anyMesh(3, shape.sides, 20, 9);
    const BentBase base(mesh);
    for (uint32_t patch = 0; patch < mesh.forest->patches(); ++patch) {
      for (const BasePoint& point : base.patch(patch)) {
        double squares = 0;
        for (const int64_t value : point.normal) squares += static_cast<double>(value * value);
        const double length = squares > 0 ? 1 << BentBase::kNormalBits : 0;
        EXPECT_NEAR(std::sqrt(squares), length, 2);
      }
    }
  }
}

TEST(BentBases, MakeACubeNearlyRound) {
  const BaseMesh mesh = cubeMesh(4, 10);
  const BentBase base(mesh);
  const double middle = 512, radius = 256 * std::sqrt(3.0);
  for (uint32_t patch = 0; patch < 6; ++patch) {
    for (const BasePoint& point : base.patch(patch)) {
      const auto at = placeOf(mesh, point, 0);
      double squares = 0, along = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        const double from = at[axis] - middle;
        squares += from * from;
        along += from * static_cast<double>(point.normal[axis]);
      }
      const double distance = std::sqrt(squares);
      EXPECT_NEAR(distance / radius, 1, 0.231) << "0.7698 in the middle of a face; flat: 0.58";
      EXPECT_GT(along, 0.95 * distance * (1 << BentBase::kNormalBits)) << "normals point outwards";
    }
  }
}

TEST(BentBases, CarryHeightsAlongTheirNormals) {
  const BaseMesh mesh = cubeMesh(3, 10);
  const BentBase base(mesh);
  for (const BasePoint& point : base.patch(2)) {
    const auto low = placeOf(mesh, point, -3), high = placeOf(mesh, point, 5);
    double squares = 0;
    for (size_t axis = 0; axis < 3; ++axis)
      squares += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    EXPECT_NEAR(std::sqrt(squares), 8, 0.002);
  }
}

}  // namespace
}  // namespace tetrakis::test
