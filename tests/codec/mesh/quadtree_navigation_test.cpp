// SPDX-License-Identifier: Apache-2.0
// Location codes, index differences and traversals of the quadtree (thesis 4.3, 4.4, 4.6): the
// examples of the thesis, and closed forms against what they stand for.
#include <gtest/gtest.h>

#include <random>

#include "codec/mesh/quadtree/location_code.hpp"
#include "tests/support/mesh_values.hpp"

namespace tetrakis {
namespace {

using Steps = std::vector<int32_t>;

constexpr QuadtreeShape kTree{4};

/// The delta-vectors of (4.7), (4.8) as the thesis prints them: entries g = 0 ... columns (rows).
Steps horizontalVector(const IndexDifferences& differences, uint32_t level) {
  Steps vector;
  for (uint32_t g = 0; g <= differences.shape().columnsOf(level); ++g)
    vector.push_back(static_cast<int32_t>(differences.horizontal(level, g)));
  return vector;
}
Steps verticalVector(const IndexDifferences& differences, uint32_t level) {
  Steps vector;
  for (uint32_t g = 0; g <= differences.shape().rowsOf(level); ++g)
    vector.push_back(static_cast<int32_t>(differences.vertical(level, g)));
  return vector;
}

TEST(ThesisExample, FourOneCoordinatesOfNode59) {
  EXPECT_EQ(kTree.levelOf(59), 3u);
  EXPECT_EQ(59 - kTree.firstOf(3), 38u);  // quaternary 212
  EXPECT_EQ(kTree.squareOf(59), (Square{3, 2, 5}));
  EXPECT_EQ(kTree.codeOf({3, 2, 5}), 59u);
}

TEST(ThesisExample, FourTwoNeighboursOfNode8) {
  const IndexDifferences differences(kTree);
  const Traversal node(differences, kTree.squareOf(8));
  EXPECT_EQ(Traversal(node).west().code(), 7u);
  EXPECT_EQ(Traversal(node).east().code(), 11u);
  EXPECT_EQ(Traversal(node).north().code(), 6u);
  EXPECT_EQ(Traversal(node).south().code(), 14u);
}

// G3 goes from a node to its north-eastern child, then one node east and one north. The thesis
// announces p_t = 24 and computes 23 (4.22). 23 is right: from (7, 2) the step east is toroidal, to
// (0, 2), and the step north ends at (0, 1); 24 lies at (1, 1).
TEST(ThesisExample, FourThreeEndsInNode23) {
  const IndexDifferences differences(kTree);
  EXPECT_EQ(kTree.squareOf(12), (Square{2, 3, 1}));
  EXPECT_EQ(4 * 12 + 2 + horizontalVector(differences, 3)[8] - verticalVector(differences, 3)[2],
            23);
  Traversal path(differences, kTree.squareOf(12));
  EXPECT_EQ(path.toChild(1).code(), 50u);
  EXPECT_EQ(path.east().code(), 29u);
  EXPECT_EQ(path.north().code(), 23u);
  EXPECT_EQ(path.square(), (Square{3, 0, 1}));
  EXPECT_EQ(kTree.squareOf(24), (Square{3, 1, 1}));
}

TEST(ClosedForm, DeltaVectorsAreThoseOfTheThesis) {  // (4.9), (4.10)
  const IndexDifferences differences(kTree);
  EXPECT_EQ(horizontalVector(differences, 1), (Steps{-1, 1, -1}));
  EXPECT_EQ(horizontalVector(differences, 2), (Steps{-5, 1, 3, 1, -5}));
  EXPECT_EQ(horizontalVector(differences, 3), (Steps{-21, 1, 3, 1, 11, 1, 3, 1, -21}));
  EXPECT_EQ(verticalVector(differences, 1), (Steps{-2, 2, -2}));
  EXPECT_EQ(verticalVector(differences, 2), (Steps{-10, 2, 6, 2, -10}));
  EXPECT_EQ(verticalVector(differences, 3), (Steps{-42, 2, 6, 2, 22, 2, 6, 2, -42}));
}

TEST(ClosedForm, RecurrencesOfTheorem41HoldAtEveryDistance) {  // (4.27), (4.28), (4.33), (4.34)
  int64_t west = 1, east = 2, first = 1, last = 2, north = 1, south = 3, top = 1, bottom = 3;
  for (uint32_t r = 0; r < 16; ++r) {
    EXPECT_EQ(horizontalDifference(r), east - west);
    EXPECT_EQ(toroidalHorizontalDifference(r + 1), last - first);
    EXPECT_EQ(2 * horizontalDifference(r), south - north);
    EXPECT_EQ(2 * toroidalHorizontalDifference(r + 1), bottom - top);
    west = 4 * west + 2, east = 4 * east + 1, first = 4 * first + 1, last = 4 * last + 2;
    north = 4 * north + 3, south = 4 * south + 1, top = 4 * top + 1, bottom = 4 * bottom + 3;
  }
}

// The thesis lets p_n(r) = 4 p_n(r - 1) + 4 (4.38) and p_s(r) = 4 p_s(r - 1) + 2 (4.39), the
// eastern children of the pair; the western ones above differ by as much.
TEST(ClosedForm, EasternAndWesternPairsDifferAlike) {
  int64_t north = 1, south = 3;
  for (uint32_t r = 0; r < 16; ++r) {
    EXPECT_EQ(2 * horizontalDifference(r), south - north);
    north = 4 * north + 4, south = 4 * south + 2;
  }
}

class EveryForest : public testing::TestWithParam<QuadtreeShape> {
 protected:
  const QuadtreeShape shape_ = GetParam();
  const IndexDifferences differences_{shape_};

  template <class Visit>
  void forEachSquare(Visit&& visit) const {
    for (uint32_t level = 0; level < shape_.depth; ++level)
      for (uint32_t row = 0; row < shape_.rowsOf(level); ++row)
        for (uint32_t column = 0; column < shape_.columnsOf(level); ++column)
          visit(Square{level, column, row});
  }
};

INSTANTIATE_TEST_SUITE_P(Shapes, EveryForest,
                         testing::Values(QuadtreeShape{1}, QuadtreeShape{2}, QuadtreeShape{6},
                                         QuadtreeShape{4, 5, 1}, QuadtreeShape{4, 1, 3},
                                         QuadtreeShape{3, 3, 2}, QuadtreeShape{1, 100, 1}));

TEST_P(EveryForest, CodesAreARangeWithoutGapsAndHoldTheirLevel) {
  std::vector<int> uses(shape_.firstOf(shape_.depth));
  forEachSquare([&](Square square) {
    const uint32_t code = shape_.codeOf(square);
    ASSERT_LT(code, uses.size());
    ++uses[code];
    ASSERT_EQ(shape_.levelOf(code), square.level);
    ASSERT_EQ(shape_.squareOf(code), square);
  });
  EXPECT_EQ(uses, std::vector<int>(uses.size(), 1));
}

TEST_P(EveryForest, NeighboursAreThoseOfTheSquaresAcrossPatchesAndAroundTheTorus) {
  forEachSquare([&](Square s) {
    const uint32_t columns = shape_.columnsOf(s.level), rows = shape_.rowsOf(s.level);
    const Traversal node(differences_, s);
    const auto expectAt = [&](const Traversal& t, uint32_t column, uint32_t row) {
      ASSERT_EQ(t.square(), (Square{s.level, column, row}));
      ASSERT_EQ(t.code(), shape_.codeOf(t.square()));
      ASSERT_EQ(t.node(), shape_.nodeOf(t.square()));
    };
    expectAt(Traversal(node).east(), (s.column + 1) % columns, s.row);
    expectAt(Traversal(node).west(), (s.column + columns - 1) % columns, s.row);
    expectAt(Traversal(node).south(), s.column, (s.row + 1) % rows);
    expectAt(Traversal(node).north(), s.column, (s.row + rows - 1) % rows);
  });
}

TEST_P(EveryForest, LongPathsEndWhereTheirStepsLead) {
  std::mt19937 random(5);
  Traversal path(differences_, {0, 0, 0});
  Square expected;
  for (int step = 0; step < 20000; ++step) {
    const uint32_t columns = shape_.columnsOf(expected.level);
    const uint32_t rows = shape_.rowsOf(expected.level);
    const auto move = static_cast<uint32_t>(random() % 6),
               child = static_cast<uint32_t>(random() % 4);
    if (move == 0) path.east(), expected.column = (expected.column + 1) % columns;
    if (move == 1) path.west(), expected.column = (expected.column + columns - 1) % columns;
    if (move == 2) path.south(), expected.row = (expected.row + 1) % rows;
    if (move == 3) path.north(), expected.row = (expected.row + rows - 1) % rows;
    if (move == 4 && expected.level > 0) {
      expected = {expected.level - 1, expected.column / 2, expected.row / 2};
      path = Traversal(differences_, expected);
    }
    if (move == 5 && expected.level + 1 < shape_.depth) {
      path.toChild(child);
      expected = {expected.level + 1, 2 * expected.column + child % 2,
                  2 * expected.row + child / 2};
    }
    ASSERT_EQ(path.square(), expected);
    ASSERT_EQ(path.code(), shape_.codeOf(expected));
  }
}

TEST(LocationCode, TheLargestForestsFitThirtyTwoBits) {
  constexpr QuadtreeShape kSquare{16}, kStrip{1, 715827882, 1};
  EXPECT_EQ(kSquare.firstOf(16), 1431655765u);
  EXPECT_EQ(kSquare.squareOf(kSquare.codeOf({15, 32767, 32767})), (Square{15, 32767, 32767}));
  const Square last{0, 715827881, 0};
  EXPECT_EQ(kStrip.squareOf(kStrip.codeOf(last)), last);
  const IndexDifferences differences(kSquare);
  EXPECT_EQ(Traversal(differences, {15, 32767, 0}).east().code(), kSquare.codeOf({15, 0, 0}));
  EXPECT_EQ(Traversal(differences, {15, 16383, 0}).east().code(), kSquare.codeOf({15, 16384, 0}));
}

}  // namespace
}  // namespace tetrakis
