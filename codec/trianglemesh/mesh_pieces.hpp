// SPDX-License-Identifier: Apache-2.0
// MeshPieces lists the vertices of a mesh piece by piece: what triangles hold together that are
// glued to each other, or go on from one to the next.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/trianglemesh/coded_triangles.hpp"
#include "codec/trianglemesh/corner_fans.hpp"

namespace tetrakis::inline trianglemesh {

class MeshPieces {
 public:
  explicit MeshPieces(const CodedTriangles& mesh) : of_(mesh.places.size(), kNone) {
    std::vector<uint32_t> corners(mesh.places.size());
    for (uint32_t corner = 0; corner < mesh.vertices.size(); ++corner)
      corners[mesh.vertices[corner]] = corner;
    for (const uint32_t vertex : mesh.vertices) {
      if (of_[vertex] != kNone) continue;
      first_.push_back(static_cast<uint32_t>(vertices_.size()));
      meet(vertex);
      uint32_t met = 0;
      for (size_t i = first_.back(); i < vertices_.size(); ++i) {
        visitFan(mesh.sides, corners[vertices_[i]], [&](uint32_t corner) {
          ++met;
          meet(mesh.vertices[after(corner)]);
          meet(mesh.vertices[before(corner)]);
        });
      }
      triangles_.push_back(met / 3);
    }
    first_.push_back(static_cast<uint32_t>(vertices_.size()));
  }

  uint32_t count() const { return static_cast<uint32_t>(triangles_.size()); }
  uint32_t of(uint32_t vertex) const { return of_[vertex]; }
  uint32_t triangles(uint32_t piece) const { return triangles_[piece]; }
  std::span<const uint32_t> vertices(uint32_t piece) const {
    return std::span(vertices_).subspan(first_[piece], first_[piece + 1] - first_[piece]);
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// As one of the latest piece.
  void meet(uint32_t vertex) {
    if (of_[vertex] != kNone) return;
    of_[vertex] = static_cast<uint32_t>(first_.size() - 1);
    vertices_.push_back(vertex);
  }

  std::vector<uint32_t> of_;         ///< of each vertex its piece
  std::vector<uint32_t> vertices_;   ///< piece by piece
  std::vector<uint32_t> first_;      ///< of each piece in this list, and the end of all
  std::vector<uint32_t> triangles_;  ///< of each piece
};

}  // namespace tetrakis::inline trianglemesh
