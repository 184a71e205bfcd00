// SPDX-License-Identifier: Apache-2.0
// Polylines that a tree binds, against all trees (thesis 2.5 and 2.6).
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "codec/polyline/knots.hpp"
#include "codec/polyline/polylines.hpp"
#include "tests/support/polyline_curves.hpp"

namespace tetrakis::test {
namespace {

/// What polylines of one subtree can do: the least error by the number of their knots in it, and
/// how many polylines have that number.
struct Subtrees {
  std::vector<double> least;
  std::vector<uint64_t> count;
};

/// Of the node, or of the chord between a and b if there is none. Every polyline is visited: each
/// pair of a left and a right one.
Subtrees allSubtrees(const Curve& curve, const KnotTree& tree, uint32_t k, uint32_t a, uint32_t b) {
  Subtrees all{{curve.error(a, b)}, {1}};
  if (k == kNoKnot) return all;
  const Subtrees left = allSubtrees(curve, tree, tree[k].left, a, k),
                 right = allSubtrees(curve, tree, tree[k].right, k, b);
  const size_t knots = left.least.size() + right.least.size() - 1;
  all.least.resize(knots + 1, std::numeric_limits<double>::infinity());
  all.count.resize(knots + 1, 0);
  for (size_t i = 0; i < left.least.size(); ++i)
    for (size_t j = 0; j < right.least.size(); ++j) {
      double& least = all.least[i + j + 1];
      least = std::min(least, left.least[i] + right.least[j]);
      all.count[i + j + 1] += left.count[i] * right.count[j];
    }
  return all;
}

Subtrees allSubtrees(const Curve& curve) {
  const KnotTree tree(curve.size());
  return allSubtrees(curve, tree, tree.root(), 0, curve.size() - 1);
}

/// The lowest line over so many segments that no polyline of a tree lies below.
double hullAt(const std::vector<double>& least, uint32_t segments) {
  double hull = std::numeric_limits<double>::infinity();
  for (uint32_t i = 1; i <= segments; ++i)
    for (auto j = segments; j <= least.size(); ++j) {
      const double part = i == j ? 0 : double(segments - i) / (j - i);
      hull = std::min(hull, least[i - 1] + part * (least[j - 1] - least[i - 1]));
    }
  return hull;
}

TEST(KnotTree, PlacesNodesAsFormula229Does) {
  for (uint32_t depth = 1; depth <= 10; ++depth) {
    const KnotTree tree((1U << depth) + 1);
    ASSERT_EQ(tree.order().size(), (1U << depth) - 1);
    for (uint32_t p = 0; p < tree.order().size(); ++p) {
      const auto level = static_cast<uint32_t>(std::bit_width(p + 1) - 1);
      const uint32_t local = p - (1U << level) + 1;
      const uint32_t half = 1U << (depth - level - 1);
      const uint32_t j = half + local * 2 * half;
      EXPECT_EQ(tree.order()[p], j);
      EXPECT_EQ(tree[j].a, j - half);
      EXPECT_EQ(tree[j].b, j + half);
    }
  }
}

TEST(KnotTree, HoldsEveryInnerKnotOnceInAnySize) {
  for (uint32_t size = 2; size <= 200; ++size) {
    const KnotTree tree(size);
    std::vector<uint32_t> knots = tree.order();
    std::sort(knots.begin(), knots.end());
    ASSERT_EQ(knots.size(), size - 2);
    for (uint32_t i = 0; i < knots.size(); ++i) EXPECT_EQ(knots[i], i + 1);
    for (const uint32_t k : knots)
      for (const uint32_t child : {tree[k].left, tree[k].right}) {
        if (child != kNoKnot) {
          EXPECT_EQ(tree[child].parent, k);
        }
      }
  }
}

/// Not the k t(k - 1) of (2.30): a tree is counted once however its branches were added.
TEST(KnotTree, HasAsManyPolylinesAsThereAreBinaryTrees) {
  const Curve curve(std::vector<double>(129, 0.0));
  const Subtrees all = allSubtrees(curve);
  uint64_t catalan = 1;
  for (uint64_t k = 0; k <= 7; ++k) {
    EXPECT_EQ(all.count[k], catalan) << k << " knots";
    catalan = catalan * 2 * (2 * k + 1) / (k + 2);
  }
}

TEST(Polylines, OfTreesKeepTheParentsOfTheirKnots) {
  for (const uint32_t size : {3U, 6U, 17U, 50U, 65U})
    for (const NamedCurve& named : namedCurves(size, size)) {
      const Curve curve(named.heights);
      const KnotTree tree(size);
      for (const Algorithm& algorithm : kAlgorithms) {
        if (!algorithm.tree_bound) continue;
        const Polylines polylines = algorithm.run(curve);
        for (const uint32_t k : tree.order()) {
          if (tree[k].parent == kNoKnot) continue;
          EXPECT_LE(polylines.entry[tree[k].parent], polylines.entry[k])
              << algorithm.name << ' ' << named.name << ' ' << k;
        }
      }
    }
}

TEST(Polylines, OfTreesAreNeverBetterThanTheBestTree) {
  for (const uint32_t size : {9U, 13U, 17U, 33U, 64U})
    for (const NamedCurve& named : namedCurves(size, size)) {
      const Curve curve(named.heights);
      const Subtrees all = allSubtrees(curve);
      const Polylines optimal = uoptimal(curve);
      const double tolerance = 1e-9 * (1 + all.least[0]);
      for (uint32_t c = 1; c < size; ++c)
        EXPECT_GE(all.least[c - 1], optimal.errors[c] - tolerance) << named.name << ' ' << c;
      for (const Algorithm& algorithm : kAlgorithms) {
        if (!algorithm.tree_bound) continue;
        const Polylines polylines = algorithm.run(curve);
        for (uint32_t c = 1; c < size; ++c) {
          if (!polylines.has(c)) continue;
          EXPECT_GE(polylines.errors[c], all.least[c - 1] - tolerance)
              << algorithm.name << ' ' << named.name << ' ' << c;
        }
      }
    }
}

/// coptimal: every polyline of it is a best tree of its size, lies on the hull of all trees, every
/// corner of the hull is among them, and errors never fall as knots go.
TEST(Polylines, OfCoptimalAreTheHullOfAllTrees) {
  for (const uint32_t size : {2U, 3U, 5U, 9U, 13U, 17U, 33U, 65U})
    for (uint32_t seed = 1; seed <= 8; ++seed)
      for (const NamedCurve& named : namedCurves(size, seed * size)) {
        SCOPED_TRACE(named.name + ' ' + std::to_string(size));
        const Curve curve(named.heights);
        const std::vector<double> least = allSubtrees(curve).least;
        const double tolerance = 1e-9 * (1 + least[0]);
        const Polylines pruned = coptimal(curve);
        double before = std::numeric_limits<double>::infinity();
        for (uint32_t c = 1; c < size; ++c) {
          const double hull = hullAt(least, c);
          if (pruned.has(c)) {
            EXPECT_NEAR(pruned.errors[c], hull, tolerance) << c;
            EXPECT_LE(pruned.errors[c], before + tolerance) << c;
            before = pruned.errors[c];
          } else {
            const double beside = (hullAt(least, c - 1) + hullAt(least, c + 1)) / 2;
            EXPECT_NEAR(hull, beside, tolerance) << "a corner is missing at " << c;
          }
        }
      }
}

/// Example 2.1: λ is 4, 2 and 4, so all inner knots go at once.
TEST(Polylines, OfExample21) {
  const Curve curve(zigzag());
  EXPECT_DOUBLE_EQ(curve.error(0, 2), 4);
  EXPECT_DOUBLE_EQ(curve.error(0, 4) / 3, 2);
  EXPECT_DOUBLE_EQ(curve.error(2, 4), 4);
  const Polylines pruned = coptimal(curve);
  EXPECT_NEAR(pruned.errors[4], 0, 1e-12);
  EXPECT_FALSE(pruned.has(3));
  EXPECT_FALSE(pruned.has(2));
  EXPECT_NEAR(pruned.errors[1], 6, 1e-12);
  EXPECT_EQ(pruned.reached(3), 1U);
}

/// By their definitions: cglobal takes the leaf of least gain, cdecimate the nearest, crefine the
/// farthest of the knots that the tree lets in.
TEST(Polylines, OfTreesTakeTheBestStep) {
  for (const NamedCurve& named : namedCurves(33, 9)) {
    const Curve curve(named.heights);
    const KnotTree tree(curve.size());
    const Polylines global = cglobal(curve), decimated = cdecimate(curve), refined = crefine(curve);
    const auto isLeaf = [&](const Polylines& polylines, uint32_t k, uint32_t c) {
      const auto gone = [&](uint32_t child) {
        return child == kNoKnot || polylines.entry[child] > c;
      };
      return polylines.entry[k] <= c && gone(tree[k].left) && gone(tree[k].right);
    };
    const auto stepOf = [&](const Polylines& polylines, uint32_t c) {
      const auto at = std::find(polylines.entry.begin() + 1, polylines.entry.end(), c);
      return static_cast<uint32_t>(at - polylines.entry.begin());
    };
    const auto distance = [&](uint32_t k) { return curve.deviation(tree[k].a, k, tree[k].b); };
    const auto gain = [&](uint32_t k) { return curve.gain(tree[k].a, k, tree[k].b); };
    for (uint32_t c = curve.size() - 1; c > 1; --c)
      for (const uint32_t k : tree.order()) {
        if (isLeaf(global, k, c)) {
          EXPECT_LE(gain(stepOf(global, c)), gain(k));
        }
        if (isLeaf(decimated, k, c)) {
          EXPECT_LE(distance(stepOf(decimated, c)), distance(k));
        }
        const uint32_t parent = tree[k].parent;
        if (refined.entry[k] >= c && (parent == kNoKnot || refined.entry[parent] < c)) {
          EXPECT_GE(distance(stepOf(refined, c)), distance(k));
        }
      }
  }
}

}  // namespace
}  // namespace tetrakis::test
