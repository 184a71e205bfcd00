// SPDX-License-Identifier: Apache-2.0
// Walks over stored meshes of forests, which bench_thesis_forests times.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bench/reproduction/forest_terrain.hpp"
#include "codec/mesh/study/forest_quadtree.hpp"

namespace tetrakis::bench {

/// A mesh of a forest, and the nodes that it has.
struct Stored {
  /// The complete mesh, or the best one of a part of its triangles.
  Stored(const ForestTerrain& terrain, uint32_t divisor);

  std::string name;
  std::string mesh;
  std::unique_ptr<ForestQuadtree> tree;
  std::vector<ForestNode> nodes;
};

struct Start {
  ForestNode node;
  Heading heading;
};

/// Walks of `steps` nodes each.
struct Walks {
  std::string name;
  uint32_t steps;
  std::vector<Start> starts;
};

/// Single steps, paths of 16 and of 512 nodes from nodes drawn at random, and steps over sides of
/// patches.
std::vector<Walks> makeWalks(const Stored& stored);

/// Reads the heights of the next nodes in one direction, over sides of patches: their sum.
double walkForest(const ForestQuadtree& tree, const Start& start, uint32_t steps);
/// The same in the first patch alone, which the toroidal differences of theorem 4.1 close.
double walkOneTree(const ForestQuadtree& forest, const Start& start, uint32_t steps);

}  // namespace tetrakis::bench
