// SPDX-License-Identifier: Apache-2.0
// ObjectSource takes a mesh of any triangles and resamples it over a base mesh of quads, as finely
// as is asked for: the input is cleaned, decimated with a map, paired to quads; then the bent base
// that decoders will have is cast onto the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/basemesh/base_mesh.hpp"
#include "codec/remesh/cast_heights.hpp"
#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/mapped_decimation.hpp"
#include "codec/remesh/triangle_tree.hpp"

namespace tetrakis::inline remesh {

struct ObjectShape {
  uint32_t base_triangles = 1000;  ///< at most, before pairing
  int depth = 4;                   ///< patches have (2^depth + 1)^2 samples
  int position_bits = 10;          ///< of a coordinate of a corner of the base
};

/// A mesh as heights over a base.
struct ResampledObject {
  BaseMesh base;
  CastSurface surface;
  uint32_t base_triangles = 0;  ///< as asked for
};

class ObjectSource {
 public:
  /// mesh: finite, with a triangle that is left after cleaning. fewest: base triangles that will be
  /// asked for at least.
  ObjectSource(const TriangleMesh& mesh, uint32_t fewest);

  const CleanedMesh& cleaned() const { return cleaned_; }
  const TriangleTree& tree() const { return tree_; }

  ObjectSource(const ObjectSource&) = delete;
  ObjectSource& operator=(const ObjectSource&) = delete;

  /// Triangles of the smallest base there is.
  uint32_t fewestTriangles() const { return decimation_.fewest(); }
  double diagonal() const { return diagonal_; }

  /// The mesh with at most so many triangles, or the fewest there can be.
  DecimatedMesh decimated(uint32_t triangles) const { return decimation_.base(triangles); }

  /// Bases have no fewer triangles than the decimation could leave.
  ResampledObject resampled(const ObjectShape& shape) const;

  /// Where samples of patches of another depth, over the same base, lie on the mesh.
  std::vector<SurfacePoint> placesOn(const ResampledObject& object, int depth) const;

 private:
  struct Quads;
  Quads quadsOf(uint32_t base_triangles) const;
  CastSurface castOn(const BaseMesh& base, const Quads& quads) const;

  CleanedMesh cleaned_;
  TriangleTree tree_;
  MappedDecimation decimation_;
  double diagonal_;
};

}  // namespace tetrakis::inline remesh
