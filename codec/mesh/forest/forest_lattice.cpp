// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/forest/forest_lattice.hpp"

#include <cassert>
#include <utility>

namespace tetrakis::inline forest {

namespace {

constexpr uint32_t kNone = UINT32_MAX;

uint32_t lastOf(const Forest& forest) {
  return forest.side() - 1;
}

}  // namespace

ForestLattice::ForestLattice(const Forest& forest)
    : forest_(forest),
      patch_(*Lattice::make(forest.side(), forest.side())),
      vertices_(size_t{forest.patches()} * patch_.vertexCount()) {
  std::vector<ForestVertex> at(forest.raster().samples(), kNone);
  for (uint32_t level = 0; level < patch_.levelCount(); ++level) {
    for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
      for (VertexId v = patch_.firstOf(level); v < patch_.firstOf(level + 1); ++v) {
        const uint32_t sample = ownerOf(patch, patch_.position(patch_.site(v)));
        if (at[sample] == kNone) {
          at[sample] = vertexCount();
          samples_.push_back(sample);
        }
        vertices_[size_t{patch} * patch_.vertexCount() + v] = at[sample];
      }
    }
  }
}

uint32_t ForestLattice::ownerOf(uint32_t patch, GridPoint at) const {
  const Forest::Place owner = forest_.owner(lastOf(forest_), {patch, at.x, at.y});
  const uint64_t row = uint64_t{owner.patch} * forest_.side() + static_cast<uint64_t>(owner.y);
  return static_cast<uint32_t>(row * forest_.side() + static_cast<uint64_t>(owner.x));
}

ClosureGraph ForestLattice::graph() const {
  ClosureGraph graph;
  graph.parents.assign(vertexCount(), {ClosureFlow::kNone, ClosureFlow::kNone});
  graph.costs.assign(vertexCount(), 0);
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    patch_.forEachVertex([&](Site site, VertexId local) {
      const ForestVertex v = vertex(patch, local);
      ClosureFlow::Arcs& parents = graph.parents[v];
      patch_.forEachParent(site, [&](Site above) {
        const ForestVertex parent = vertex(patch, patch_.id(above));
        if (parent == parents[0] || parent == parents[1]) return;
        parents[parents[0] == ClosureFlow::kNone ? 0 : 1] = parent;
      });
      graph.costs[v] = static_cast<uint8_t>(graph.costs[v] + patch_.triangleCost(site));
    });
  }
  return graph;
}

std::vector<ForestVertex> closureOfMarks(const ForestLattice& lattice,
                                         std::span<const uint8_t> marks) {
  const ClosureGraph graph = lattice.graph();
  std::vector<uint8_t> in(lattice.vertexCount());
  for (ForestVertex v = lattice.vertexCount(); v-- > 0;) {
    in[v] |= marks[lattice.sample(v)] != 0;
    for (const uint32_t parent : graph.parents[v])
      if (in[v] != 0 && parent != ClosureFlow::kNone) in[parent] = 1;
  }
  std::vector<ForestVertex> vertices;
  for (ForestVertex v = 0; v < lattice.vertexCount(); ++v)
    if (in[v] != 0) vertices.push_back(v);
  return vertices;
}

namespace {

/// Joins the meshes of patches at the samples that they share.
class JoinedMesh {
 public:
  explicit JoinedMesh(const Forest& forest)
      : forest_(forest), place_(forest.raster().samples(), kNone) {}

  void addVertex(uint32_t sample) {
    if (place_[sample] != kNone) return;
    place_[sample] = static_cast<uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(sample);
  }
  /// mesh: its vertices are samples of the patch.
  void addTriangles(uint32_t patch, const LatticeMesh& mesh) {
    const uint32_t side = forest_.side();
    for (const uint32_t vertex : mesh.triangles) {
      const uint32_t local = mesh.vertices[vertex];
      mesh_.triangles.push_back(place_[ownerOf(patch, local % side, local / side)]);
    }
  }
  uint32_t ownerOf(uint32_t patch, int64_t x, int64_t y) const {
    const Forest::Place owner = forest_.owner(lastOf(forest_), {patch, x, y});
    const uint64_t row = uint64_t{owner.patch} * forest_.side() + static_cast<uint64_t>(owner.y);
    return static_cast<uint32_t>(row * forest_.side() + static_cast<uint64_t>(owner.x));
  }
  LatticeMesh take() { return std::move(mesh_); }

 private:
  const Forest& forest_;
  std::vector<uint32_t> place_;  ///< of each sample among the vertices
  LatticeMesh mesh_;
};

}  // namespace

LatticeMesh meshOf(const ForestLattice& lattice, std::span<const ForestVertex> vertices) {
  const Forest& forest = lattice.forest();
  std::vector<uint8_t> in(lattice.vertexCount());
  JoinedMesh joined(forest);
  const uint32_t last = lastOf(forest);
  for (uint32_t patch = 0; patch < forest.patches(); ++patch)
    for (const auto& [x, y] : {std::pair(0u, 0u), {last, 0u}, {0u, last}, {last, last}})
      joined.addVertex(joined.ownerOf(patch, x, y));
  for (const ForestVertex v : vertices) {
    in[v] = 1;
    joined.addVertex(lattice.sample(v));
  }
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    std::vector<VertexId> local;
    for (VertexId v = 0; v < lattice.patch().vertexCount(); ++v)
      if (in[lattice.vertex(patch, v)] != 0) local.push_back(v);
    joined.addTriangles(patch, meshOf(lattice.patch(), local));
  }
  return joined.take();
}

}  // namespace tetrakis::inline forest
