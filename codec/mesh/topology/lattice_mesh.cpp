// SPDX-License-Identifier: Apache-2.0
// Triangles of a closed set by descent from the root triangles, and closures by ascent to the
// roots.
#include "codec/mesh/topology/lattice_mesh.hpp"

#include <cassert>
#include <limits>
#include <numeric>

namespace tetrakis::inline topology {
namespace {

constexpr uint32_t kAbsent = std::numeric_limits<uint32_t>::max();
constexpr uint32_t kHidden = kAbsent - 1;  ///< inserted, and merged with a corner of its triangles

struct MeshCorner {
  GridPoint point;
  uint32_t index = 0;  ///< in the mesh
};
using MeshTriangle = LatticeTriangle<MeshCorner>;

class MeshBuilder {
 public:
  explicit MeshBuilder(const Lattice& lattice)
      : lattice_(lattice), index_(lattice.vertexCount(), kAbsent) {}

  LatticeMesh build(std::span<const VertexId> vertices) {
    addRoots();
    for (const VertexId v : vertices) insert(v);
    mesh_.triangles.reserve(3 * triangle_count_);
    forEachRootTriangle(
        lattice_,
        [&](GridPoint p) {
          return MeshCorner{p, rootIndex(p)};
        },
        [&](const MeshTriangle& t) { addTriangles(t); });
    assert(mesh_.triangles.size() == 3 * triangle_count_);
    return std::move(mesh_);
  }

 private:
  void addRoots() {
    const uint32_t side = lattice_.rootSide();
    for (uint32_t row = 0; row <= lattice_.rootRows(); ++row)
      for (uint32_t column = 0; column <= lattice_.rootColumns(); ++column)
        mesh_.vertices.push_back(lattice_.gridIndex({column * side, row * side}));
    triangle_count_ = size_t{2} * lattice_.rootRows() * lattice_.rootColumns();
  }

  uint32_t rootIndex(GridPoint p) const {
    const uint32_t side = lattice_.rootSide();
    return p.y / side * (lattice_.rootColumns() + 1) + p.x / side;
  }

  void insert(VertexId v) {
    const Site site = lattice_.site(v);
    assert(index_[v] == kAbsent);
    lattice_.forEachParent(site, [&]([[maybe_unused]] Site parent) {
      assert(index_[lattice_.id(parent)] != kAbsent);
    });
    triangle_count_ += lattice_.triangleCost(site);
    if (lattice_.hidden(site)) {
      index_[v] = kHidden;
      return;
    }
    index_[v] = static_cast<uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(lattice_.gridIndex(lattice_.position(site)));
  }

  /// Depth at most levelCount().
  void addTriangles(const MeshTriangle& t) {
    if (t.collapses(lattice_)) return;
    MeshCorner w{t.splitPoint(), kAbsent};
    if (t.level < lattice_.levelCount())
      w.index = index_[lattice_.id(lattice_.siteAt(t.level, w.point))];
    if (w.index == kAbsent) {
      mesh_.triangles.insert(mesh_.triangles.end(), {t.a.index, t.b.index, t.apex.index});
      return;
    }
    if (w.index == kHidden) w.index = mergedIndex(t);
    addTriangles(t.first(w));
    addTriangles(t.second(w));
  }

  /// Index of the vertex that the hidden split vertex of t falls onto.
  uint32_t mergedIndex(const MeshTriangle& t) const {
    if (Lattice::isCentre(t.level)) return rootIndex(lastRoot());
    const bool a_is_last = t.a.point.x + t.a.point.y > t.b.point.x + t.b.point.y;
    return a_is_last ? t.a.index : t.b.index;
  }

  GridPoint lastRoot() const {
    const uint32_t side = lattice_.rootSide();
    return {lattice_.rootColumns() * side, lattice_.rootRows() * side};
  }

  const Lattice& lattice_;
  std::vector<uint32_t> index_;  ///< of each lattice vertex in the mesh
  size_t triangle_count_ = 0;
  LatticeMesh mesh_;
};

/// The marked vertices and their ancestors. marks: one for each lattice vertex; completed.
void close(const Lattice& lattice, std::vector<bool>& marks) {
  for (VertexId v = lattice.vertexCount(); v-- > 0;)
    if (marks[v])
      lattice.forEachParent(lattice.site(v),
                            [&](Site parent) { marks[lattice.id(parent)] = true; });
}

std::vector<VertexId> idsOf(const std::vector<bool>& marks) {
  std::vector<VertexId> ids;
  for (VertexId v = 0; v < marks.size(); ++v)
    if (marks[v]) ids.push_back(v);
  return ids;
}

}  // namespace

LatticeMesh meshOf(const Lattice& lattice, std::span<const VertexId> vertices) {
  return MeshBuilder(lattice).build(vertices);
}

std::vector<VertexId> allVertices(const Lattice& lattice) {
  std::vector<VertexId> all(lattice.vertexCount());
  std::iota(all.begin(), all.end(), VertexId{0});
  return all;
}

std::vector<VertexId> codedVertices(const Lattice& lattice, std::span<const uint8_t> marks) {
  assert(marks.size() == lattice.sampleCount());
  std::vector<bool> chosen(lattice.vertexCount());
  for (VertexId v = 0; v < lattice.vertexCount(); ++v) {
    const Site site = lattice.site(v);
    chosen[v] = !lattice.hidden(site) && marks[lattice.gridIndex(lattice.position(site))] != 0;
  }
  close(lattice, chosen);
  return idsOf(chosen);
}

LatticeMesh codedMesh(const Lattice& lattice, std::span<const uint8_t> marks) {
  return meshOf(lattice, codedVertices(lattice, marks));
}

}  // namespace tetrakis::inline topology
