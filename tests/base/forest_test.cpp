// SPDX-License-Identifier: Apache-2.0
// Which samples of a forest are one, and what lies around a patch, of several surfaces: by brute
// force over all samples that are glued.
#include "base/forest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

using Place = Forest::Place;

/// The place so far inside of a side; of a negative depth outside.
Place insideOf(int64_t n, uint32_t side, int64_t along, int64_t depth) {
  const uint32_t patch = side / Forest::kSides;
  const Place places[] = {{patch, along, depth},
                          {patch, n - depth, along},
                          {patch, along, n - depth},
                          {patch, depth, along}};
  return places[side % Forest::kSides];
}

/// Where along a side a place lies.
int64_t alongOf(uint32_t side, const Place& place) {
  return side % 2 == 0 ? place.x : place.y;
}

template <class Check>
void forEachForest(const Check& check) {
  for (const ForestShape& shape : forestShapes()) {
    for (int depth = 1; depth <= 3; ++depth) {
      SCOPED_TRACE(shape.name + ", depth " + std::to_string(depth));
      ASSERT_TRUE(Forest::isSound(shape.sides));
      check(shape, Forest(depth, shape.sides));
    }
  }
}

template <class Check>
void forEachPlace(const Forest& forest, const Check& check) {
  const int64_t n = forest.side() - 1;
  for (uint32_t patch = 0; patch < forest.patches(); ++patch)
    for (int64_t y = 0; y <= n; ++y)
      for (int64_t x = 0; x <= n; ++x) check(Place{patch, x, y});
}

size_t numberOf(const Forest& forest, const Place& place) {
  return (place.patch * forest.side() + static_cast<size_t>(place.y)) * forest.side() +
         static_cast<size_t>(place.x);
}

/// Sets of samples that hang together, each named by one of them.
class Classes {
 public:
  explicit Classes(const Forest& forest) : forest_(forest), parents_(forest.raster().samples()) {
    std::iota(parents_.begin(), parents_.end(), size_t{0});
    const int64_t n = forest.side() - 1;
    for (uint32_t side = 0; side < forest.sides().size(); ++side) {
      const uint32_t other = forest.sides()[side];
      if (other == Forest::kBorder) continue;
      const bool turned = (side % 4 < 2) == (other % 4 < 2);
      for (int64_t k = 0; k <= n; ++k)
        join(insideOf(n, side, k, 0), insideOf(n, other, turned ? n - k : k, 0));
    }
  }
  size_t of(const Place& place) const { return root(numberOf(forest_, place)); }

 private:
  size_t root(size_t sample) const {
    while (parents_[sample] != sample) sample = parents_[sample];
    return sample;
  }
  void join(const Place& a, const Place& b) { parents_[of(a)] = of(b); }

  const Forest& forest_;
  std::vector<size_t> parents_;
};

TEST(Forest, OwnsAsManySamplesAsItsSurfaceHas) {
  forEachForest([](const ForestShape& shape, const Forest& forest) {
    const std::vector<uint8_t> owned = ownedSamples(forest).bytes();
    EXPECT_EQ(std::accumulate(owned.begin(), owned.end(), size_t{0}),
              shape.samples(forest.depth()));
  });
}

TEST(Forest, OwnersAreOneOfEachClassOfGluedSamples) {
  forEachForest([](const ForestShape&, const Forest& forest) {
    const int64_t n = forest.side() - 1;
    const Classes classes(forest);
    std::vector<size_t> owners(forest.raster().samples(), SIZE_MAX);
    forEachPlace(forest, [&](const Place& place) {
      const Place owner = forest.owner(n, place);
      EXPECT_EQ(forest.owner(n, owner), owner);
      EXPECT_EQ(classes.of(owner), classes.of(place));
      size_t& of_class = owners[classes.of(place)];
      if (of_class == SIZE_MAX) of_class = numberOf(forest, owner);
      EXPECT_EQ(of_class, numberOf(forest, owner));
    });
  });
}

TEST(Forest, LocatesAcrossASideAndBack) {
  forEachForest([](const ForestShape&, const Forest& forest) {
    const int64_t n = forest.side() - 1;
    for (uint32_t side = 0; side < forest.sides().size(); ++side) {
      const uint32_t other = forest.sides()[side];
      for (int64_t along = 0; along <= n; ++along) {
        for (int64_t depth = 0; depth <= n; ++depth) {
          const Place here = insideOf(n, side, along, depth);
          const Place there = forest.locate(n, insideOf(n, side, along, -depth));
          if (other == Forest::kBorder || depth == 0) {
            EXPECT_EQ(there, here);
            continue;
          }
          EXPECT_EQ(there, insideOf(n, other, alongOf(other, there), depth));
          EXPECT_EQ(forest.locate(n, insideOf(n, other, alongOf(other, there), -depth)), here);
        }
      }
    }
  });
}

/// What lies along a line that leaves a patch begins at its side.
TEST(Forest, LocatesSamplesOfASideWhereTheyAre) {
  forEachForest([](const ForestShape&, const Forest& forest) {
    const int64_t n = forest.side() - 1;
    forEachPlace(forest, [&](const Place& place) { EXPECT_EQ(forest.locate(n, place), place); });
  });
}

TEST(Forest, PatchesOfAPlaneLieAsOnePlane) {
  constexpr uint32_t kRows = 2, kColumns = 3;
  for (int depth = 1; depth <= 3; ++depth) {
    const Forest forest(depth, planeShape(kRows, kColumns).sides);
    const int64_t n = forest.side() - 1;
    const auto on_plane = [&](const Place& place) {
      return std::pair{place.patch % kColumns * n + place.x, place.patch / kColumns * n + place.y};
    };
    for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
      for (int64_t y = -n; y <= 2 * n; ++y) {
        for (int64_t x = -n; x <= 2 * n; ++x) {
          const Place place{patch, x, y};
          const auto [column, row] = on_plane(place);
          if (column < 0 || column > kColumns * n || row < 0 || row > kRows * n) continue;
          EXPECT_EQ(on_plane(forest.locate(n, place)), std::pair(column, row));
        }
      }
    }
  }
}

TEST(Forest, SharesWhatItOwns) {
  forEachForest([](const ForestShape&, const Forest& forest) {
    const uint32_t n = forest.side() - 1;
    std::vector<size_t> raster(forest.raster().samples());
    std::iota(raster.begin(), raster.end(), size_t{0});
    shareOwned<size_t>(forest, raster, n);
    forEachPlace(forest, [&](const Place& place) {
      EXPECT_EQ(raster[numberOf(forest, place)], numberOf(forest, forest.owner(n, place)));
    });
  });
}

TEST(Forest, SidesNameEachOther) {
  EXPECT_FALSE(Forest::isSound({}));
  for (const ForestShape& shape : forestShapes()) {
    for (size_t i = 0; i < shape.sides.size(); ++i) {
      for (uint32_t other = 0; other <= shape.sides.size(); ++other) {
        std::vector<uint32_t> sides = shape.sides;
        sides[i] = other;
        EXPECT_EQ(Forest::isSound(sides), other == shape.sides[i]) << shape.name << i;
      }
      std::vector<uint32_t> cut = shape.sides;
      cut.pop_back();
      EXPECT_FALSE(Forest::isSound(cut));
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
