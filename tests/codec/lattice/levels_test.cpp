// SPDX-License-Identifier: Apache-2.0
// Both border rules have the same vertices inside the grid, and end where they say.
#include "codec/lattice/levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::test {
namespace {

constexpr BorderRule kClipped = BorderRule::kClipped, kOverhanging = BorderRule::kOverhanging;

TEST(BorderRule, ClippedEndsBeforeTheBorderAndOverhangingBehindIt) {
  for (uint32_t size = 2; size < 70; ++size) {
    for (uint32_t step = 1; step <= 64; step *= 2) {
      const uint32_t last = size - 1;
      const uint32_t inside = multiplesAlong(kClipped, size, step);
      EXPECT_LE((inside - 1) * step, last);
      EXPECT_GT(inside * step, last);
      const uint32_t over = multiplesAlong(kOverhanging, size, step);
      EXPECT_GE((over - 1) * step, last);
      EXPECT_LT((over - 2) * step, last);
      const uint32_t centres = centresAlong(kClipped, size, step);
      EXPECT_GT(centreAt(step, centres), last);
      if (centres > 0) {
        EXPECT_LE(centreAt(step, centres - 1), last);
      }
      // As many squares as lie between the multiples of their side.
      EXPECT_EQ(centresAlong(kOverhanging, size, step) + 1,
                multiplesAlong(kOverhanging, size, 2 * step));
    }
  }
}

TEST(BorderRule, DepthCoversTheLongerOrTheShorterSide) {
  for (uint32_t width = 1; width < 40; ++width) {
    for (uint32_t height = 1; height < 40; ++height) {
      const auto covers = [&](BorderRule rule, uint32_t side) {
        const uint32_t depth = depthOf(rule, width, height);
        EXPECT_GE((uint32_t{1} << depth) + 1, side);
        if (depth > 0) {
          EXPECT_LT((uint32_t{1} << (depth - 1)) + 1, side);
        }
      };
      covers(kClipped, std::max(width, height));
      covers(kOverhanging, std::min(width, height));
    }
  }
}

using Places = std::set<std::pair<uint32_t, uint32_t>>;

Places placesOf(const Level& level) {
  Places places;
  for (uint32_t row = 0; row < level.rows; ++row)
    for (uint32_t i = 0; i < level.columns[row % 2]; ++i)
      places.insert({level.firstX(row) + i * level.pitch(), level.y(row)});
  return places;
}

Places placesInside(const Lattice& lattice, uint32_t mesh_level) {
  Places places;
  lattice.forEachVertex([&](Site site, VertexId) {
    const GridPoint p = lattice.position(site);
    if (site.level == mesh_level && p.x < lattice.width() && p.y < lattice.height())
      places.insert({p.x, p.y});
  });
  return places;
}

TEST(BorderRule, LevelsOfMeshesAndMasksAreTheSameInsideTheGrid) {
  for (const auto& [width, height] :
       {std::pair(2u, 2u), {2u, 9u}, {17u, 17u}, {33u, 17u}, {20u, 31u}, {50u, 7u}}) {
    const auto lattice = Lattice::make(width, height);
    ASSERT_TRUE(lattice.ok());
    const std::vector<Level> levels = levelsOf(width, height);
    // Levels coarser than the roots of the mesh are no levels of it.
    const size_t roots = levels.size() - lattice->levelCount();
    for (uint32_t l = 0; l < lattice->levelCount(); ++l)
      EXPECT_EQ(placesInside(*lattice, l), placesOf(levels[roots + l])) << width << " x " << height;
  }
}

}  // namespace
}  // namespace tetrakis::test
