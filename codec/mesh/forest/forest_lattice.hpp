// SPDX-License-Identifier: Apache-2.0
// ForestLattice is the 4-8 lattice of a forest (L. Balmelli, thesis, 3.2.2 and 4.6): every patch
// has the lattice of a square (topology/lattice.hpp), whose diagonal runs from its north-west to
// its south-east corner, and vertices on glued sides are one vertex.
//
// Only midpoints of sides know two patches: they split a triangle in either, so that they have a
// parent and up to two children in each. So every set of vertices that holds the parents of its
// vertices is a conforming mesh of the whole surface, and gains of a vertex add up over patches.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/forest.hpp"
#include "codec/mesh/closure/closure.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline forest {

/// Vertices of a forest other than corners of patches, level after level from coarse to fine:
/// parents before children.
using ForestVertex = uint32_t;

class ForestLattice {
 public:
  explicit ForestLattice(const Forest& forest);

  const Forest& forest() const { return forest_; }
  /// That of each patch.
  const Lattice& patch() const { return patch_; }
  uint32_t vertexCount() const { return static_cast<uint32_t>(samples_.size()); }
  /// The triangles without any vertex: two a patch.
  uint32_t baseTriangles() const { return 2 * forest_.patches(); }

  /// The sample of a vertex in the raster of the forest: that of the patch that owns it.
  uint32_t sample(ForestVertex v) const { return samples_[v]; }
  /// The vertex of a vertex of a patch.
  ForestVertex vertex(uint32_t patch, VertexId local) const {
    return vertices_[size_t{patch} * patch_.vertexCount() + local];
  }
  /// The first vertex of a level of the patches' lattice.
  ForestVertex firstOf(uint32_t level) const {
    return level < firsts_.size() ? firsts_[level] : vertexCount();
  }
  /// The parents and the triangles that a mesh gains by a vertex, of all vertices by their numbers.
  ClosureGraph graph() const;

 private:
  const Forest& forest_;
  Lattice patch_;
  std::vector<uint32_t> samples_;
  std::vector<ForestVertex> firsts_;    ///< of levels
  std::vector<ForestVertex> vertices_;  ///< of each patch, by the numbers of its lattice
};

/// The smallest set that has the vertices at marked samples and the parents of all its vertices.
/// marks: of the raster.
std::vector<ForestVertex> closureOfMarks(const ForestLattice& lattice,
                                         std::span<const uint8_t> marks);

/// A set of vertices, patch by patch.
class PatchVertices {
 public:
  PatchVertices(const ForestLattice& lattice, std::span<const ForestVertex> vertices)
      : lattice_(lattice), in_(lattice.vertexCount()) {
    for (const ForestVertex v : vertices) in_[v] = 1;
  }
  /// Those of a patch, in the numbers of its lattice.
  std::vector<VertexId> of(uint32_t patch) const;

 private:
  const ForestLattice& lattice_;
  std::vector<uint8_t> in_;
};

/// The mesh of a closed set of vertices, by their numbers: corners of patches first, then these.
/// Its vertices are samples of the raster; no edge is open but at borders.
LatticeMesh meshOf(const ForestLattice& lattice, std::span<const ForestVertex> vertices);

/// The same as a mesh for each patch, so that a texture can be laid over it: a sample that patches
/// share is a vertex of each of them.
LatticeMesh patchesOf(const ForestLattice& lattice, std::span<const ForestVertex> vertices);

}  // namespace tetrakis::inline forest
