// SPDX-License-Identifier: Apache-2.0
// Worth is the error and the cost of a vertex in a mesh, from which slopeOf() computes the slope
// that orders decimation; VertexCosts gives the cost, in triangles or in another unit.
#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <span>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline decimation {

// VertexCosts tells the cost of each vertex in a mesh, in triangles or in a unit of the caller's:
// it is the rate functional R of the thesis (5.2.2).

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

// Worth holds the error and the cost of a vertex, or of a set of vertices, in a mesh: the vector
// functional u = (D, R) of the thesis. slopeOf() divides the one by the other.

/// Returns the slope lambda of thesis 5.2.2. A domain that frees no triangles gets the slope
/// -infinity (it is removed first) if its removal does not increase the error, and +infinity
/// (removed last) if it does.
inline double slopeOf(double distortion, uint32_t cost) {
  constexpr double kSteepest = std::numeric_limits<double>::infinity();
  if (cost == 0) return distortion > 0 ? kSteepest : -kSteepest;
  return distortion / cost;
}

/// u of a vertex or of a set of vertices.
struct Worth {
  double distortion = 0;
  uint32_t cost = 0;

  Worth& operator+=(const Worth& other) {
    distortion += other.distortion;
    cost += other.cost;
    return *this;
  }
  Worth& operator-=(const Worth& other) {
    distortion -= other.distortion;
    cost -= other.cost;
    return *this;
  }
  bool operator==(const Worth&) const = default;
};

/// u of a merging domain, and the slope below which a fall of its slope is reported. It has 16
/// bytes, so that each ancestor that changes takes one access to memory.
struct DomainWorth {
  double distortion = 0;
  uint32_t cost = 0;
  float bound = -std::numeric_limits<float>::infinity();

  DomainWorth& operator+=(const Worth& other) {
    distortion += other.distortion;
    cost += other.cost;
    return *this;
  }
  DomainWorth& operator-=(const Worth& other) {
    distortion -= other.distortion;
    cost -= other.cost;
    return *this;
  }
};

}  // namespace tetrakis::inline decimation
