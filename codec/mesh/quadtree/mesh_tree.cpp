// SPDX-License-Identifier: Apache-2.0
// Lattice vertices to their places in the quadtree and back; see mesh_tree.hpp.
#include "codec/mesh/quadtree/mesh_tree.hpp"

#include <bit>
#include <cassert>

#include "codec/mesh/quadtree/fan_triangles.hpp"

namespace tetrakis::inline quadtree {
namespace {

size_t rootCount(const Lattice& lattice) {
  return (size_t{lattice.rootColumns()} + 1) * (lattice.rootRows() + 1);
}

/// Numbers of the vertices that triangles name, turned into indices without gaps: a bit for each,
/// and the bits before each word.
class VertexSelection {
 public:
  explicit VertexSelection(size_t count) : words_(count / 64 + 1) {}

  bool add(uint32_t number) {
    uint64_t& word = words_[number / 64];
    const uint64_t bit = uint64_t{1} << number % 64;
    const bool fresh = (word & bit) == 0;
    word |= bit;
    return fresh;
  }
  uint32_t close() {
    uint32_t total = 0;
    before_.reserve(words_.size());
    for (const uint64_t word : words_) {
      before_.push_back(total);
      total += static_cast<uint32_t>(std::popcount(word));
    }
    return total;
  }
  uint32_t indexOf(uint32_t number) const {
    const uint64_t below = (uint64_t{1} << number % 64) - 1;
    return before_[number / 64] + static_cast<uint32_t>(std::popcount(words_[number / 64] & below));
  }

 private:
  std::vector<uint64_t> words_;
  std::vector<uint32_t> before_;
};

/// Patches are the root squares of the lattice; level i holds its levels 2i and 2i + 1.
QuadtreeShape quadtreeShapeOf(const Lattice& lattice) {
  return {lattice.levelCount() / 2, lattice.rootColumns(), lattice.rootRows()};
}

std::vector<SemilinearQuadtree::Entry> entriesOf(const Lattice& lattice,
                                                 std::span<const VertexId> vertices,
                                                 std::span<const float> heights) {
  std::vector<SemilinearQuadtree::Entry> entries;
  entries.reserve(vertices.size());
  size_t next = 0;
  for (const VertexId v : vertices) {
    const Site site = lattice.site(v);
    // Hidden vertices turn diagonals, but are no vertices of the mesh.
    entries.push_back({placeOf(lattice, site), lattice.hidden(site) ? 0 : heights[next++]});
  }
  assert(next == heights.size());
  return entries;
}

}  // namespace

QuadtreePlace placeOf(const Lattice& lattice, Site v) {
  assert(v.level < lattice.levelCount());
  const QuadtreeShape shape = quadtreeShapeOf(lattice);
  const uint32_t level = v.level / 2;
  QuadtreePlace place;
  place.level = static_cast<uint8_t>(level);
  if (Lattice::isCentre(v.level)) {
    place.node = shape.nodeOf({level, v.column, v.row});
    return place;
  }
  const uint32_t column = v.column / 2, row = v.row / 2;
  const Lattice::Plan& squares = lattice.plan(2 * level);
  if (column == squares.columns) {
    place.tree = QuadtreePlace::kEastBorder;
    place.node = row;
  } else if (row == squares.rows) {
    place.tree = QuadtreePlace::kSouthBorder;
    place.node = column;
  } else {
    place.vertex = v.column % 2 == 1 ? kNorth : kWest;
    place.node = shape.nodeOf({level, column, row});
  }
  return place;
}

MeshTree::MeshTree(Lattice lattice, std::span<const VertexId> vertices,
                   std::span<const float> heights)
    : lattice_(std::move(lattice)),
      differences_(quadtreeShapeOf(lattice_)),
      quadtree_(differences_.shape(), heights.first(rootCount(lattice_))) {
  assert(heights.size() >= rootCount(lattice_));
  quadtree_.update(entriesOf(lattice_, vertices, heights.subspan(rootCount(lattice_))), {});
}

ViewMesh MeshTree::view(std::span<const MapPoint> polygon) const {
  ViewMesh result;
  std::vector<uint32_t>& triangles = result.mesh.triangles;
  VertexSelection selection(quadtree_.vertexCount());
  struct Corner {
    uint32_t number, sample;
  };
  std::vector<Corner> corners;
  const ViewRaster raster(differences_.shape(), polygon);
  FanTriangles(lattice_, quadtree_, differences_, raster).forEach([&](const FanCorner& corner) {
    triangles.push_back(corner.number);
    if (selection.add(corner.number))
      corners.push_back({corner.number, lattice_.gridIndex(corner.point)});
  });
  result.mesh.vertices.resize(selection.close());
  assert(result.mesh.vertices.size() == corners.size());
  result.heights.resize(corners.size());
  for (const Corner& corner : corners) {
    const uint32_t index = selection.indexOf(corner.number);
    result.mesh.vertices[index] = corner.sample;
    result.heights[index] = quadtree_.values()[corner.number];
  }
  for (uint32_t& corner : triangles) corner = selection.indexOf(corner);
  return result;
}

ViewMesh MeshTree::whole() const {
  const double right = lattice_.width() - 1, bottom = lattice_.height() - 1;
  const MapPoint corners[] = {{0, 0}, {0, bottom}, {right, bottom}, {right, 0}};
  return view(corners);
}

}  // namespace tetrakis::inline quadtree
