// SPDX-License-Identifier: Apache-2.0
// What every 4-8 mesh has to be, checked from its triangles alone.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::checks {

/// Twice the area; positive if counter-clockwise seen from above with rows towards the viewer.
inline int64_t doubledArea(const LatticeMesh& mesh, size_t triangle, uint32_t width) {
  std::array<int64_t, 3> x, y;
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t sample = mesh.vertices[mesh.triangles[3 * triangle + k]];
    x[k] = sample % width;
    y[k] = sample / width;
  }
  return (y[1] - y[0]) * (x[2] - x[0]) - (x[1] - x[0]) * (y[2] - y[0]);
}

/// Whether both samples lie on the same side of the grid's border.
inline bool onBorder(uint32_t p, uint32_t q, uint32_t width, uint32_t height) {
  const auto both = [](uint32_t a, uint32_t b, uint32_t line) { return a == line && b == line; };
  return both(p % width, q % width, 0) || both(p % width, q % width, width - 1) ||
         both(p / width, q / width, 0) || both(p / width, q / width, height - 1);
}

/// Conforming: an edge belongs to two triangles that run along it in opposite directions, or to one
/// on the border; a T-junction leaves edges that do neither. Covering: the areas add up to the
/// rectangle.
inline void expectConforming(const LatticeMesh& mesh, uint32_t width, uint32_t height) {
  const std::set<uint32_t> samples(mesh.vertices.begin(), mesh.vertices.end());
  ASSERT_EQ(samples.size(), mesh.vertices.size()) << "a sample twice";
  ASSERT_LT(*samples.rbegin(), uint64_t{width} * height);
  std::set<uint32_t> used;
  std::set<std::pair<uint32_t, uint32_t>> edges;
  int64_t area = 0;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    const int64_t doubled = doubledArea(mesh, t, width);
    ASSERT_GT(doubled, 0) << "triangle " << t;
    area += doubled;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = mesh.triangles[3 * t + k], to = mesh.triangles[3 * t + (k + 1) % 3];
      ASSERT_LT(from, mesh.vertices.size());
      ASSERT_TRUE(edges.emplace(mesh.vertices[from], mesh.vertices[to]).second) << "overlap";
      used.insert(from);
    }
  }
  ASSERT_EQ(area, int64_t{2} * (width - 1) * (height - 1));
  ASSERT_EQ(used.size(), mesh.vertices.size()) << "a vertex of no triangle";
  for (const auto& [from, to] : edges)
    ASSERT_NE(edges.contains({to, from}), onBorder(from, to, width, height)) << from << " - " << to;
}

/// An order of all vertices in which each follows its parents.
inline void expectParentsFirst(const Lattice& lattice, std::span<const VertexId> order) {
  std::vector<bool> inserted(lattice.vertexCount());
  for (const VertexId v : order) {
    EXPECT_FALSE(inserted[v]);
    inserted[v] = true;
    lattice.forEachParent(lattice.site(v),
                          [&](Site parent) { EXPECT_TRUE(inserted[lattice.id(parent)]); });
  }
  EXPECT_EQ(order.size(), lattice.vertexCount());
}

}  // namespace tetrakis::checks
