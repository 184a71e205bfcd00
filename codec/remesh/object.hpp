// SPDX-License-Identifier: Apache-2.0
// ObjectSource takes a mesh of any triangles and resamples it over a base mesh of quads, as finely
// as is asked for. The input is cleaned and decimated, with a map back to it, and the triangles
// that are left are paired to quads. Then lines from the bent base that decoders will have are
// followed to the mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "codec/basemesh/base_mesh.hpp"
#include "codec/remesh/cast_heights.hpp"
#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/mapped_decimation.hpp"
#include "codec/remesh/triangle_tree.hpp"

namespace tetrakis::inline remesh {

struct ObjectShape {
  uint32_t base_triangles = 1000;  ///< most triangles of the decimated mesh, before pairing
  int depth = 4;                   ///< patches have (2^depth + 1)^2 samples
  int position_bits = 10;          ///< bits of each coordinate of a corner of the base
};

/// A mesh as heights over a base.
struct ResampledObject {
  BaseMesh base;
  CastSurface surface;
  uint32_t base_triangles = 0;  ///< the number that was asked for
};

/// It is decimated when that is first needed, so only one thread may use it.
class ObjectSource {
 public:
  /// mesh: its coordinates are finite. Cleaning must leave at least one triangle of it before bases
  /// are asked for. fewest: no base of fewer triangles will be asked for.
  ObjectSource(const TriangleMesh& mesh, uint32_t fewest);

  const CleanedMesh& cleaned() const { return cleaned_; }
  const TriangleTree& tree() const { return tree_; }

  ObjectSource(const ObjectSource&) = delete;
  ObjectSource& operator=(const ObjectSource&) = delete;

  /// The number of triangles of the smallest base that there is.
  uint32_t fewestTriangles() const { return decimation().fewest(); }
  double diagonal() const { return diagonal_; }

  /// The mesh over a base of that shape. If the decimation could not leave so few triangles, the
  /// base is the smallest that there is.
  ResampledObject resampled(const ObjectShape& shape) const;

  /// Where the samples lie on the mesh if the patches over the same base have another depth.
  std::vector<SurfacePoint> placesOn(const ResampledObject& object, int depth) const;

 private:
  struct Quads;
  const MappedDecimation& decimation() const;
  Quads quadsOf(uint32_t base_triangles) const;
  CastSurface castOn(const BaseMesh& base, const Quads& quads) const;

  CleanedMesh cleaned_;
  TriangleTree tree_;
  uint32_t fewest_;
  mutable std::optional<MappedDecimation> decimation_;
  double diagonal_;
};

}  // namespace tetrakis::inline remesh
