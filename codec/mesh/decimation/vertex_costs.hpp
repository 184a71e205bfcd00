// SPDX-License-Identifier: Apache-2.0
// VertexCosts tells the cost of each vertex in a mesh, in triangles or in a unit of the caller's:
// it is the rate functional R of the thesis (5.2.2).
#pragma once

#include <cassert>
#include <cstdint>
#include <span>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline decimation {

/// The cost of each vertex: the triangles that it adds, or an amount in any other unit, such as
/// coded bits. The lattice and the given amounts must outlive this object.
class VertexCosts {
 public:
  /// given: one amount for each lattice vertex, their sum below 2^32; empty: triangles.
  explicit VertexCosts(const Lattice& lattice, std::span<const uint32_t> given = {})
      : lattice_(&lattice), given_(given) {
    assert(given.empty() || given.size() == lattice.vertexCount());
  }

  const Lattice& lattice() const { return *lattice_; }
  /// vertex: the id of site.
  uint32_t of(Site site, VertexId vertex) const {
    return given_.empty() ? lattice_->triangleCost(site) : given_[vertex];
  }

 private:
  const Lattice* lattice_;
  std::span<const uint32_t> given_;
};

}  // namespace tetrakis::inline decimation
