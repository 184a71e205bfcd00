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

/// The sample of the raster that is coded for a sample of a patch.
uint32_t ownerOf(const Forest& forest, uint32_t patch, int64_t x, int64_t y) {
  const Forest::Place owner = forest.owner(lastOf(forest), {patch, x, y});
  const uint64_t row = uint64_t{owner.patch} * forest.side() + static_cast<uint64_t>(owner.y);
  return static_cast<uint32_t>(row * forest.side() + static_cast<uint64_t>(owner.x));
}

}  // namespace

ForestLattice::ForestLattice(const Forest& forest)
    : forest_(forest),
      patch_(*Lattice::make(forest.side(), forest.side())),
      vertices_(size_t{forest.patches()} * patch_.vertexCount()) {
  std::vector<ForestVertex> at(forest.raster().samples(), kNone);
  for (uint32_t level = 0; level < patch_.levelCount(); ++level) {
    firsts_.push_back(vertexCount());
    for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
      for (VertexId v = patch_.firstOf(level); v < patch_.firstOf(level + 1); ++v) {
        const GridPoint at_patch = patch_.position(patch_.site(v));
        const uint32_t sample = ownerOf(forest, patch, at_patch.x, at_patch.y);
        if (at[sample] == kNone) {
          at[sample] = vertexCount();
          samples_.push_back(sample);
        }
        vertices_[size_t{patch} * patch_.vertexCount() + v] = at[sample];
      }
    }
  }
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
  /// Gives samples that others own the vertices of those, once all are added.
  void shareVertices() { shareOwned(forest_, std::span(place_), lastOf(forest_)); }
  /// mesh: its vertices are samples of the patch.
  void addTriangles(uint32_t patch, const LatticeMesh& mesh) {
    const size_t first = size_t{patch} * forest_.side() * forest_.side();
    for (const uint32_t vertex : mesh.triangles)
      mesh_.triangles.push_back(place_[first + mesh.vertices[vertex]]);
  }
  LatticeMesh take() { return std::move(mesh_); }

 private:
  const Forest& forest_;
  std::vector<uint32_t> place_;  ///< of each sample among the vertices
  LatticeMesh mesh_;
};

}  // namespace

std::vector<VertexId> PatchVertices::of(uint32_t patch) const {
  std::vector<VertexId> local;
  for (VertexId v = 0; v < lattice_.patch().vertexCount(); ++v)
    if (in_[lattice_.vertex(patch, v)] != 0) local.push_back(v);
  return local;
}

LatticeMesh meshOf(const ForestLattice& lattice, std::span<const ForestVertex> vertices) {
  const Forest& forest = lattice.forest();
  JoinedMesh joined(forest);
  const uint32_t last = lastOf(forest);
  for (uint32_t patch = 0; patch < forest.patches(); ++patch)
    for (const auto& [x, y] : {std::pair(0u, 0u), {last, 0u}, {0u, last}, {last, last}})
      joined.addVertex(ownerOf(forest, patch, x, y));
  for (const ForestVertex v : vertices) joined.addVertex(lattice.sample(v));
  joined.shareVertices();
  const PatchVertices of_patches(lattice, vertices);
  for (uint32_t patch = 0; patch < forest.patches(); ++patch)
    joined.addTriangles(patch, meshOf(lattice.patch(), of_patches.of(patch)));
  return joined.take();
}

LatticeMesh patchesOf(const ForestLattice& lattice, std::span<const ForestVertex> vertices) {
  const Forest& forest = lattice.forest();
  const PatchVertices of_patches(lattice, vertices);
  LatticeMesh all;
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    const LatticeMesh mesh = meshOf(lattice.patch(), of_patches.of(patch));
    const auto first = static_cast<uint32_t>(all.vertices.size());
    for (const uint32_t sample : mesh.vertices)
      all.vertices.push_back(patch * forest.side() * forest.side() + sample);
    for (const uint32_t vertex : mesh.triangles) all.triangles.push_back(first + vertex);
  }
  return all;
}

}  // namespace tetrakis::inline forest
