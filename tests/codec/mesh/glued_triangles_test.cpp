// SPDX-License-Identifier: Apache-2.0
// How the triangles of meshes of a forest lie side by side, and that no two edges have the same
// ends where singleEdges() says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "codec/mesh/forest/glued_triangles.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

uint32_t after(uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Of each sample the one that is coded for it.
std::vector<uint32_t> ownersOf(const Forest& forest) {
  std::vector<uint32_t> owners(forest.raster().samples());
  for (uint32_t i = 0; i < owners.size(); ++i) owners[i] = i;
  shareOwned(forest, std::span(owners), forest.side() - 1);
  return owners;
}

std::vector<ForestVertex> everyThird(const ForestLattice& lattice) {
  std::vector<uint8_t> marks(lattice.forest().raster().samples());
  for (size_t i = 0; i < marks.size(); i += 3) marks[i] = 1;
  return closureOfMarks(lattice, marks);
}

size_t doubleEdges(const GluedTriangles& mesh, const std::vector<uint32_t>& owners) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  size_t count = 0;
  for (uint32_t side = 0; side < mesh.sides.size(); ++side) {
    if (mesh.sides[side] != GluedTriangles::kBorder && mesh.sides[side] < side) continue;
    const auto ends = std::minmax(owners[mesh.samples[side]], owners[mesh.samples[after(side)]]);
    count += ++edges[ends] > 1 || ends.first == ends.second;
  }
  return count;
}

TEST(GluedTriangles, LieBesideThoseThatRunBackBetweenTheSameSamples) {
  for (const ForestShape& shape : forestShapes()) {
    const Forest forest(4, shape.sides);
    const ForestLattice lattice(forest);
    const std::vector<uint32_t> owners = ownersOf(forest);
    for (const std::vector<ForestVertex>& vertices :
         {std::vector<ForestVertex>(), everyThird(lattice)}) {
      const GluedTriangles mesh = gluedTriangles(lattice, vertices);
      size_t borders = 0;
      for (uint32_t side = 0; side < mesh.sides.size(); ++side) {
        const uint32_t other = mesh.sides[side];
        borders += other == GluedTriangles::kBorder;
        if (other == GluedTriangles::kBorder) continue;
        EXPECT_EQ(mesh.sides[other], side) << shape.name;
        EXPECT_EQ(owners[mesh.samples[side]], owners[mesh.samples[after(other)]]) << shape.name;
        EXPECT_EQ(owners[mesh.samples[after(side)]], owners[mesh.samples[other]]) << shape.name;
      }
      EXPECT_TRUE(!vertices.empty() || borders == 2 * shape.border) << shape.name;
    }
  }
}

TEST(GluedTriangles, LeaveOutThoseThatTouchWhatIsUnknown) {
  const Forest forest(2, planeShape(1, 2).sides);
  const ForestLattice lattice(forest);
  std::vector<uint8_t> known(forest.raster().samples(), 1);
  known[0] = 0;  // the first corner of the first patch, which both of its triangles have
  const GluedTriangles mesh = gluedTriangles(lattice, {}, known);
  ASSERT_EQ(mesh.samples.size(), 6u);
  EXPECT_GE(*std::min_element(mesh.samples.begin(), mesh.samples.end()), 25u);
  EXPECT_EQ(std::count(mesh.sides.begin(), mesh.sides.end(), GluedTriangles::kBorder), 4);
}

TEST(GluedTriangles, HaveSingleEdgesWithTheVerticesThatPartThem) {
  size_t of_bases = 0;
  for (const ForestShape& shape : forestShapes()) {
    if (shape.name == coneShape().name) continue;  // two edges of its tip lie on each other
    const Forest forest(4, shape.sides);
    const ForestLattice lattice(forest);
    const std::vector<uint32_t> owners = ownersOf(forest);
    of_bases += doubleEdges(gluedTriangles(lattice, {}), owners);
    const std::vector<ForestVertex> needed = singleEdges(lattice);
    EXPECT_EQ(doubleEdges(gluedTriangles(lattice, needed), owners), 0u) << shape.name;
    std::vector<uint8_t> marks(forest.raster().samples());
    for (const ForestVertex v : needed) marks[lattice.sample(v)] = 1;
    uint32_t state = 5;
    for (size_t i = 0; i < marks.size(); ++i) {
      state = state * 1664525 + 1013904223;
      if (state >> 29 == 0) marks[i] = 1;
    }
    const std::vector<ForestVertex> more = closureOfMarks(lattice, marks);
    EXPECT_GT(more.size(), needed.size());
    EXPECT_EQ(doubleEdges(gluedTriangles(lattice, more), owners), 0u) << shape.name;
    EXPECT_TRUE(shape.name != "2x2" || needed.empty());
  }
  EXPECT_GT(of_bases, 0u);
}

}  // namespace
}  // namespace tetrakis::test
