// SPDX-License-Identifier: Apache-2.0
// Conforming 4-8 meshes (thesis 3.2): the triangles that a closed set of lattice vertices implies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/lattice.hpp"

namespace tetrakis {

/// A mesh that covers the grid. vertices: samples (row * width + column), the roots first, row by
/// row, then the inserted ones in their order; no sample twice. triangles: three indices into
/// vertices each, counter-clockwise seen from above (x to the right, rows towards the viewer), none
/// without area.
struct LatticeMesh {
  std::vector<uint32_t> vertices;
  std::vector<uint32_t> triangles;

  size_t triangleCount() const { return triangles.size() / 3; }
};

/// The mesh after inserting `vertices`, which come once each, every one after its parents.
LatticeMesh meshOf(const Lattice& lattice, std::span<const VertexId> vertices);

/// Coarse ones first: their mesh has every sample.
std::vector<VertexId> allVertices(const Lattice& lattice);

/// The smallest closed set that holds `vertices`: them and their ancestors, in order of id.
std::vector<VertexId> closureOf(const Lattice& lattice, std::span<const VertexId> vertices);

/// The closure of all samples whose mark is not zero (thesis 3.2.3: splitting domains), in order of
/// id. marks: one for each sample, row by row.
std::vector<VertexId> codedVertices(const Lattice& lattice, std::span<const uint8_t> marks);

/// Its mesh.
LatticeMesh codedMesh(const Lattice& lattice, std::span<const uint8_t> marks);

}  // namespace tetrakis
