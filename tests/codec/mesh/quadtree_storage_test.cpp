// SPDX-License-Identifier: Apache-2.0
// Storage of the semi-linear quadtree (thesis 4.3.2, 4.5): against a map, through any number of
// insertions and deletions, and in the form that the control algorithm is to choose.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "codec/mesh/quadtree/semilinear_quadtree.hpp"
#include "tests/support/mesh_values.hpp"

namespace tetrakis {
namespace {

using Entry = SemilinearQuadtree::Entry;

SemilinearQuadtree emptyTree(QuadtreeShape shape) {
  const std::vector<float> roots((shape.columns + 1) * (shape.rows + 1), -1.0f);
  return {shape, roots};
}

QuadtreePlace nodePlace(uint32_t level, uint32_t node, NodeVertex vertex) {
  return {static_cast<uint8_t>(level), QuadtreePlace::kNodes, vertex, node};
}

/// Every place that the shape has.
std::vector<QuadtreePlace> allPlaces(QuadtreeShape shape) {
  std::vector<QuadtreePlace> places;
  for (uint8_t level = 0; level < shape.depth; ++level) {
    for (uint32_t node = 0; node < shape.nodesOf(level); ++node)
      for (const NodeVertex vertex : {kCentre, kNorth, kWest})
        places.push_back(nodePlace(level, node, vertex));
    for (uint32_t row = 0; row < shape.rowsOf(level); ++row)
      places.push_back({level, QuadtreePlace::kEastBorder, kCentre, row});
    for (uint32_t column = 0; column < shape.columnsOf(level); ++column)
      places.push_back({level, QuadtreePlace::kSouthBorder, kCentre, column});
  }
  return places;
}

std::vector<Entry> entriesOf(const std::vector<QuadtreePlace>& places) {
  std::vector<Entry> entries;
  for (const QuadtreePlace& place : places)
    entries.push_back({place, static_cast<float>(entries.size())});
  return entries;
}

void expectHolds(const SemilinearQuadtree& tree, const std::map<QuadtreePlace, float>& expected) {
  ASSERT_EQ(tree.vertexCount(), tree.rootCount() + expected.size());
  uint32_t number = tree.rootCount();
  for (const auto& [place, value] : expected) {
    ASSERT_EQ(tree.find(place), number);
    ASSERT_EQ(tree.values()[number], value);
    ++number;
  }
  auto next = expected.begin();
  tree.forEachVertex([&](const QuadtreePlace& place) { ASSERT_EQ(place, (next++)->first); });
  ASSERT_TRUE(next == expected.end());
  for (const QuadtreePlace& place : allPlaces(tree.shape())) {
    if (!expected.contains(place)) {
      ASSERT_EQ(tree.find(place), kNoVertex);
    }
  }
}

// The thesis names nodes 8 and 16, but prints the coordinates, (3, 1) and (3, 3), of nodes 12 and
// 20: 8 lies at (1, 1), as in its example 4.2. The entries 4 and 6 are those of 12 and 20.
TEST(ThesisExample, FourFourEntriesOfTheBorderTrees) {
  constexpr QuadtreeShape kOfThesis{3};
  const Square east = kOfThesis.squareOf(12), south = kOfThesis.squareOf(20);
  EXPECT_EQ(east, (Square{2, 3, 1}));
  EXPECT_EQ(south, (Square{2, 3, 3}));
  EXPECT_EQ((1u << east.level) - 1 + east.row, 4u);       // (4.25)
  EXPECT_EQ((1u << south.level) - 1 + south.column, 6u);  // (4.26)
  SemilinearQuadtree tree = emptyTree(kOfThesis);
  const QuadtreePlace in_c{2, QuadtreePlace::kEastBorder, kCentre, east.row};
  const QuadtreePlace in_b{2, QuadtreePlace::kSouthBorder, kCentre, south.column};
  tree.update({{in_c, 12.0f}, {in_b, 20.0f}}, {});
  EXPECT_EQ(tree.values()[tree.find(in_c)], 12.0f);
  EXPECT_EQ(tree.values()[tree.find(in_b)], 20.0f);
}

class EveryShape : public testing::TestWithParam<QuadtreeShape> {};

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape,
                         testing::Values(QuadtreeShape{0, 3, 1}, QuadtreeShape{1}, QuadtreeShape{3},
                                         QuadtreeShape{6}, QuadtreeShape{4, 5, 1},
                                         QuadtreeShape{5, 1, 3}, QuadtreeShape{1, 100, 1}));

TEST_P(EveryShape, HoldsWhatWasInsertedAndNotErased) {
  const std::vector<QuadtreePlace> places = allPlaces(GetParam());
  SemilinearQuadtree tree = emptyTree(GetParam());
  std::map<QuadtreePlace, float> expected;
  std::mt19937 random(1);
  for (const uint32_t percent : {2u, 30u, 0u, 60u, 95u, 100u, 50u, 3u, 0u}) {
    std::vector<Entry> inserted;
    std::vector<QuadtreePlace> erased;
    for (const QuadtreePlace& place : places) {
      if (random() % 100 < percent) {
        inserted.push_back({place, static_cast<float>(random() % 1000)});
        expected[place] = inserted.back().value;
      } else if (percent < 100 && random() % 4 != 0) {
        erased.push_back(place);
        expected.erase(place);
      }
    }
    std::shuffle(inserted.begin(), inserted.end(), random);
    tree.update(inserted, erased);
    expectHolds(tree, expected);
  }
}

// "In order to avoid redundancy we store three vertices per node": of a complete mesh every sample
// has one place, and 4 bytes.
TEST_P(EveryShape, ACompleteTreeIsOneArrayInWhichNumbersAreLocationCodes) {
  const QuadtreeShape shape = GetParam();
  SemilinearQuadtree tree = emptyTree(shape);
  tree.update(entriesOf(allPlaces(shape)), {});
  const uint64_t side = uint64_t{1} << shape.depth;
  EXPECT_EQ(tree.vertexCount(), (shape.columns * side + 1) * (shape.rows * side + 1));
  uint32_t first = tree.rootCount();
  for (uint32_t level = 0; level < shape.depth; ++level) {
    EXPECT_EQ(tree.nodes(level).form(), LevelForm::kArray);
    EXPECT_EQ(tree.nodes(level).bytes() + tree.eastBorder(level).bytes(), 0u);
    for (uint32_t node = 0; node < shape.nodesOf(level); ++node)
      ASSERT_EQ(tree.nodes(level).find(node, kWest), first + 3 * node + kWest);
    first += 3 * shape.nodesOf(level) + shape.rowsOf(level) + shape.columnsOf(level);
  }
  EXPECT_EQ(first, tree.vertexCount());
}

TEST(Control, LevelsGatherAsTheyFillAndScatterAsTheyEmpty) {
  constexpr QuadtreeShape kShape{7};
  constexpr uint32_t kLevel = 6, kNodes = 4096, kTiles = kNodes / 64;
  SemilinearQuadtree tree = emptyTree(kShape);
  std::vector<QuadtreePlace> places;
  for (uint32_t node = 0; node < kNodes; ++node)
    for (const NodeVertex vertex : {kCentre, kNorth, kWest})
      places.push_back(nodePlace(kLevel, node, vertex));
  const auto formAfter = [&](uint32_t tiles, bool insert) {
    const std::vector<QuadtreePlace> part(places.begin(), places.begin() + 3 * 64 * tiles);
    tree.update(insert ? entriesOf(part) : std::vector<Entry>(),
                insert ? std::vector<QuadtreePlace>() : part);
    return tree.nodes(kLevel).form();
  };
  EXPECT_EQ(tree.nodes(kLevel).form(), LevelForm::kSparse);
  EXPECT_EQ(formAfter(1, true), LevelForm::kSparse);
  EXPECT_LE(tree.nodes(kLevel).bytes(), 36u);
  EXPECT_EQ(formAfter(kTiles / 16, true), LevelForm::kSparse);
  EXPECT_EQ(formAfter(kTiles / 8, true), LevelForm::kDense);
  EXPECT_EQ(formAfter(kTiles - 1, true), LevelForm::kDense);
  EXPECT_EQ(formAfter(kTiles, true), LevelForm::kArray);
  EXPECT_EQ(formAfter(1, false), LevelForm::kDense);
  EXPECT_EQ(formAfter(kTiles - 1, false), LevelForm::kSparse);
  EXPECT_EQ(formAfter(kTiles, false), LevelForm::kSparse);
  EXPECT_EQ(tree.vertexCount(), tree.rootCount());
}

TEST(Tile, RanksCountTheVerticesOfTheNodesBefore) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 200; ++round) {
    QuadtreeTile<3> tile;
    for (uint64_t& mask : tile.masks) mask = round == 0 ? ~uint64_t{0} : random();
    tile.first = 7;
    uint32_t next = 7;
    for (uint32_t n = 0; n < 64; ++n) {
      ASSERT_EQ(tile.first + tile.rank(n), next);
      const std::array<uint32_t, 3> numbers = tile.numbers(n);
      for (uint32_t k = 0; k < 3; ++k) ASSERT_EQ(numbers[k], tile.has(n, k) ? next++ : kNoVertex);
    }
  }
}

TEST(Cursor, ReadsAnyPathAsTheLevelItselfDoes) {
  for (const uint32_t percent : {1u, 20u, 60u, 100u}) {
    std::mt19937 random(percent);
    QuadtreeLevel<3> level(5000, 11);
    for (uint32_t node = 0; node < 5000; ++node)
      if (percent == 100 || (node / 64 * 37 % 100 < percent && random() % 3 != 0))
        for (uint32_t vertex = 0; vertex < 3; ++vertex) level.append(node, vertex);
    level.gather();
    LevelCursor<3> cursor(level);
    uint32_t node = 0;
    for (int step = 0; step < 20000; ++step) {
      const auto move = static_cast<uint32_t>(random() % 8 == 0 ? random() : random() % 40);
      node = (node + move % 5000) % 5000;
      const std::array<uint32_t, 3> numbers = cursor.numbers(node);
      for (uint32_t vertex = 0; vertex < 3; ++vertex) {
        ASSERT_EQ(numbers[vertex], level.find(node, vertex));
        ASSERT_EQ(numbers[vertex], cursor.number(node, vertex));
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis
