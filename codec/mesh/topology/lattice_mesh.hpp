// SPDX-License-Identifier: Apache-2.0
// meshOf() lists the triangles of the conforming 4-8 mesh that a closed set of lattice vertices
// implies (thesis 3.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline topology {

/// A mesh that covers the grid. `vertices` are samples (row * width + column): first the roots, row
/// by row, then the inserted vertices in their order; no sample comes twice. `triangles` are three
/// indices into `vertices` each, counter-clockwise seen from above (x to the right, rows towards
/// the viewer); every triangle has an area.
struct LatticeMesh {
  std::vector<uint32_t> vertices;
  std::vector<uint32_t> triangles;

  size_t triangleCount() const { return triangles.size() / 3; }
};

/// Returns the mesh of the roots and `vertices`. Each vertex comes once, after its parents.
LatticeMesh meshOf(const Lattice& lattice, std::span<const VertexId> vertices);

/// Returns all vertices, coarse ones first. Their mesh has every sample.
std::vector<VertexId> allVertices(const Lattice& lattice);

/// The closure of all samples whose mark is not zero (thesis 3.2.3: splitting domains), in order of
/// id. marks: one for each sample, row by row.
std::vector<VertexId> codedVertices(const Lattice& lattice, std::span<const uint8_t> marks);

/// Returns the mesh of codedVertices().
LatticeMesh codedMesh(const Lattice& lattice, std::span<const uint8_t> marks);

}  // namespace tetrakis::inline topology
